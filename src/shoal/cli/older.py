"""Records and stores of older results versions open like any other; here is what is said of them."""

from pathlib import Path
from typing import TYPE_CHECKING

from shoal.cli.progress import note
from shoal.core.version import RESULTS_VERSION

if TYPE_CHECKING:
    from shoal.record.record import Record


def opened(folder: str | Path) -> "Record":
    """Open a record, and say so if its numbers are of an older results version."""
    from shoal.record.files import open_record

    record = open_record(folder)
    tell_of_version(record.provenance["results_version"])
    return record


def tell_of_version(version: int) -> None:
    """Say so if numbers are of an older results version."""
    if version < RESULTS_VERSION:
        note(
            f"these numbers are of results version {version}; this Shoal gives version {RESULTS_VERSION} "
            '(CHANGELOG.md, "Results change")'
        )
