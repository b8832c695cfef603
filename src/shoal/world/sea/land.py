"""Land as a raster of signed distances to the shore: it stops what moves, and hides what is behind it."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.compiler.kernel import kernel
from shoal.core.draws import split, uniform

OPEN_WATER = 1e6  # [m] to the shore where there is none
BLOCK = 4  # cells along a side of a block
_FARTHEST = 127  # half cells that a block tells of
_TRIES = 64  # random places, before the nearest water is taken
_REDRAWN = 1 << 22  # a purpose that nothing else draws for


class Land(NamedTuple):
    """Distance to the shore at the middles of square cells.

    distance : (J, I) [m], above 0 at sea, below on land; x, y : of the middle of cell (0, 0) [m]; cell : its side [m]
    per_meter : cells in a meter
    blocks : (J / BLOCK, I / BLOCK) the one nearest to 0 in a block of cells and half a block around, in half cells, 0
        where there are both land and sea: so small that it stays in a cache, which the raster does not
    """

    distance: npt.NDArray[np.float32]
    blocks: npt.NDArray[np.int8]
    x: float
    y: float
    cell: float
    per_meter: float


def no_land() -> Land:
    """Water everywhere."""
    return land_of(np.full((1, 1), OPEN_WATER), 0.0, 0.0, 1.0)


def land_of(distance: npt.ArrayLike, x: float, y: float, cell: float) -> Land:
    """Land of signed distances (J, I) [m] at the middles of cells of a side [m], the first of them at x, y [m]."""
    distance = np.ascontiguousarray(distance, np.float32)
    least, most = distance, distance
    for axis in (0, 1):
        least, most = _around_blocks(least, axis).min(-1), _around_blocks(most, axis).max(-1)
    nearest = np.where(least > 0.0, least, np.where(most < 0.0, most, np.float32(0.0)))
    blocks = np.clip(np.trunc(nearest * (2.0 / cell)), -_FARTHEST, _FARTHEST).astype(np.int8)
    return Land(distance, blocks, float(x), float(y), float(cell), 1.0 / cell)


def _around_blocks(values: npt.NDArray[np.float32], axis: int) -> npt.NDArray[np.float32]:
    """Views of all that is in each block along an axis, or half a block around it: in a new last axis."""
    room = [(0, 0), (0, 0)]
    room[axis] = (BLOCK // 2, BLOCK // 2 + BLOCK)
    windows = np.lib.stride_tricks.sliding_window_view(np.pad(values, room, mode="edge"), 2 * BLOCK + 1, axis)
    last = max(values.shape[axis] - 1, 1)  # a place is between the middles of two cells
    return windows[:last:BLOCK] if axis == 0 else windows[:, :last:BLOCK]


@kernel
def clearance(land, x, y):
    """Distance to the shore [m], below 0 on land: bilinear between the middles of cells."""
    return clearance_at(land, (x - land.x) * land.per_meter, (y - land.y) * land.per_meter)


@kernel
def clearance_at(land, a, b):
    """The same at a place in cells from the middle of the first one."""
    low, high, _, _, rise = _cell(land, a, b)
    return low + rise * (high - low)


@kernel
def _cell(land, a, b):
    """Bilinear: the distances below and above a place [m], how they grow eastward [m per cell], how far up it is."""
    rows, columns = land.distance.shape
    a = min(max(a, 0.0), columns - 1.0)
    b = min(max(b, 0.0), rows - 1.0)
    i = min(int(a), columns - 2) if columns > 1 else 0
    j = min(int(b), rows - 2) if rows > 1 else 0
    share, rise = a - i, b - j
    left, right = np.uintp(i), np.uintp(min(i + 1, columns - 1))
    down, up = np.uintp(j), np.uintp(min(j + 1, rows - 1))
    east_low = land.distance[down, right] - land.distance[down, left]
    east_high = land.distance[up, right] - land.distance[up, left]
    low = land.distance[down, left] + share * east_low
    high = land.distance[up, left] + share * east_high
    return low, high, east_low, east_high, rise


@kernel
def room_at(land, a, b):
    """What the distance to the shore is at least [m], or how far below 0 at least, within half a block of a place.

    0 where the shore is near, or may be. a, b : the place in cells from the middle of the first one
    """
    rows, columns = land.blocks.shape
    i = min(max(int(a), 0) // BLOCK, columns - 1)
    j = min(max(int(b), 0) // BLOCK, rows - 1)
    return 0.5 * land.cell * land.blocks[np.uintp(j), np.uintp(i)]


@kernel
def seaward(land, x, y):
    """The direction, of length 1, in which the distance to the shore grows fastest; (0, 0) where it grows nowhere."""
    _, out_x, out_y = _shore(land, x, y)
    return out_x, out_y


@kernel
def _shore(land, x, y):
    """Distance to the shore [m], and the direction, of length 1, in which it grows: that of the cell's own surface."""
    low, high, east_low, east_high, rise = _cell(land, (x - land.x) * land.per_meter, (y - land.y) * land.per_meter)
    dx = east_low + rise * (east_high - east_low)
    dy = high - low
    size = math.sqrt(dx * dx + dy * dy)
    if size == 0.0:
        return low + rise * (high - low), 0.0, 0.0
    return low + rise * (high - low), dx / size, dy / size


