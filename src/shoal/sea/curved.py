"""Nodes of a grid with a longitude and a latitude for each of them, read by blocks of rows."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import SeaError
from shoal.core.geodesy import meters_per_degree, near
from shoal.sea.window import Window, box

AT_ONCE = 2_000_000  # nodes
MARGIN = 3.0  # cells

Found = tuple[
    tuple[str, str], NDArray[np.intp], NDArray[np.intp], NDArray[np.float64], NDArray[np.float64]
]  # dimensions, rows, columns, lon, lat


def curved_nodes(path: Path, lat: Any, lon: Any, window: Window) -> Found:
    """Return dimensions, rows and columns, and lon and lat (J, I) [deg], of the nodes around a window.

    Parameters
    ----------
    lat, lon : variables over (rows, columns)

    Raises
    ------
    SeaError : none are near
    """
    if min(lat.shape) < 2:
        raise SeaError(
            f"{path} {lat.name}", "has fewer than 2 rows or columns", "give a file that is wider than one cell"
        )
    middle = (window.south + window.north) / 2.0
    to_east, to_north = meters_per_degree(middle)
    best, at = np.inf, (0, 0)
    west, east, south, north = np.inf, -np.inf, np.inf, -np.inf
    for start, lons, lats in _blocks(lat, lon, window.middle):
        distance = np.hypot((lons - (window.west + window.east) / 2.0) * to_east, (lats - middle) * to_north)
        if not np.isfinite(distance).any():
            continue
        west, east = min(west, float(np.nanmin(lons))), max(east, float(np.nanmax(lons)))
        south, north = min(south, float(np.nanmin(lats))), max(north, float(np.nanmax(lats)))
        index = np.unravel_index(int(np.nanargmin(distance)), distance.shape)
        if distance[index] < best:
            best, at = float(distance[index]), (start + int(index[0]), int(index[1]))
    if not np.isfinite(best):
        raise SeaError(f"{path} {lat.name}", "has no values", "export the file again")
    cell = _cell(lat, lon, at, to_east, to_north)
    pad_east, pad_north = MARGIN * cell / to_east, MARGIN * cell / to_north
    rows: list[int] = []
    columns: list[int] = []
    for start, lons, lats in _blocks(lat, lon, window.middle):
        with np.errstate(invalid="ignore"):
            inside = (lons >= window.west - pad_east) & (lons <= window.east + pad_east)
            inside &= (lats >= window.south - pad_north) & (lats <= window.north + pad_north)
        rows += (start + np.flatnonzero(inside.any(axis=1))).tolist()
        columns += np.flatnonzero(inside.any(axis=0)).tolist()
    if not rows:
        raise SeaError(
            str(path),
            f"does not cover the arena: it has {box(west, east, south, north)}; the arena needs {window}",
            "move area.origin, make the area smaller, or give a file of these waters",
        )
    j = np.arange(max(0, min(rows) - 1), min(lat.shape[0], max(rows) + 2))
    i = np.arange(max(0, min(columns) - 1), min(lat.shape[1], max(columns) + 2))
    part = slice(int(j[0]), int(j[-1]) + 1), slice(int(i[0]), int(i[-1]) + 1)
    return lat.dimensions, j, i, np.asarray(near(_values(lon, part), window.middle)), _values(lat, part)


def _blocks(lat: Any, lon: Any, middle: float) -> Iterator[tuple[int, NDArray[np.float64], NDArray[np.float64]]]:
    """First row, longitudes around `middle` and latitudes of some rows at once."""
    step = max(1, AT_ONCE // lat.shape[1])
    for start in range(0, lat.shape[0], step):
        part = slice(start, start + step), slice(None)
        yield start, np.asarray(near(_values(lon, part), middle)), _values(lat, part)


def _values(variable: Any, part: tuple[slice, slice]) -> NDArray[np.float64]:
    return np.asarray(np.ma.filled(np.ma.masked_invalid(np.ma.asarray(variable[part], np.float64)), np.nan))


def _cell(lat: Any, lon: Any, at: tuple[int, int], to_east: float, to_north: float) -> float:
    """The longest distance to a neighbor of a node [m]."""
    part = tuple(slice(max(0, each - 1), each + 2) for each in at)
    lons, lats = _values(lon, part), _values(lat, part)  # type: ignore[arg-type]
    x, y = near(lons, float(np.nanmin(lons)) + 1e-9) * to_east, lats * to_north
    steps = [np.hypot(np.diff(x, axis=axis), np.diff(y, axis=axis)) for axis in (0, 1)]
    known = np.concatenate([each[np.isfinite(each)] for each in steps])
    return float(known.max(initial=0.0))
