"""How far the shore is: a raster of signed distances, from polygons of land or from a field's own land."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import MissingExtraError, SeaError
from shoal.core.geodesy import Frame, near
from shoal.sea.gridded import Gridded
from shoal.sea.polygons import Polygon, in_meters, read_polygons

CELLS = 2000  # along the longer side
FINEST = 5.0  # [m] no coast is known better
MOST = 10_000  # cells along a side, whoever asks
BEYOND = 2  # cells around the arena
LATTICE = 257  # places along a side whose longitude and latitude are worked out, linear between them

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Raster:
    """Signed distance to the shore at the centers of cells.

    Parameters
    ----------
    distance : float32 (J, I) [m], > 0 at sea, < 0 on land, 0 between a cell of land and one of sea
    x0, y0 : [m] center of cell (0, 0); rows go north
    cell : [m] side of a cell
    notes : what was assumed
    """

    distance: NDArray[np.float32]
    x0: float
    y0: float
    cell: float
    notes: list[str] = field(default_factory=list)


def land_raster(
    polygons: Sequence[Polygon] | None,
    land: Gridded | None,
    frame: Frame | None,
    half_x: float,
    half_y: float,
    cell: float | None = None,
    outside: Sequence[Polygon] | None = None,
) -> Raster:
    """Return the signed distance to the shore over the arena and two cells around it.

    A cell is land if its center is, exactly: inside any polygon by the even-odd rule, or nearest to a node without
    values. Distance is that between centers of cells, less half a cell.

    Parameters
    ----------
    polygons : land in local meters; None: none are known
    land : where there are no polygons, a field whose nodes without values are land
    frame : local meters of the arena, which `land` needs
    half_x, half_y : [m] half the sides of the arena
    cell : [m] default the longer side / 2000, at least 5 m
    outside : polygons outside of which nobody may go, as if it were land

    Raises
    ------
    SeaError : there is no sea in the arena, or more cells are asked for than memory is sensibly spent on
    MissingExtraError : scipy is not installed
    """
    cell = _cell(half_x, half_y, cell)
    x, y = _centers(half_x, cell), _centers(half_y, cell)
    notes = []
    if polygons is not None:
        is_land = filled(polygons, x, y)
    elif land is not None and frame is not None and land.land.any():
        is_land = _nearest(land, frame, x, y)
        notes.append("There is no coast file: where the field has no values is land.")
    else:
        is_land = np.zeros((len(y), len(x)), dtype=bool)
    if outside is not None:
        is_land |= ~filled(outside, x, y)
    in_arena = np.ix_(np.abs(y) <= half_y, np.abs(x) <= half_x)
    if is_land[in_arena].all():
        where = "all of it is land" + (" or outside the search area" if outside is not None else "")
        raise SeaError("area", where, "move area.origin to the sea, or give another coast")
    return Raster(_distance(is_land, cell), float(x[0]), float(y[0]), cell, notes)


def search_area(path: str | PathLike[str], frame: Frame) -> list[Polygon]:
    """Return the polygons of a GeoJSON file that limit where agents go, in local meters.

    Parameters
    ----------
    path : a GeoJSON file of polygons in longitude and latitude (WGS 84)
    frame : local meters of the arena

    Raises
    ------
    SeaError : the file cannot be used
    """
    polygons, _ = read_polygons(Path(path))
    moved = [Polygon(_around(each.shell, frame), [_around(hole, frame) for hole in each.holes]) for each in polygons]
    return in_meters(moved, frame)


def filled(polygons: Sequence[Polygon], x: NDArray[np.float64], y: NDArray[np.float64]) -> Mask:
    """Return which centers lie in any of the polygons, (J, I): the even-odd rule along each row.

    Parameters
    ----------
    polygons : closed rings, in the unit of x and y
    x, y : (I,), (J,) evenly spaced, ascending
    """
    inside = np.zeros((len(y), len(x)), dtype=bool)
    for polygon in polygons:
        rows, columns = _crossings((polygon.shell, *polygon.holes), x, y)
        if not len(rows):
            continue
        bottom, top, left = int(rows.min()), int(rows.max()) + 1, int(columns.min())
        right = min(int(columns.max()), len(x))
        flips = np.zeros((top - bottom, right - left + 1), np.int32)
        np.add.at(flips, (rows - bottom, columns - left), 1)
        inside[bottom:top, left:right] |= (np.cumsum(flips, axis=1) % 2 == 1)[:, :-1]
    return inside


def _crossings(
    rings: Sequence[NDArray[np.float64]], x: NDArray[np.float64], y: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Rows whose line of centers an edge crosses, and the first column to the right of each crossing (I: none is)."""
    start = np.concatenate([ring[:-1] for ring in rings])
    end = np.concatenate([ring[1:] for ring in rings])
    step = y[1] - y[0]
    low, high = np.minimum(start[:, 1], end[:, 1]), np.maximum(start[:, 1], end[:, 1])
    first, last = (np.clip(np.ceil((each - y[0]) / step), 0, len(y)).astype(np.intp) for each in (low, high))
    count = np.maximum(last - first, 0)  # half open: a vertex belongs to the edge above it
    edge = np.repeat(np.arange(len(count)), count)
    rows = first[edge] + np.arange(len(edge)) - np.repeat(np.cumsum(count) - count, count)
    slope = (end[edge, 0] - start[edge, 0]) / (end[edge, 1] - start[edge, 1])
    at = start[edge, 0] + (y[rows] - start[edge, 1]) * slope
    return rows, np.clip(np.ceil((at - x[0]) / (x[1] - x[0])), 0, len(x)).astype(np.intp)


