"""Progress of a sweep: runs done, runs per second, time left, failures."""

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from rich.live import Live
from rich.text import Text

from shoal.cli.console import progress_console
from shoal.cli.progress import SECONDS_BETWEEN_LINES, note

if TYPE_CHECKING:
    from shoal.experiments.sweep import Progress


@contextmanager
def sweep_progress(store: Path | None) -> Iterator[Callable[["Progress"], None]]:
    """Yield a function to call after every run; say what an interrupt leaves in the store, if it is to stay."""
    try:
        with _reporter() as report:
            yield report
    except KeyboardInterrupt:
        if store:
            note(f"what is done is in {store}; the same command continues from there")
        raise


@contextmanager
def _reporter() -> Iterator[Callable[["Progress"], None]]:
    """One living line on a terminal, a line now and then in a log."""
    console = progress_console()
    if console.is_terminal:
        with Live(console=console, refresh_per_second=4, transient=True) as live:
            yield lambda progress: live.update(Text(describe(progress)))
        return
    last = 0.0

    def report(progress: "Progress") -> None:
        nonlocal last
        if time.monotonic() - last >= SECONDS_BETWEEN_LINES:
            last = time.monotonic()
            note(describe(progress))

    yield report


def describe(progress: "Progress") -> str:
    """One line: how far, how fast, how long."""
    done = progress.before + progress.done
    left = "?" if math.isinf(progress.seconds_left) else _clock(progress.seconds_left)
    kept = f" ({progress.before} from before)" if progress.before else ""
    failures = f", {progress.failed} failed" if progress.failed else ""
    return f"{done} of {progress.total} runs{kept}, {progress.rate:.2g} runs/s, {left} left{failures}"


def _clock(seconds: float) -> str:
    minutes, second = divmod(round(seconds), 60)
    hours, minute = divmod(minutes, 60)
    return f"{hours}:{minute:02}:{second:02}" if hours else f"{minute}:{second:02}"
