"""A field of velocities, of water or wind: on a grid, bilinear in space and linear in time, or a flow with a formula.

A grid keeps the axes of its source: longitude and latitude, which polynomials of local x and y find. So nothing is
resampled. Vectors are those of the local frame already.
"""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.compiler.kernel import kernel
from shoal.core.agents import Floats
from shoal.world.sea.flows import FLOWS, flow

STILL = 0
GRID = 1
_FIRST_FLOW = 2  # kinds from here on are those of FLOWS
DEGREE = 6  # of the largest polynomials, 28 coefficients


class Field(NamedTuple):
    """T times, J x I nodes.

    kind : STILL, GRID, or 2 + index into FLOWS
    values : (T, J, I, 2) along local x and y [m/s]; times : (T,) [s] since the start
    first, second : (I,), (J,) ascending axes of the grid; first_step, second_step : between nodes, 0 where uneven
    degree : of the polynomials; coefficients : (C, 2) of x^i y^j, by i and then j, of places in units of `size` [m];
        they give the place along the axes
    numbers : (8,) what a flow with a formula is made of
    """

    kind: int
    values: npt.NDArray[np.float32]
    times: Floats
    first: Floats
    second: Floats
    first_step: float
    second_step: float
    degree: int
    coefficients: Floats
    size: float
    numbers: Floats


class Moment(NamedTuple):
    """A time in a field: [s] since the start, the row before it, and how far to the next, 0 to 1."""

    time: float
    row: int
    share: float


def still_field() -> Field:
    """A field that is nowhere and never."""
    return Field(
        kind=STILL,
        values=np.zeros((1, 1, 1, 2), np.float32),
        times=np.zeros(1),
        first=np.zeros(1),
        second=np.zeros(1),
        first_step=0.0,
        second_step=0.0,
        degree=0,
        coefficients=np.zeros((1, 2)),
        size=1.0,
        numbers=np.zeros(8),
    )


def flow_field(kind: str, numbers: Any) -> Field:
    """A flow with a formula: see flows.py for what its numbers are."""
    held = np.zeros(8)
    held[: len(numbers)] = numbers
    return still_field()._replace(kind=_FIRST_FLOW + FLOWS.index(kind), numbers=held)


@kernel
def moment(field, time):
    """Find a time [s] in a field; before its first and after its last it holds still."""
    times = field.times
    row = 0
    last = times.size - 1
    while last - row > 1:
        middle = (row + last) // 2
        if times[middle] <= time:
            row = middle
        else:
            last = middle
    if times.size == 1:
        return Moment(time, 0, 0.0)
    share = (time - times[row]) / (times[row + 1] - times[row])
    return Moment(time, row, min(max(share, 0.0), 1.0))


@kernel
def velocity(field, x, y, now):
    """The velocity at a place [m] and a Moment, along x and y [m/s]."""
    if field.kind == GRID:
        return _on_grid(field, x, y, now)
    if field.kind >= _FIRST_FLOW:
        return flow(field.kind - _FIRST_FLOW, field.numbers, x, y, now.time)
    return 0.0, 0.0


@kernel
def _on_grid(field, x, y, now):
    """Bilinear between four nodes, and linear between two times."""
    first, second = along_axes(field, x, y)
    i, right = _cell(field.first, field.first_step, first)
    j, up = _cell(field.second, field.second_step, second)
    before_x, before_y = _between(field.values, now.row, j, i, up, right)
    if now.share == 0.0:
        return before_x, before_y
    after_x, after_y = _between(field.values, now.row + 1, j, i, up, right)
    return before_x + now.share * (after_x - before_x), before_y + now.share * (after_y - before_y)


@kernel
def along_axes(field, x, y):
    """Where a place [m] is along the axes of the grid: two polynomials by Horner's rule."""
    u = x / field.size
    v = y / field.size
    place = field.coefficients.shape[0]
    first = 0.0
    second = 0.0
    for i in range(field.degree, -1, -1):
        inner_first = 0.0
        inner_second = 0.0
        for _ in range(field.degree - i + 1):
            place -= 1
            inner_first = inner_first * v + field.coefficients[place, 0]
            inner_second = inner_second * v + field.coefficients[place, 1]
        first = first * u + inner_first
        second = second * u + inner_second
    return first, second


@kernel
def _cell(axis, step, place):
    """The node before a place on an axis, and how far to the next, 0 to 1."""
    if axis.size == 1:
        return 0, 0.0
    if step > 0.0:
        i = int(min(max((place - axis[0]) / step, 0.0), axis.size - 2.0))
    else:
        i = 0
        last = axis.size - 1
        while last - i > 1:
            middle = (i + last) // 2
            if axis[middle] <= place:
                i = middle
            else:
                last = middle
    return i, min(max((place - axis[i]) / (axis[i + 1] - axis[i]), 0.0), 1.0)


@kernel
def _between(values, row, j, i, up, right):
    """Bilinear between the four nodes of a cell at one of the times."""
    j_next = min(j + 1, values.shape[1] - 1)
    i_next = min(i + 1, values.shape[2] - 1)
    low_x = values[row, j, i, 0] + right * (values[row, j, i_next, 0] - values[row, j, i, 0])
    low_y = values[row, j, i, 1] + right * (values[row, j, i_next, 1] - values[row, j, i, 1])
    high_x = values[row, j_next, i, 0] + right * (values[row, j_next, i_next, 0] - values[row, j_next, i, 0])
    high_y = values[row, j_next, i, 1] + right * (values[row, j_next, i_next, 1] - values[row, j_next, i, 1])
    return low_x + up * (high_x - low_x), low_y + up * (high_y - low_y)
