"""Agents by where they are: a grid of cells, and the agents of each, so that those near a place are found near it.

A step of a swarm of any size then costs in proportion to it (a cell list, as in molecular dynamics).
"""

import math
from typing import NamedTuple

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.compiler.lanes import narrow, wide
from shoal.core.agents import Floats, aligned_zeros

CELLS_PER_AGENT = 4  # at most
_WIDE, _HIGH = 0.25, 0.8  # of a cell, in reaches: rows cost more than what is looked at in vain
_SLACK = 1e-9  # of a cell: rounding of its edges
_SAMPLE = 64  # agents whose reach decides how large cells are


class Cells(NamedTuple):
    """A grid over the places that reports say. All arrays are scratch, filled anew in each step.

    order : (P,) agents, cell by cell, ascending within one; cells follow each other row by row, there and back
    place : (P,) where each agent is in `order`
    x, y : (P,) what their reports say [m], in `order`; NaN of those whom nobody can hear
    own_x, own_y : (P,) where they believe to be [m], in `order`
    cell : (P,) of each agent; begins : (C + 1,) where each cell begins in `order`
    grid : (6,) left and lower edge [m], columns and rows per meter, columns, rows
    """

    order: np.ndarray
    place: np.ndarray
    x: Floats
    y: Floats
    own_x: Floats
    own_y: Floats
    cell: np.ndarray
    begins: np.ndarray
    grid: Floats


def new_cells(agents: int) -> Cells:
    """Return cells of so many agents."""
    return Cells(
        np.zeros(agents, np.int32),
        np.zeros(agents, np.int32),
        aligned_zeros(agents),
        aligned_zeros(agents),
        aligned_zeros(agents),
        aligned_zeros(agents),
        np.zeros(agents, np.int32),
        np.zeros(CELLS_PER_AGENT * agents + 2 if agents else 0, np.int32),
        np.zeros(6),
    )


@kernel
def put_into_cells(cells, reports, swarm, reach, agents, single):
    """Sort agents by the cell that their report is from, so large that about half a dozen rows lie within a reach.

    single : places are rounded to single precision
    """
    _lay_grid(cells.grid, reports, reach, agents, cells.begins.size - 2)
    grid, cell, begins = cells.grid, cells.cell, cells.begins
    columns = int(grid[4])
    used = columns * int(grid[5])
    for each in range(used + 2):
        begins[each] = 0
    for i in range(agents):
        y, x = rounded(reports.y[i], single), rounded(reports.x[i], single)
        inside = _cell(grid, row_of(grid, y), column_of(grid, x))
        cell[i] = inside
        begins[inside + 2] += 1
    for each in range(2, used + 2):
        begins[each] += begins[each - 1]
    for i in range(agents):
        at = begins[cell[i] + 1]
        begins[cell[i] + 1] = at + 1
        cells.order[at] = i
        cells.place[i] = at
        cells.x[at] = rounded(reports.x[i], single)
        cells.y[at] = rounded(reports.y[i], single)
        cells.own_x[at] = rounded(swarm.fix_x[i], single)
        cells.own_y[at] = rounded(swarm.fix_y[i], single)


@kernel
def rounded(number, single):
    """A number, rounded to single precision if that is asked for."""
    return wide(narrow(number)) if single else number


@kernel
def _lay_grid(grid, reports, reach, agents, most):
    """Lay a grid of at most `most` cells around all reports."""
    left, right, bottom, top = np.inf, -np.inf, np.inf, -np.inf
    for i in range(agents):
        x, y = reports.x[i], reports.y[i]
        left = x if x < left else left
        right = x if x > right else right
        bottom = y if y < bottom else bottom
        top = y if y > top else top
    width, height = right - left, top - bottom
    if not (width < np.inf and height < np.inf and width >= 0.0 and height >= 0.0):
        width, height, left, bottom = 0.0, 0.0, 0.0, 0.0  # somebody is nowhere: one cell
    inverse, count = 0.0, 0
    for i in range(0, agents, max(1, agents // _SAMPLE)):
        inverse += 1.0 / math.sqrt(max(reach[i], 1e-300))
        count += 1
    usual = count / inverse
    stretch = math.sqrt(max(width * height / (0.75 * most * _WIDE * _HIGH * usual * usual), 1.0))
    wide = max(_WIDE * stretch * usual, 16.0 * width / most)
    high = max(_HIGH * stretch * usual, 16.0 * height / most)
    grid[0], grid[1], grid[2], grid[3] = left, bottom, 1.0 / wide, 1.0 / high
    grid[4], grid[5] = math.floor(width / wide) + 1, math.floor(height / high) + 1


@kernel
def column_of(grid, x):
    """The column of a place, the nearest one outside the grid."""
    return _clipped((x - grid[0]) * grid[2], grid[4])


@kernel
def row_of(grid, y):
    """The row of a place, the nearest one outside the grid."""
    return _clipped((y - grid[1]) * grid[3], grid[5])


@kernel
def _cell(grid, row, column):
    """The number of a cell: a snake, so that the end of a row is near where the next one begins."""
    columns = int(grid[4])
    return row * columns + (column if row % 2 == 0 else columns - 1 - column)


@kernel
def span(cells, left, right, bottom, top, radius, row):
    """Where in cells.order those of a row begin and end that may be within a radius of a box [m]."""
    grid = cells.grid
    high = 1.0 / grid[3]
    under = grid[1] + row * high - top if row > 0 else -np.inf
    over = bottom - (grid[1] + (row + 1) * high) if row < int(grid[5]) - 1 else -np.inf
    away = max(max(under, over) - _SLACK * high, 0.0)
    half = math.sqrt(max(radius * radius - away * away, 0.0))
    one = _cell(grid, row, column_of(grid, left - half))
    other = _cell(grid, row, column_of(grid, right + half))
    return int(cells.begins[min(one, other)]), int(cells.begins[max(one, other) + 1])


@kernel
def _clipped(number, count):
    number = number if number > 0.0 else 0.0  # NaN, too
    return int(number if number < count - 1.0 else count - 1.0)
