"""Read one recorded track: a file of GPS fixes in, a clean path in local meters out."""

import hashlib
import math
import os
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shoal.core.errors import MissingExtraError, TrackError
from shoal.scenario.track_files import Fixes, read_fixes

if TYPE_CHECKING:
    import pyproj

FEWEST = 2  # fixes: one alone has no path
SHORTEST_MAX_GAP = 300.0  # [s]
USUAL_INTERVALS_PER_GAP = 5.0
SHOWN_TIMES = 3  # of the dropped fixes, in a note
EARTH_RADIUS = 6.371e6  # [m]
QUARTER_OF_EARTH = 1e7  # [m] from pole to equator
NEAR = 1e6  # [m] up to here local meters are right within 0.5 %


@dataclass(frozen=True, eq=False)  # arrays have no single answer to ==; compare digests
class Track:
    """A recorded target path, cleaned, in local meters."""

    time: NDArray[np.float64]  # (F,) [s] since the first kept fix, strictly increasing
    x: NDArray[np.float64]  # (F,) [m] east of origin
    y: NDArray[np.float64]  # (F,) [m] north of origin
    origin: tuple[float, float]  # (lon, lat) [deg] of local (0, 0)
    start: str  # ISO 8601 UTC time of the first fix
    max_gap: float  # [s] longer silence between two fixes means: the target is not there
    notes: tuple[str, ...]  # what was dropped or assumed, one sentence each
    digest: str  # sha256 hex over time, x, y bytes and max_gap


def read_track(
    path: str | os.PathLike[str],
    *,
    track_id: str | None = None,
    origin: tuple[float, float] | None = None,
    max_gap: float | None = None,
    max_speed: float = 40.0,
) -> Track:
    """Return the one track that `path` holds, or the one that `track_id` names.

    Parameters
    ----------
    path : a .csv, .gpx or .nc file
    track_id : "COLUMN=VALUE", needed where the file holds several tracks
    origin : (lon, lat) [deg] of local (0, 0); default the center of the track's bounding box
    max_gap : [s] default 300 s or five median intervals, whichever is longer
    max_speed : [m/s] a fix that can only be reached faster is a GPS jump and is dropped

    Raises
    ------
    TrackError : the file, a line in it or an option cannot be used
    MissingExtraError : pyproj is not installed, or netCDF4 for a .nc file
    """
    _check_options(origin, max_gap, max_speed)
    path = Path(path)
    fixes = read_fixes(path, track_id)
    _check_positions(fixes)
    _check_order(fixes)

    fresh = np.append(True, np.diff(fixes.unix) > 0.0)
    repeated = int(np.sum(~fresh))
    fixes = fixes.where(fresh)
    _check_count(path, fixes, "record at least two times of the target")

    geod = _pyproj().Geod(ellps="WGS84")
    steady = _steady(fixes, max_speed, geod)
    dropped = fixes.where(~steady)
    fixes = fixes.where(steady)
    _check_count(
        path,
        fixes,
        f"every step is faster than max_speed = {max_speed:g} m/s: raise max_speed, "
        "or check the units of time and the order of lat and lon",
    )

    time = np.round(fixes.unix - fixes.unix[0], 6)
    intervals = np.diff(time)
    if max_gap is None:
        max_gap = max(SHORTEST_MAX_GAP, USUAL_INTERVALS_PER_GAP * float(np.median(intervals)))
    if origin is None:
        origin = _center(fixes)
    x, y = _project(path, fixes, origin)
    return Track(
        time=time,
        x=x,
        y=y,
        origin=(float(origin[0]), float(origin[1])),
        start=_iso(fixes.unix[0]),
        max_gap=float(max_gap),
        notes=(
            *fixes.notes,
            *_note_repeated(repeated),
            *_note_dropped(dropped, max_speed),
            *_note_silences(intervals, max_gap),
            *_note_distance(x, y),
        ),
        digest=_digest(time, x, y, max_gap),
    )


def position_at(track: Track, t: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_]]:
    """Return where the target is at `t` [s], and whether it is there at all.

    p(t) = p_i + (p_i+1 - p_i) (t - t_i) / (t_i+1 - t_i)     for t_i <= t <= t_i+1

    It is absent before the first fix, after the last one, and between two fixes more than
    `track.max_gap` apart; at a fix it is always present.

    Returns
    -------
    (x, y, present) : [m], [m], bool, each of the shape of `t`; x and y are NaN where absent.
    """
    t = np.asarray(t, dtype=np.float64)
    time = track.time
    before = np.clip(np.searchsorted(time, t, side="right") - 1, 0, len(time) - 2)
    after = before + 1
    recorded = (time[0] <= t) & (t <= time[-1])
    heard = time[after] - time[before] <= track.max_gap
    at_fix = (t == time[before]) | (t == time[after])
    present = recorded & (heard | at_fix)
    x = np.where(present, np.interp(t, time, track.x), np.nan)
    y = np.where(present, np.interp(t, time, track.y), np.nan)
    return x, y, np.asarray(present)


def _check_options(origin: tuple[float, float] | None, max_gap: float | None, max_speed: float) -> None:
    if not max_speed > 0.0:
        raise TrackError("max_speed", f"is {max_speed}", "give a speed above 0 m/s")
    if max_gap is not None and not max_gap > 0.0:
        raise TrackError("max_gap", f"is {max_gap}", "give a time above 0 s")
    if origin is not None and not (-180.0 <= origin[0] <= 360.0 and -90.0 <= origin[1] <= 90.0):
        raise TrackError(
            "origin",
            f"({origin[0]}, {origin[1]}) is no place on Earth",
            "give (lon, lat) [deg], longitude first",
        )


