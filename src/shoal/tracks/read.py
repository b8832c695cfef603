"""Read one recorded track: a file of fixes in, a clean path in local meters out."""

import hashlib
import os
import time
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import TrackError
from shoal.tracks.choose import choose
from shoal.tracks.clean import clean
from shoal.tracks.formats import check_file, read_table
from shoal.tracks.ground import center, note_distance, project
from shoal.tracks.table import Fixes
from shoal.tracks.times import iso
from shoal.tracks.track import Track
from shoal.tracks.wanted import parse_wanted

SHORTEST_MAX_GAP = 300.0  # [s]
USUAL_INTERVALS_PER_GAP = 5.0
SETTLED = 2.0  # [s] a file that changed less long ago may change again within one tick of its clock
REMEMBERED = 8  # tracks: one that is followed is read for the arena and again for the run


def read_track(
    path: str | os.PathLike[str],
    *,
    track_id: str | None = None,
    origin: tuple[float, float] | None = None,
    max_gap: float | None = None,
    max_speed: float = 40.0,
    day_first: bool | None = None,
) -> Track:
    """Return the one track that `path` holds, or the one that `track_id` names.

    Parameters
    ----------
    path : a file of one of the kinds in formats.READERS
    track_id : "COLUMN=VALUE", needed where the file holds several tracks; a * in VALUE stands for anything, and
        "all" takes all fixes as one track
    origin : (lon, lat) [deg] of local (0, 0); default the center of the track's bounding box
    max_gap : [s] default 300 s or five median intervals, whichever is longer
    max_speed : [m/s] a fix that can only be reached faster is a GPS jump and is dropped
    day_first : whether 10/03/2024 is in March; default inferred from the data

    Raises
    ------
    TrackError : the file, a line in it or an option cannot be used
    MissingExtraError : pyproj is not installed, netCDF4 for a .nc file or pyais for raw AIS
    """
    _check_options(origin, max_gap, max_speed)
    path = Path(path)
    fixes, notes = clean(path, _chosen(path, track_id, day_first), max_speed)
    seconds = np.round(fixes.unix - fixes.unix[0], 6)
    intervals = np.diff(seconds)
    if max_gap is None:
        max_gap = max(SHORTEST_MAX_GAP, USUAL_INTERVALS_PER_GAP * float(np.median(intervals)))
    if origin is None:
        origin = center(fixes)
    x, y = project(path, fixes, origin)
    return Track(
        time=seconds,
        x=x,
        y=y,
        origin=(float(origin[0]), float(origin[1])),
        start=iso(fixes.unix[0]),
        max_gap=float(max_gap),
        notes=(*fixes.notes, *notes, *_note_silences(intervals, max_gap), *note_distance(x, y)),
        digest=_digest(seconds, x, y, max_gap),
    )


def _chosen(path: Path, track_id: str | None, day_first: bool | None) -> Fixes:
    """The fixes as the file has them, those of the last few tracks from memory."""
    check_file(path)
    stat = path.stat()
    if time.time() - stat.st_mtime < SETTLED:
        return _read.__wrapped__(path, track_id, day_first, ())
    return _read(path, track_id, day_first, (stat.st_ino, stat.st_size, stat.st_mtime_ns))


@lru_cache(maxsize=REMEMBERED)
def _read(path: Path, track_id: str | None, day_first: bool | None, version: tuple[int, ...]) -> Fixes:
    wanted = parse_wanted(track_id)
    return choose(path, read_table(path, wanted), wanted, day_first)


def _check_options(origin: tuple[float, float] | None, max_gap: float | None, max_speed: float) -> None:
    if not max_speed > 0.0:
        raise TrackError("max_speed", f"is {max_speed}", "give a speed above 0 m/s")
    if max_gap is not None and not max_gap > 0.0:
        raise TrackError("max_gap", f"is {max_gap}", "give a time above 0 s")
    if origin is not None and not (-180.0 <= origin[0] <= 360.0 and -90.0 <= origin[1] <= 90.0):
        raise TrackError(
            "origin",
            f"({origin[0]}, {origin[1]}) is not a place on Earth",
            "give (lon, lat) [deg], longitude first",
        )


def _note_silences(intervals: NDArray[np.float64], max_gap: float) -> list[str]:
    silences = intervals[intervals > max_gap]
    if not silences.size:
        return []
    return [
        f"Silences longer than {max_gap:g} s, when the target counts as absent: {silences.size}, "
        f"{silences.sum():.0f} s in all."
    ]


def _digest(time: NDArray[np.float64], x: NDArray[np.float64], y: NDArray[np.float64], max_gap: float) -> str:
    parts = (time, x, y, np.array([max_gap]))
    return hashlib.sha256(b"".join(part.astype("<f8").tobytes() for part in parts)).hexdigest()
