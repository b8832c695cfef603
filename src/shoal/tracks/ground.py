"""Distances on the Earth, and a track in local meters."""

import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import TrackError
from shoal.core.geodesy import ECCENTRICITY_SQUARED, Frame, radii
from shoal.tracks.table import Fixes

MEAN_RADIUS = 6.371e6  # [m]
QUARTER_OF_EARTH = 1e7  # [m] from pole to equator
NEAR = 1e6  # [m] up to here local meters are right within 0.5 %


def points(fixes: Fixes) -> NDArray[np.float64]:
    """Return where the fixes lie in space, (F, 3) [m] from the center of the Earth."""
    lat, lon = np.radians(fixes.lat), np.radians(fixes.lon)
    _, normal = radii(fixes.lat)
    return np.stack(
        (
            normal * np.cos(lat) * np.cos(lon),
            normal * np.cos(lat) * np.sin(lon),
            normal * (1.0 - ECCENTRICITY_SQUARED) * np.sin(lat),
        ),
        axis=-1,
    )


def along_the_ground(chord: Any) -> Any:
    """Return the length of an arc [m] from that of its chord [m]: exact for steps, within 0.5 % around the Earth."""
    return 2.0 * MEAN_RADIUS * np.arcsin(np.minimum(chord / (2.0 * MEAN_RADIUS), 1.0))


def steps(fixes: Fixes) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return length [m] and duration [s] of each step, (F - 1,)."""
    chords = np.sqrt(np.sum(np.diff(points(fixes), axis=0) ** 2, axis=-1))
    return np.asarray(along_the_ground(chords)), np.diff(fixes.unix)


def center(fixes: Fixes) -> tuple[float, float]:
    """Return (lon, lat) [deg] in the middle of the bounding box, also across the antimeridian."""
    lon = np.unwrap(fixes.lon, period=360.0)
    middle = (lon.min() + lon.max()) / 2.0
    at = (middle + 180.0) % 360.0 - 180.0, (fixes.lat.min() + fixes.lat.max()) / 2.0
    return round(float(at[0]), 6), round(float(at[1]), 6)


def project(path: Path, fixes: Fixes, origin: tuple[float, float]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return x and y [m] in the azimuthal equidistant projection: distance and bearing from `origin` are true.

    Raises
    ------
    TrackError : a fix lies farther off than a quarter of the Earth
    MissingExtraError : pyproj is not installed
    """
    x, y = Frame(origin).local(fixes.lon, fixes.lat)
    farthest = np.hypot(x, y).max()
    if not farthest < QUARTER_OF_EARTH:
        raise TrackError(
            str(path),
            f"reaches {farthest / 1e3:.0f} km from origin ({origin[0]:g}, {origin[1]:g}), "
            "where local meters mean nothing",
            "give an origin (lon, lat) [deg] near the track",
        )
    return _millimeters(x), _millimeters(y)


def note_distance(x: NDArray[np.float64], y: NDArray[np.float64]) -> list[str]:
    """Return how far the projection stretches: across the direction to origin by c / sin(c), c = r / R."""
    farthest = float(np.hypot(x, y).max())
    if farthest <= NEAR:
        return []
    angle = farthest / MEAN_RADIUS
    return [
        f"The track reaches {farthest / 1e3:.0f} km from its origin, where local meters are "
        f"up to {angle / math.sin(angle) - 1.0:.1%} too long."
    ]


def _millimeters(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rounded to 1 mm, no -0: the digest should outlive a last bit of PROJ."""
    return np.ascontiguousarray(np.round(values, 3) + 0.0, dtype=np.float64)
