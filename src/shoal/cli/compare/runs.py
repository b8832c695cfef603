"""Where the runs of a comparison go: the folder of --out, or one that is gone afterwards."""

import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from shoal.cli.progress import note


@contextmanager
def store_folder(out: Path | None) -> Iterator[Path]:
    """Yield the folder."""
    if out:
        yield out
        return
    with tempfile.TemporaryDirectory(prefix="shoal-compare-") as folder:
        yield Path(folder)


def tell_failures(rows: Iterable[dict[str, Any] | None]) -> None:
    """Say how many runs failed, and the first reason."""
    failed = [row for row in rows if row and row["status"] == "failed"]
    if failed:
        note(f"{len(failed)} runs failed and are left out in pairs; the first: {failed[0]['error']}")
