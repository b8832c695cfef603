"""Where the runs of a study go: the folder that was asked for, or one that is gone afterwards."""

import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from shoal.core.errors import ScenarioError
from shoal.experiments.sweep import Progress


@contextmanager
def store_folder(out: str | Path | None) -> Iterator[Path]:
    """Yield the folder."""
    if out is not None:
        yield Path(out)
        return
    with tempfile.TemporaryDirectory(prefix="shoal-study-") as folder:
        yield Path(folder) / "store"


def progress_of(progress: Callable[[int, int], None] | None) -> Callable[[Progress], None] | None:
    """Return what a sweep reports to: `progress` gets the runs done and the runs in all."""
    if progress is None:
        return None
    return lambda now: progress(now.before + now.done, now.total)


def positive(**numbers: int | None) -> None:
    """Refuse numbers of runs and threads below 1."""
    for name, number in numbers.items():
        if number is not None and (isinstance(number, bool) or not number >= 1):
            raise ScenarioError(name, f"is {number}", "ask for 1 or more")
