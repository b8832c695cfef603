"""The times of a file that a run needs."""

from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shoal.core.cf_time import unix_of
from shoal.core.errors import SeaError
from shoal.sea.components import text

TIME_NAMES = ("time", "ocean_time", "time_counter", "valid_time", "t", "times", "forecast_time", "mt")
LONG_GAP = 3.0  # usual intervals


@dataclass(frozen=True)
class Span:
    """The dimension of time, "" if there is none, and the times taken: indices and unix time [s]."""

    dimension: str
    index: NDArray[np.intp]
    unix: NDArray[np.float64]
    notes: tuple[str, ...]


def span_of(dataset: Any, path: Path, variable: Any, begin: float, end: float) -> Span:
    """Return the times around a run, the last before its start and the first after its end included.

    Parameters
    ----------
    variable : one of the components
    begin, end : of the run, unix time [s]

    Raises
    ------
    SeaError : times that cannot be read, do not rise, or do not cover the run
    """
    time, dimension = _time_variable(dataset, path, variable)
    if not dimension:
        said = f"has one time, {_said(path, time)}," if time is not None else "has no times"
        return Span(
            "", np.zeros(1, np.intp), np.array([begin]), (f"{path.name} {said} and is held for the whole run.",)
        )
    unix = _unix(path, time)
    index = np.arange(len(unix))
    if len(unix) > 1 and np.all(np.diff(unix) < 0.0):
        unix, index = unix[::-1], index[::-1]
    _check_rising(path, time, unix)
    if len(unix) == 1:
        note = f"{path.name} has one time, {iso(unix[0])}, and is held for the whole run."
        return Span(dimension, index, np.array([begin]), (note,))
    if begin < unix[0] - 1e-3 or end > unix[-1] + 1e-3:
        raise SeaError(
            str(path),
            f"reaches from {iso(unix[0])} to {iso(unix[-1])}, but the run lasts from {iso(begin)} to {iso(end)}",
            "set sea.start to a time inside the file, or take fewer steps",
        )
    first = max(0, int(np.searchsorted(unix, begin + 1e-3, "right")) - 1)
    last = min(len(unix) - 1, int(np.searchsorted(unix, end - 1e-3, "left")))
    kept = slice(first, max(last, first) + 1)
    return Span(dimension, index[kept], unix[kept], tuple(_gaps(path, unix, unix[kept])))


def iso(unix: float) -> str:
    """Return a unix time [s] in ISO 8601, UTC."""
    try:
        moment = datetime(1970, 1, 1, tzinfo=UTC) + timedelta(seconds=round(float(unix)))
        return moment.isoformat().replace("+00:00", "Z")
    except OverflowError:
        return f"{unix:g} s since 1970"


def _time_variable(dataset: Any, path: Path, variable: Any) -> tuple[Any, str]:
    """The variable of time and its dimension; none, or one without a dimension, for a steady field."""
    timed = {
        name: each
        for name, each in dataset.variables.items()
        if " since " in text(each, "units") and each.dtype is not str and each.dtype.kind in "iuf"
    }

    def likeness(each: Any) -> tuple[bool, bool, bool]:
        return each.name in variable.dimensions, text(each, "standard_name") == "time", each.name.lower() in TIME_NAMES

    along = [each for each in timed.values() if each.ndim == 1 and each.dimensions[0] in variable.dimensions]
    if along:
        best = max(along, key=likeness)
        return best, best.dimensions[0]
    for name, size in zip(variable.dimensions, variable.shape, strict=True):
        there = dataset.variables.get(name)
        if size > 1 and (
            name.lower() in TIME_NAMES or text(there, "axis") == "T" or text(there, "standard_name") == "time"
        ):
            problem = f"its dimension {name!r} has {size} indices, but no variable says when they are"
            raise SeaError(f"{path} {variable.name}", problem, "add times with units such as 'hours since 1970-01-01'")
    scalar = [each for each in timed.values() if each.size == 1 and "reference" not in text(each, "standard_name")]
    return (max(scalar, key=likeness) if scalar else None), ""


def _unix(path: Path, time: Any) -> NDArray[np.float64]:
    try:
        unix = unix_of(time[...], text(time, "units"), text(time, "calendar"))
    except ValueError as error:
        raise SeaError(f"{path} {time.name}", *error.args) from error
    return np.asarray(np.ma.filled(unix, np.nan), np.float64).reshape(-1)


def _said(path: Path, time: Any) -> str:
    return iso(float(_unix(path, time)[0]))


def _check_rising(path: Path, time: Any, unix: NDArray[np.float64]) -> None:
    if not len(unix):
        raise SeaError(f"{path} {time.name}", "holds no times", "give a file with values")
    if not np.isfinite(unix).all():
        raise SeaError(f"{path} {time.name}", "has missing times", "export the file again, each time once")
    if len(unix) > 1 and not np.all(np.diff(unix) > 0.0):
        at = int(np.flatnonzero(np.diff(unix) <= 0.0)[0])
        problem = f"does not rise: {iso(unix[at])} is followed by {iso(unix[at + 1])}"
        raise SeaError(f"{path} {time.name}", problem, "sort the times, each of them once")


def _gaps(path: Path, whole: NDArray[np.float64], kept: NDArray[np.float64]) -> list[str]:
    longest, usual = float(np.diff(kept).max(initial=0.0)), float(np.median(np.diff(whole)))
    if longest <= LONG_GAP * usual:
        return []
    return [f"{path.name} is silent for {longest / 3600:.3g} h, which is bridged; usual are {usual / 3600:.3g} h."]
