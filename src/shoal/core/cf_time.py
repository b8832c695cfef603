"""Times as CF files count them, such as hours since a date, to unix seconds."""

from datetime import UTC, datetime
from typing import Any

import numpy as np

SECONDS = {
    "nanosecond": 1e-9, "ns": 1e-9, "microsecond": 1e-6, "us": 1e-6, "millisecond": 1e-3,
    "ms": 1e-3, "second": 1.0, "sec": 1.0, "s": 1.0, "minute": 60.0, "min": 60.0,
    "hour": 3600.0, "hr": 3600.0, "h": 3600.0, "day": 86400.0, "d": 86400.0,
}  # fmt: skip
REAL_CALENDARS = ("standard", "gregorian", "proleptic_gregorian")
FIX = "use units such as 'seconds since 1970-01-01'"


def unix_of(values: Any, units: str, calendar: str) -> Any:
    """Return unix time [s] of a masked array of numbers, masked where missing; without a zone, UTC.

    Parameters
    ----------
    values : numbers, as the file has them
    units, calendar : the attributes of these names; the calendar may be empty

    Raises
    ------
    ValueError : (problem, fix)
    """
    from cftime import num2date

    calendar = calendar or "standard"
    word, _, reference = units.partition(" since ")
    word = word.strip().lower()
    scale = SECONDS.get(word, SECONDS.get(word.removesuffix("s")))
    if scale is None or not reference or calendar.lower() not in REAL_CALENDARS:
        problem = f"units {units!r} in calendar {calendar!r} is not a time that was recorded"
        raise ValueError(problem, f"{FIX} and the standard calendar")
    seconds = np.ma.asarray(np.ma.masked_invalid(np.ma.asarray(values).astype(np.float64)) * scale)
    if not seconds.count():
        return seconds
    first = float(seconds.compressed()[0])
    try:
        date = num2date(first, f"seconds since {reference}", calendar)
        moment = datetime.fromisoformat(date.isoformat()).replace(tzinfo=UTC)
    except (ValueError, OverflowError) as error:
        problem = f"{first:g} s since {reference!r} cannot be read ({error})"
        raise ValueError(problem, f"{FIX} and times in the years 1 to 9999") from error
    return moment.timestamp() + (seconds - first)
