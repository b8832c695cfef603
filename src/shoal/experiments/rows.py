"""A row: what one replicate of one cell gave, as numbers and lists by their columns."""

from datetime import UTC, datetime
from typing import Any

from shoal.metrics.summary import METRICS

Row = dict[str, Any]
LIST_COLUMNS = ("phi_histogram", "fleet_phi_histogram", "fleet_xi_raw", "fleet_stationary")


def failed_row(error: str, started: str = "") -> Row:
    """The row of a run that gave no numbers."""
    numbers = dict.fromkeys((*METRICS, *LIST_COLUMNS))
    return {"status": "failed", "error": error, **numbers, "started": started or now(), "seconds": 0.0}


def now() -> str:
    """The time in UTC, as rows have it."""
    return datetime.now(UTC).isoformat(timespec="milliseconds")