def _check_positions(fixes: Fixes) -> None:
    for name, values, low, high in (("lat", fixes.lat, -90, 90), ("lon", fixes.lon, -180, 360)):
        outside = np.flatnonzero(~((values >= low) & (values <= high)))
        if outside.size:
            first = outside[0]
            raise TrackError(
                fixes.places[first],
                f"{name} {values[first]:g} is outside [{low}, {high}]",
                "correct or remove it; lat and lon are in degrees, and may be swapped",
            )


def _check_order(fixes: Fixes) -> None:
    backwards = np.flatnonzero(np.diff(fixes.unix) < 0.0)
    if backwards.size:
        i = backwards[0]
        raise TrackError(
            fixes.places[i + 1],
            f"time goes backwards, from {_iso(fixes.unix[i])} to {_iso(fixes.unix[i + 1])}",
            "sort the file by time",
        )


def _check_count(path: Path, fixes: Fixes, fix: str) -> None:
    if len(fixes.unix) < FEWEST:
        raise TrackError(str(path), f"{len(fixes.unix)} usable fix, but a track needs {FEWEST} or more", fix)


def _steady(fixes: Fixes, max_speed: float, geod: "pyproj.Geod") -> NDArray[np.bool_]:
    """Which fixes lie in the longest run without a jump, or in a run within reach of it."""

    def speed(start: Any, end: Any) -> Any:
        distance = geod.inv(fixes.lon[start], fixes.lat[start], fixes.lon[end], fixes.lat[end])[2]
        return distance / (fixes.unix[end] - fixes.unix[start])

    every = np.arange(len(fixes.unix))
    jumps = np.flatnonzero(speed(every[:-1], every[1:]) > max_speed)
    runs = np.split(every, jumps + 1)
    longest = max(range(len(runs)), key=lambda i: len(runs[i]))  # the first of equals

    kept = np.zeros(len(every), dtype=np.bool_)
    kept[runs[longest]] = True
    last = runs[longest][-1]
    for run in runs[longest + 1 :]:
        if speed(last, run[0]) <= max_speed:
            kept[run] = True
            last = run[-1]
    first = runs[longest][0]
    for run in reversed(runs[:longest]):
        if speed(run[-1], first) <= max_speed:
            kept[run] = True
            first = run[0]
    return kept


def _pyproj() -> Any:
    try:
        import pyproj
    except ImportError as error:
        raise MissingExtraError.of("pyproj", "maritime", "projecting a track to meters") from error
    return pyproj


def _center(fixes: Fixes) -> tuple[float, float]:
    """(lon, lat) [deg] in the middle of the bounding box, also across the antimeridian."""
    lon = np.unwrap(fixes.lon, period=360.0)
    middle = (lon.min() + lon.max()) / 2.0
    center = (middle + 180.0) % 360.0 - 180.0, (fixes.lat.min() + fixes.lat.max()) / 2.0
    return round(float(center[0]), 6), round(float(center[1]), 6)


def _project(path: Path, fixes: Fixes, origin: tuple[float, float]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Azimuthal equidistant: distance and bearing from `origin` are true."""
    local = _pyproj().Proj(proj="aeqd", ellps="WGS84", lon_0=origin[0], lat_0=origin[1])
    x, y = local(fixes.lon, fixes.lat)
    farthest = np.hypot(x, y).max()
    if not farthest < QUARTER_OF_EARTH:
        raise TrackError(
            str(path),
            f"reaches {farthest / 1e3:.0f} km from origin ({origin[0]:g}, {origin[1]:g}), "
            "where local meters mean nothing",
            "give an origin (lon, lat) [deg] near the track",
        )
    return _millimeters(x), _millimeters(y)


def _millimeters(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rounded to 1 mm, no -0: the digest should outlive a last bit of PROJ."""
    return np.ascontiguousarray(np.round(values, 3) + 0.0, dtype=np.float64)


def _iso(unix: float) -> str:
    moment = datetime(1970, 1, 1, tzinfo=UTC) + timedelta(seconds=float(unix))
    return moment.isoformat().replace("+00:00", "Z")


def _note_repeated(count: int) -> list[str]:
    return [f"Fixes dropped for repeating the time of the one before: {count}."] if count else []


def _note_dropped(dropped: Fixes, max_speed: float) -> list[str]:
    count = len(dropped.unix)
    if not count:
        return []
    times = ", ".join(_iso(unix) for unix in dropped.unix[:SHOWN_TIMES])
    more = f" and {count - SHOWN_TIMES} more" if count > SHOWN_TIMES else ""
    return [f"Fixes dropped because only a speed above {max_speed:g} m/s could reach them: {count}, at {times}{more}."]


def _note_silences(intervals: NDArray[np.float64], max_gap: float) -> list[str]:
    silences = intervals[intervals > max_gap]
    if not silences.size:
        return []
    return [
        f"Silences longer than {max_gap:g} s, when the target counts as absent: {silences.size}, "
        f"{silences.sum():.0f} s in all."
    ]


def _note_distance(x: NDArray[np.float64], y: NDArray[np.float64]) -> list[str]:
    """Across the direction to origin the projection stretches by c / sin(c), c = r / R."""
    farthest = float(np.hypot(x, y).max())
    if farthest <= NEAR:
        return []
    angle = farthest / EARTH_RADIUS
    stretch = angle / math.sin(angle) - 1.0
    return [
        f"The track reaches {farthest / 1e3:.0f} km from its origin, where local meters are "
        f"up to {stretch:.1%} too long."
    ]


def _digest(time: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64], max_gap: float) -> str:
    parts = (time, x, y, np.array([max_gap]))
    return hashlib.sha256(b"".join(part.astype("<f8").tobytes() for part in parts)).hexdigest()
