"""Land around an arena, from a GeoJSON file of polygons."""

import hashlib
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shoal.core.geodesy import Frame, near
from shoal.sea.polygons import Polygon, around, in_meters, read_polygons
from shoal.sea.window import Window, window_of

MARGIN = 0.1  # of the window's longer side, beyond it
LEAST_MARGIN = 0.02  # [deg]


@dataclass(frozen=True)
class Coast:
    """Land near an arena.

    Parameters
    ----------
    polygons : (shell, holes) closed rings (n, 2) in local meters; overlapping ones are land where any of them is
    notes : what was assumed
    digest : of the land near the arena, wherever the file lies
    """

    polygons: list[Polygon]
    notes: list[str] = field(default_factory=list)
    digest: str = ""


def read_coast(path: str | PathLike[str], frame: Frame, half_x: float, half_y: float) -> Coast:
    """Return the land near an arena.

    Parameters
    ----------
    path : a GeoJSON file of polygons in longitude and latitude (WGS 84)
    frame : local meters of the arena
    half_x, half_y : [m] half the sides of the arena

    Raises
    ------
    SeaError : the file cannot be used
    """
    path = Path(path)
    window = window_of(frame, half_x, half_y)
    everything, notes = read_polygons(path)
    margin = max(LEAST_MARGIN, MARGIN * max(window.east - window.west, window.north - window.south))
    land = around(everything, window, margin)
    if not land:
        notes.append(f"{path.name} has no land near the arena.")
    elif _is_cut(everything, window):
        notes.append(f"{path.name} is cut inside the arena: beyond the cut, all is taken as sea.")
    return Coast(in_meters(land, frame), notes, _digest(land))


def _is_cut(polygons: list[Polygon], window: Window) -> bool:
    """Whether the arena reaches beyond a side of the box around all polygons that an edge lies on."""
    lon = np.concatenate([near(each.shell[:, 0], window.middle) for each in polygons])
    lat = np.concatenate([each.shell[:, 1] for each in polygons])

    def cut(values: NDArray[np.float64], end: float) -> bool:
        at = values == end
        return bool((at[1:] & at[:-1]).any())

    return (
        (window.west < lon.min() and cut(lon, lon.min()))
        or (window.east > lon.max() and cut(lon, lon.max()))
        or (window.south < lat.min() and cut(lat, lat.min()))
        or (window.north > lat.max() and cut(lat, lat.max()))
    )


def _digest(polygons: list[Polygon]) -> str:
    digest = hashlib.sha256()
    for polygon in polygons:
        for ring in (polygon.shell, *polygon.holes):
            digest.update(np.round(ring, 9).astype("<f8").tobytes() + b"|")
        digest.update(b"/")
    return digest.hexdigest()
