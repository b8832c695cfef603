"""Where on Earth a scenario takes place, and when: what ties local meters and steps to charts and clocks."""

from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.errors import ScenarioError, TrackError
from shoal.core.geodesy import Frame
from shoal.core.text import cut
from shoal.scenario.on_track import open_track
from shoal.scenario.schema import Scenario

EPOCH = datetime(1970, 1, 1, tzinfo=UTC)
MICROSECOND = timedelta(microseconds=1)
EXAMPLE = "2015-11-16T06:00:00Z"


class Anchor(NamedTuple):
    """Where (0, 0) is, and when step 0.

    frame : local meters around it
    start : time of step 0, UTC
    """

    frame: Frame
    start: datetime

    def times(self, seconds: npt.NDArray[np.float64]) -> npt.NDArray[np.int64]:
        """Return Unix times [us] of some seconds since the start, in whole microseconds.

        Raises
        ------
        ScenarioError : one lies after the year 9999
        """
        begin = (self.start - EPOCH) // MICROSECOND
        last = (datetime.max.replace(tzinfo=UTC) - EPOCH) // MICROSECOND
        if seconds.size and begin + float(seconds.max()) * 1e6 > last:
            raise ScenarioError("start", f"{iso(begin)} lets the run end after the year 9999", "give an earlier one")
        return begin + np.round(seconds * 1e6).astype(np.int64)


def anchor_of(
    scenario: Scenario,
    *,
    origin: Sequence[float] | None = None,
    start: str | datetime | None = None,
) -> Anchor:
    """Return the anchor that a scenario has, or is given.

    Parameters
    ----------
    origin : (lon, lat) [deg] of local (0, 0); default the scenario's area.origin
    start : time of step 0, with its zone; default the start of the scenario's sea, or of its recorded track

    Raises
    ------
    ScenarioError : the scenario says not where or when, nor is it given; or it is no place or time
    MissingExtraError : pyproj is not installed
    """
    where = origin if origin is not None else scenario.area.origin
    if where is None:
        raise ScenarioError(
            scenario.name,
            "has no place on Earth (area.origin)",
            "say where its center lies: --origin LON,LAT, such as --origin=-1.3,50.8",
        )
    when = moment_of(start) if start is not None else _start_of(scenario)
    return Anchor(Frame(place_of(where)), when)


def place_of(origin: Any) -> tuple[float, float]:
    """Return (lon, lat) [deg], checked: two numbers, or a text of two with a comma between.

    Raises
    ------
    ScenarioError : it is no place on Earth
    """
    parts = origin.split(",") if isinstance(origin, str) else origin
    try:
        lon, lat = (float(part) for part in parts)
    except (TypeError, ValueError):
        lon = lat = np.nan
    if not (-180.0 <= lon <= 360.0 and -90.0 <= lat <= 90.0):
        raise ScenarioError(
            "origin",
            f"{cut(str(origin), 60)} is not a place on Earth",
            "give longitude, then latitude, in decimal degrees, such as -1.3,50.8",
        )
    return lon, lat


def moment_of(start: str | datetime) -> datetime:
    """Return a time in UTC, checked.

    Raises
    ------
    ScenarioError : it is not a time, or says no zone
    """
    try:
        moment = datetime.fromisoformat(start.strip()) if isinstance(start, str) else start
        if moment.tzinfo is not None:
            return moment.astimezone(UTC)
        problem, fix = "has no time zone", f"end it with Z for UTC, such as {EXAMPLE}"
    except (ValueError, OverflowError, AttributeError):
        problem, fix = "is not a date and a time", f"write ISO 8601, such as {EXAMPLE}"
    raise ScenarioError(f"start {cut(str(start), 60)}", problem, fix)


def iso(microseconds: int, timespec: str = "auto") -> str:
    """Return a Unix time [us] in ISO 8601, UTC; `timespec` as datetime.isoformat has it."""
    return (EPOCH + int(microseconds) * MICROSECOND).isoformat(timespec=timespec).replace("+00:00", "Z")


def iso_all(times: npt.NDArray[np.int64]) -> list[str]:
    """Return Unix times [us] in ISO 8601, all with as many digits as the finest needs."""
    finest = next(
        (spec for spec, unit in (("seconds", 10**6), ("milliseconds", 10**3)) if not (times % unit).any()),
        "microseconds",
    )
    return [iso(time, finest) for time in times.tolist()]


def _start_of(scenario: Scenario) -> datetime:
    """When step 0 is, as the scenario says it: by its sea, or by the track that its first recorded target follows."""
    start = getattr(getattr(scenario, "sea", None), "start", None)
    if start is not None:
        return moment_of(start)
    fix = f"say when step 0 was: --start {EXAMPLE}"
    for target in scenario.targets:
        if target.kind == "track":
            try:
                return moment_of(open_track(target, scenario.area.origin).start)
            except (TrackError, ScenarioError) as error:
                where, problem, _ = error.args
                raise ScenarioError(where, f"{problem}, and it says when the run begins", fix) from error
    raise ScenarioError(scenario.name, "says not when it takes place: it has neither a start nor a recorded track", fix)
