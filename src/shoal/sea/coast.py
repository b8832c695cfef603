"""Land around an arena, from a GeoJSON file of polygons."""

import hashlib
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path

import numpy as np

from shoal.core.geodesy import Frame
from shoal.sea.polygons import Polygon, around, in_meters, read_polygons
from shoal.sea.window import window_of

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
    near = around(everything, window, margin)
    if not near:
        notes.append(f"{path.name} has no land near the arena.")
    return Coast(in_meters(near, frame), notes, _digest(near))


def _digest(polygons: list[Polygon]) -> str:
    digest = hashlib.sha256()
    for polygon in polygons:
        for ring in (polygon.shell, *polygon.holes):
            digest.update(np.round(ring, 9).astype("<f8").tobytes() + b"|")
        digest.update(b"/")
    return digest.hexdigest()
