"""What a comparison says of runs that failed."""

from collections.abc import Iterable
from typing import Any

from shoal.cli.progress import note


def tell_failures(rows: Iterable[dict[str, Any] | None]) -> None:
    """Say how many runs failed, and the first reason."""
    failed = [row for row in rows if row and row["status"] == "failed"]
    if failed:
        note(f"{len(failed)} runs failed and are left out in pairs; the first: {failed[0]['error']}")