def _cell(half_x: float, half_y: float, cell: float | None) -> float:
    longer = 2.0 * max(half_x, half_y)
    if cell is None:
        return max(longer / CELLS, FINEST)
    if not (np.isfinite(cell) and cell > 0.0 and longer / cell <= MOST):
        problem = f"cells of {cell:g} m would be more than {MOST} along a side of {longer:g} m"
        raise SeaError("sea.cell", problem, f"take {longer / MOST:.3g} m or more, or leave it out")
    return float(cell)


def _centers(half: float, cell: float) -> NDArray[np.float64]:
    count = int(np.ceil(2.0 * half / cell - 1e-9)) + 2 * BEYOND
    return (np.arange(float(count)) - (count - 1) / 2.0) * cell


def _nearest(field_: Gridded, frame: Frame, x: NDArray[np.float64], y: NDArray[np.float64]) -> Mask:
    """Whether the node nearest to each center is land."""
    if field_.metric:
        return field_.land[np.ix_(_node(field_.second, y), _node(field_.first, x))]
    coarse_x, coarse_y = np.linspace(x[0], x[-1], LATTICE), np.linspace(y[0], y[-1], LATTICE)
    lon, lat = frame.geographic(*np.meshgrid(coarse_x, coarse_y))
    lon = near(lon, frame.origin[0])
    result = np.empty((len(y), len(x)), dtype=bool)
    at = np.interp(y, coarse_y, np.arange(LATTICE, dtype=float))
    for row, place in enumerate(at):
        low = min(int(place), LATTICE - 2)
        share = place - low
        here = [np.interp(x, coarse_x, (1 - share) * each[low] + share * each[low + 1]) for each in (lon, lat)]
        result[row] = field_.land[_node(field_.second, here[1]), _node(field_.first, here[0])]
    return result


def _node(axis: NDArray[np.float64], at: NDArray[np.float64]) -> NDArray[np.intp]:
    return np.searchsorted((axis[1:] + axis[:-1]) / 2.0, at)


def _around(ring: NDArray[np.float64], frame: Frame) -> NDArray[np.float64]:
    return np.stack((near(ring[:, 0], frame.origin[0]), ring[:, 1]), axis=-1)


def _distance(is_land: Mask, cell: float) -> NDArray[np.float32]:
    """Distance [m] to the edge between land and sea; where all is sea, farther than any place."""
    if not is_land.any():
        return np.full(is_land.shape, 2.0 * cell * float(np.hypot(*is_land.shape)), np.float32)
    transform: Any = _scipy_edt()
    to_land = transform(~is_land).astype(np.float32)
    to_sea = transform(is_land).astype(np.float32)
    return np.asarray(np.where(is_land, 0.5 - to_sea, to_land - 0.5) * np.float32(cell), np.float32)


def _scipy_edt() -> Any:
    try:
        from scipy.ndimage import distance_transform_edt
    except ImportError as error:
        raise MissingExtraError.of("scipy", "maritime", "the distance to the shore") from error
    return distance_transform_edt
