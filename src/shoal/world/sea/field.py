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
DEGREE = 4  # of the polynomials, 15 coefficients each


class Field(NamedTuple):
    """T times, J x I nodes.

    kind : STILL, GRID, or 2 + index into FLOWS
    values : (T J I 2,) along local x and y [m/s]; times : (T,) [s] since the start
    first, second : (I,), (J,) ascending axes of the grid; first_step, second_step : between nodes, 0 where uneven
    coefficients : (2, 15) of x^i y^j, by i and then j, of places in units of `size` [m]: they give the place along the
        axes; size : [m]
    numbers : (8,) what a flow with a formula is made of
    """

    kind: int
    values: npt.NDArray[np.float32]
    times: Floats
    first: Floats
    second: Floats
    first_step: float
    second_step: float
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
        values=np.zeros(2, np.float32),
        times=np.zeros(1),
        first=np.zeros(1),
        second=np.zeros(1),
        first_step=0.0,
        second_step=0.0,
        coefficients=np.zeros((2, 15)),
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
        u, v = x / field.size, y / field.size
        first, second = along_axis(field.coefficients, 0, u, v), along_axis(field.coefficients, 1, u, v)
        return on_grid(field, first, second, now)
    if field.kind >= _FIRST_FLOW:
        return flow(field.kind - _FIRST_FLOW, field.numbers, x, y, now.time)
    return 0.0, 0.0


@kernel
def velocities(field, x, y, now, first, second, u, v):
    """Set u and v (B,) to the velocities at places (B,) [m] and a Moment; first and second (B,) are for scratch.

    In loops of their own: the first one compiles to vector code.
    """
    if field.kind != GRID:
        for i in range(u.size):
            u[i], v[i] = velocity(field, x[i], y[i], now)
        return
    for i in range(u.size):
        first[i] = along_axis(field.coefficients, 0, x[i] / field.size, y[i] / field.size)
        second[i] = along_axis(field.coefficients, 1, x[i] / field.size, y[i] / field.size)
    for i in range(u.size):
        u[i], v[i] = on_grid(field, first[i], second[i], now)


@kernel
def on_grid(field, first, second, now):
    """Velocity at a place along the axes: bilinear between four nodes, and linear between two times [m/s]."""
    i, right = _cell(field.first, field.first_step, first)
    j, up = _cell(field.second, field.second_step, second)
    columns, rows = field.first.size, field.second.size
    node = np.uintp(2 * ((now.row * rows + j) * columns + i))
    east = np.uintp(2 if columns > 1 else 0)
    north = np.uintp(2 * columns if rows > 1 else 0)
    before_x, before_y = _between(field.values, node, east, north, right, up)
    if now.share == 0.0:
        return float(before_x), float(before_y)
    node += np.uintp(2 * rows * columns)
    after_x, after_y = _between(field.values, node, east, north, right, up)
    share = np.float32(now.share)
    return float(before_x + share * (after_x - before_x)), float(before_y + share * (after_y - before_y))


@kernel
def along_axis(c, axis, u, v):
    """Where a place is along an axis of the grid: a polynomial of degree 4 in two variables, by Horner's rule."""
    none = c[axis, 0] + v * (c[axis, 1] + v * (c[axis, 2] + v * (c[axis, 3] + v * c[axis, 4])))
    once = c[axis, 5] + v * (c[axis, 6] + v * (c[axis, 7] + v * c[axis, 8]))
    twice = c[axis, 9] + v * (c[axis, 10] + v * c[axis, 11])
    return none + u * (once + u * (twice + u * (c[axis, 12] + v * c[axis, 13] + u * c[axis, 14])))


@kernel
def _cell(axis, step, place):
    """The node before a place on an axis, and how far to the next, 0 to 1."""
    if axis.size == 1:
        return 0, np.float32(0.0)
    if step > 0.0:
        whole = min(max((place - axis[0]) / step, 0.0), axis.size - 1.0)
        i = min(int(whole), axis.size - 2)
        return i, np.float32(whole - i)
    i = 0
    last = axis.size - 1
    while last - i > 1:
        middle = (i + last) // 2
        if axis[middle] <= place:
            i = middle
        else:
            last = middle
    return i, np.float32(min(max((place - axis[i]) / (axis[i + 1] - axis[i]), 0.0), 1.0))


@kernel
def _between(values, node, east, north, right, up):
    """Bilinear between the four nodes of a cell at one of the times, in single precision, as the values are."""
    one = np.uintp(1)
    low_x = values[node] + right * (values[node + east] - values[node])
    low_y = values[node + one] + right * (values[node + east + one] - values[node + one])
    node += north
    high_x = values[node] + right * (values[node + east] - values[node])
    high_y = values[node + one] + right * (values[node + east + one] - values[node + one])
    return low_x + up * (high_x - low_x), low_y + up * (high_y - low_y)
