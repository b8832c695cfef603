"""A grid that bends, resampled once onto one of local meters."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]

FINER = 4  # times as fine as the grid that bends: a bilinear value of bilinear values is otherwise too smooth
MOST_ITERATIONS = 60
EXACT = 1e-6  # cells
SEA = 0.5  # share of the four nodes around a place, by weight, that makes it sea


class Weights(NamedTuple):
    """Nodes around each place, (4, M) as flat indices, and their weights, which sum to 1."""

    corners: NDArray[np.intp]
    weights: Numbers
    covered: NDArray[np.bool_]
    sea: NDArray[np.bool_]


def metric_axis(half: float, cell: float) -> Numbers:
    """Return an axis [m] whose nodes meet both sides of the arena, at most `cell` apart, with two more each way."""
    cells = max(1, int(np.ceil(2.0 * half / cell - 1e-9)))
    return np.arange(-2.0, cells + 3.0) * (2.0 * half / cells) - half


def spacing(x: Numbers, y: Numbers) -> float:
    """Return the usual distance [m] between neighbors of a grid (J, I)."""
    steps = [np.hypot(np.diff(x, axis=axis), np.diff(y, axis=axis)) for axis in (0, 1)]
    return float(min(np.nanmedian(each) for each in steps))


def weights_of(x: Numbers, y: Numbers, at_x: Numbers, at_y: Numbers, unknown: NDArray[np.bool_]) -> Weights:
    """Return bilinear weights of the nodes around places.

    Parameters
    ----------
    x, y : (J, I) [m] of the nodes
    at_x, at_y : (M,) [m] of the places
    unknown : (J, I) nodes without a value of their own; where they weigh more than half is no sea
    """
    column, row, covered = locate(x, y, at_x, at_y)
    i = np.clip(np.floor(column), 0, x.shape[1] - 2).astype(np.intp)
    j = np.clip(np.floor(row), 0, x.shape[0] - 2).astype(np.intp)
    s, t = np.clip(column - i, 0.0, 1.0), np.clip(row - j, 0.0, 1.0)
    first = j * x.shape[1] + i
    corners = np.stack((first, first + 1, first + x.shape[1], first + x.shape[1] + 1))
    weights = np.stack(((1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t))
    at_sea = np.where(unknown.ravel()[corners], 0.0, weights).sum(axis=0)
    return Weights(corners, weights, covered, covered & (at_sea >= SEA))


def locate(x: Numbers, y: Numbers, at_x: Numbers, at_y: Numbers) -> tuple[Numbers, Numbers, NDArray[np.bool_]]:
    """Return column and row, as fractions, of places in a grid, and which of them lie in it.

    Newton's method on the bilinear map from (column, row) to (x, y), from the affine map that fits the nodes best.

    Parameters
    ----------
    x, y : (J, I) [m] of the nodes
    at_x, at_y : (M,) [m] of the places
    """
    rows, columns = x.shape
    known = np.isfinite(x) & np.isfinite(y)
    j, i = np.nonzero(known)
    flat = np.stack((np.ones(len(i)), x[known], y[known]), axis=1)
    fit = np.linalg.lstsq(flat, np.stack((i, j), axis=1).astype(float), rcond=None)[0]
    column, row = (np.stack((np.ones(len(at_x)), at_x, at_y), axis=1) @ fit).T
    column, row = np.clip(column, 0, columns - 1), np.clip(row, 0, rows - 1)
    off = np.full(len(at_x), np.inf)
    for _ in range(MOST_ITERATIONS):
        i = np.clip(np.floor(column), 0, columns - 2).astype(np.intp)
        j = np.clip(np.floor(row), 0, rows - 2).astype(np.intp)
        s, t = column - i, row - j
        at, along, up = zip(*(_bilinear(each, i, j, s, t) for each in (x, y)), strict=True)
        miss_x, miss_y = at_x - at[0], at_y - at[1]
        area = along[0] * up[1] - along[1] * up[0]
        with np.errstate(divide="ignore", invalid="ignore"):
            step_column = (miss_x * up[1] - miss_y * up[0]) / area
            step_row = (miss_y * along[0] - miss_x * along[1]) / area
            off = np.hypot(step_column, step_row)
        if not (off > EXACT).any():
            break
        column = np.clip(column + np.nan_to_num(step_column, posinf=0.0, neginf=0.0), -1.0, columns)
        row = np.clip(row + np.nan_to_num(step_row, posinf=0.0, neginf=0.0), -1.0, rows)
    with np.errstate(invalid="ignore"):
        inside = (column >= -EXACT) & (column <= columns - 1 + EXACT) & (row >= -EXACT) & (row <= rows - 1 + EXACT)
        return column, row, inside & (off <= 10.0 * EXACT)


def _bilinear(
    nodes: Numbers, i: NDArray[np.intp], j: NDArray[np.intp], s: Numbers, t: Numbers
) -> tuple[Numbers, Numbers, Numbers]:
    """Values at (i + s, j + t), and their slopes along columns and rows."""
    low, high = nodes[j, i], nodes[j, i + 1]
    low_up, high_up = nodes[j + 1, i], nodes[j + 1, i + 1]
    below, above = low + s * (high - low), low_up + s * (high_up - low_up)
    return below + t * (above - below), (1 - t) * (high - low) + t * (high_up - low_up), above - below