@kernel
def sailed(land, x, y, to_x, to_y):
    """Where something ends [m] that sets out from (x, y) for (to_x, to_y): land stops it, and it slides along."""
    dx = to_x - x
    dy = to_y - y
    length = math.sqrt(dx * dx + dy * dy)
    far = length + land.cell
    a, b = (x - land.x) * land.per_meter, (y - land.y) * land.per_meter
    if room_at(land, a, b) > far or clearance_at(land, a, b) > far:
        return to_x, to_y
    pieces = int(2.0 * length * land.per_meter) + 1  # of half a cell: nothing is jumped over
    dx /= pieces
    dy /= pieces
    for _ in range(pieces):
        next_x, next_y, free = _off_land(land, x + dx, y + dy)
        if free < 0.0:
            break
        x, y = next_x, next_y
    return x, y


@kernel
def _off_land(land, x, y):
    """The place itself, or one at the shore nearby, and the distance to the shore there [m], below 0 if not found."""
    free, out_x, out_y = _shore(land, x, y)
    for _ in range(3):
        if free >= 0.0:
            break
        x += (1e-3 * land.cell - free) * out_x
        y += (1e-3 * land.cell - free) * out_y
        free, out_x, out_y = _shore(land, x, y)
    return x, y, free


@kernel
def anywhere_afloat(land, half_x, half_y, draw):
    """A place at sea, by chance, uniform in +- half_x, half_y [m]; on open water what draws 0 and 1 alone say.

    Where so little water is found that no try meets it, the last try: whoever goes there ends at the shore.
    """
    x = half_x * (2.0 * uniform(draw, 0) - 1.0)
    y = half_y * (2.0 * uniform(draw, 1) - 1.0)
    again = split(draw, _REDRAWN)
    for attempt in range(_TRIES):
        if clearance(land, x, y) > 0.0:
            return x, y
        x = half_x * (2.0 * uniform(again, 2 * attempt) - 1.0)
        y = half_y * (2.0 * uniform(again, 2 * attempt + 1) - 1.0)
    return x, y


@kernel
def afloat(land, x, y):
    """The place itself, or the water that is nearest: rings of growing size are tried, a cell wider each."""
    if clearance(land, x, y) > 0.0:
        return x, y
    rows, columns = land.distance.shape
    for ring in range(1, rows + columns):
        found_x, found_y, most = x, y, 0.0
        for spoke in range(8 * ring):
            angle = 2.0 * math.pi * spoke / (8 * ring)
            there_x = x + ring * land.cell * math.cos(angle)
            there_y = y + ring * land.cell * math.sin(angle)
            if _within(land, there_x, there_y):
                free = clearance(land, there_x, there_y)
                if free > most:
                    found_x, found_y, most = there_x, there_y, free
        if most > 0.0:
            return found_x, found_y
    return x, y


@kernel
def _within(land, x, y):
    """Whether a place is on the raster, a cell off its edge: beyond the arena nobody goes."""
    rows, columns = land.distance.shape
    a = (x - land.x) / land.cell
    b = (y - land.y) / land.cell
    return 1.0 <= a <= columns - 2.0 and 1.0 <= b <= rows - 2.0
