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
    """Return both components at the centers of the cells.

    From the four sides in line, (9 (b + c) - a - d) / 16, where they are known: the mean of two alone would smooth
    swirls of 12 cells by 3 %. Else the mean of both sides, or the one that is known.

    Parameters
    ----------
    u, v : (T, J, I - 1) and (T, J - 1, I), on the sides of cells whose centers are (J, I): an Arakawa C grid
    """
    return _at_centers(u, 2), _at_centers(v, 1)


def _at_centers(values: NDArray[np.float32], axis: int) -> NDArray[np.float32]:
    ends = [(0, 0), (0, 0), (0, 0)]
    ends[axis] = (2, 2)
    padded = np.moveaxis(np.pad(values, ends, constant_values=np.nan), axis, 0)
    a, b, c, d = padded[:-3], padded[1:-2], padded[2:-1], padded[3:]
    one = np.where(np.isfinite(b), b, c)
    two = np.where(np.isfinite(c), c, b)
    mean = (one + two) / np.float32(2.0)
    fine = mean + (mean - (a + d) / np.float32(2.0)) / np.float32(8.0)
    return np.moveaxis(np.where(np.isfinite(fine), fine, mean), 0, axis)
