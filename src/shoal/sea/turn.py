"""Components along the axes of a grid, turned to the east and north."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shoal.core.geodesy import meters_per_degree
from shoal.sea.blocks import read
from shoal.sea.components import text
from shoal.sea.grid import Nodes

Angles = NDArray[np.float64]


def angles_of(dataset: Any, path: Path, nodes: Nodes) -> tuple[Angles, str]:
    """Return the angle from the east to the first axis of the grid [rad] (J, I), and where it is from.

    It is the variable `angle` of the file (ROMS), or the direction from each node to the next of its row.
    """
    variable = dataset.variables.get("angle")
    if variable is not None and variable.dimensions == nodes.dimensions:
        values = read(variable, dict(zip(nodes.dimensions, (nodes.rows, nodes.columns), strict=True)))
        if text(variable, "units").lower().startswith("degree"):
            values = np.radians(values)
        return np.where(np.isfinite(values), values, 0.0), f"by the angle in {path.name}"
    if nodes.straight:
        return np.zeros((len(nodes.lat), len(nodes.lon))), ""
    to_east, to_north = meters_per_degree(nodes.lat)
    east, north = np.gradient(nodes.lon, axis=1) * to_east, np.gradient(nodes.lat, axis=1) * to_north
    return np.arctan2(north, east), "by the direction of the grid's rows"


def unstaggered(u: NDArray[np.float32], v: NDArray[np.float32]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Return both components at the centers of the cells: the mean of the two sides, or the one that is known.

    Parameters
    ----------
    u, v : (T, J, I - 1) and (T, J - 1, I), on the sides of cells whose centers are (J, I): an Arakawa C grid
    """
    return _mean_of_sides(u, 2), _mean_of_sides(v, 1)


def _mean_of_sides(values: NDArray[np.float32], axis: int) -> NDArray[np.float32]:
    shape = list(values.shape)
    shape[axis] += 1
    total, count = np.zeros(shape, np.float32), np.zeros(shape, np.int8)
    known = np.isfinite(values)
    filled = np.where(known, values, np.float32(0.0))
    for part in (slice(0, -1), slice(1, None)):
        where = tuple(part if each == axis else slice(None) for each in range(3))
        total[where] += filled
        count[where] += known
    return np.where(count > 0, total / np.maximum(count, 1), np.float32(np.nan)).astype(np.float32)
