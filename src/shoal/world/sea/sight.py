"""What land hides: whether a line between two places crosses it.

Radios ask for every pair in every step, so what was found is kept for as long as it must hold: the distance to the
shore cannot change faster along a way than its length, and neither can that of a line between two places that move.
"""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.compiler.kernel import kernel
from shoal.core.agents import Floats, aligned_zeros
from shoal.world.sea.land import clearance_at, room_at

_STEEPEST = math.sqrt(2.0)  # how fast the distance between the middles of cells may change, at most
_BLUNT = 0.5  # cells from the shore, on land, that do not hide: a raster knows the shore no better
_SHORTEST = 0.25  # step along a line, in cells
_SURE = 0.2  # cells that a line is below that so that no step leaps over it: more than SHORTEST / STEEPEST
_DEEP = 4.0  # cells below it: a line that is there is hidden for long enough
_FAR = 16.0  # cells between places along a line that are tried first
_TRIES = 32  # of them, at most


class Places(NamedTuple):
    """Where N agents are, or were when they spoke: x, y (N,) [m]; the square of the range of a radio [m^2]."""

    x: Floats
    y: Floats
    range_square: float


class Sight(NamedTuple):
    """What is known of the pairs of N agents, in L lanes.

    until : (N, L) how long the way of the first of a pair may grow before it must be looked at again [m], below 0: land
        hides the other; that of the second is in the other half
    soonest : (N,) the least of each row [m]
    way : (N,) how far each has gone [m], and some
    x, y : (N,) where they were last [m]
    where : (N, L) how far along the line was land, 0 to 1: it is looked for there first
    hidden : (N,) how many others land hides from each
    """

    until: Floats
    soonest: Floats
    way: Floats
    x: Floats
    y: Floats
    where: Floats
    hidden: npt.NDArray[np.int64]


def new_sight(agents: int, lanes: int) -> Sight:
    """Nothing is known, but that nobody hides from itself."""
    until = aligned_zeros(agents * lanes).reshape((agents, lanes))
    np.fill_diagonal(until[:, :agents], np.inf)
    return Sight(
        until=until,
        soonest=np.zeros(agents),
        way=np.ones(agents),
        x=np.zeros(agents),
        y=np.zeros(agents),
        where=np.zeros((agents, lanes)),
        hidden=np.zeros(agents, np.int64),
    )


@kernel
def in_sight(land, x, y, other_x, other_y):
    """Whether no land lies between two places [m]; the same both ways. Cheap where both are far from the shore.

    Half a cell of land does not count: the places themselves may lie at the shore.
    """
    seen, _, _ = look_along(land, x, y, other_x, other_y, True)
    return seen


@kernel
def look_along(land, x, y, other_x, other_y, doubt):
    """Look from the western of two places to the other; `doubt`: land is likely, a first try here and there finds it.

    Returns
    -------
    whether no land lies between; how far both may move, at least, before that may change [m]; how far along the way is
    the deepest land that was found, 0 to 1
    """
    if other_x < x or (other_x == x and other_y < y):
        x, y, other_x, other_y = other_x, other_y, x, y
    a, b = (x - land.x) * land.per_meter, (y - land.y) * land.per_meter
    da, db = (other_x - x) * land.per_meter, (other_y - y) * land.per_meter
    distance = math.sqrt(da * da + db * db) * land.cell
    blunt = _BLUNT * land.cell
    free = clearance_at(land, a, b) + blunt
    slack = 0.5 * (free + clearance_at(land, a + da, b + db) + blunt - _STEEPEST * distance)
    if slack > 0.0:
        return True, slack / _STEEPEST, 0.0
    deepest = 0.0
    there = 0.0
    tries = min(int(distance / (_FAR * land.cell)), _TRIES) if doubt else 0
    for number in range(tries):  # most of what is hidden is behind much land
        share = (number + 0.5) / tries
        after = room_at(land, a + share * da, b + share * db) + blunt
        if after < deepest and after < -_SURE * land.cell:  # else a step may leap over it
            deepest = after
            there = share
    slack = max(free, 0.0)
    share = 0.0 if deepest >= -_DEEP * land.cell else 1.0
    shortest, steps = _SHORTEST * land.cell, 1.0 / max(distance, 1e-9)
    while share < 1.0:
        step = max(abs(free) / _STEEPEST, shortest)
        share = min(share + step * steps, 1.0)
        after = room_at(land, a + share * da, b + share * db) + blunt
        if after < deepest:
            deepest = after
            there = share
            if deepest < -_DEEP * land.cell:
                break
        slack = min(slack, 0.5 * (free + after - _STEEPEST * step))
        free = after
    if deepest < 0.0:
        return False, max(-deepest - _SURE * land.cell, 0.0) / _STEEPEST, there
    return True, max(slack, 0.0) / _STEEPEST, 0.0


@kernel
def _still_hidden(land, x, y, other_x, other_y, share):
    """How far both may move before a place on the way from the western to the other is no longer on land [m]."""
    if other_x < x or (other_x == x and other_y < y):
        x, y, other_x, other_y = other_x, other_y, x, y
    a, b = x + share * (other_x - x), y + share * (other_y - y)
    depth = -room_at(land, (a - land.x) * land.per_meter, (b - land.y) * land.per_meter)
    return (depth - (_BLUNT + _SURE) * land.cell) / _STEEPEST


@kernel
def hide_behind_land(links, sight, places, land, neighbors, first, agents):
    """Unlink those whom land hides from the agents from `first` on; links.wanted becomes k, or all that are left."""
    square, hidden, until = links.square, sight.hidden, sight.until
    lanes = min(links.reach.size, agents - first)
    _go_on(sight, places, agents)
    for i in range(agents):
        if sight.soonest[i] < sight.way[i]:
            _look_around(sight, places, land, i, agents)
    for j in range(agents):
        if hidden[j] > 0:
            for i in range(lanes):
                square[j, i] = np.inf if until[j, first + i] < 0.0 else square[j, i]
    for i in range(links.wanted.size):
        links.wanted[i] = min(neighbors[first + i], agents - 1 - hidden[first + i]) if i < lanes else 0


@kernel
def _go_on(sight, places, agents):
    """Let ways grow by how far each went since last time [m], and keep where they are now."""
    for i in range(agents):
        dx, dy = places.x[i] - sight.x[i], places.y[i] - sight.y[i]
        sight.way[i] += math.sqrt(dx * dx + dy * dy)
        sight.x[i], sight.y[i] = places.x[i], places.y[i]


@kernel
def _look_around(sight, places, land, i, agents):
    """Look from an agent at all others where that may have changed, as far as radios reach."""
    until, way = sight.until, sight.way[i]
    soonest = np.inf
    for j in range(agents):
        if abs(until[i, j]) < way:
            before = 1 if until[i, j] < 0.0 else 0
            seen, slack = _looked(sight, places, land, i, j)
            sign = 1.0 if seen else -1.0
            until[i, j] = sign * (way + slack)
            until[j, i] = sign * (sight.way[j] + slack)
            sight.where[j, i] = sight.where[i, j]
            sight.soonest[j] = min(sight.soonest[j], sight.way[j] + slack)
            change = (0 if seen else 1) - before
            sight.hidden[i] += change
            sight.hidden[j] += change
        soonest = min(soonest, abs(until[i, j]))
    sight.soonest[i] = soonest


@kernel
def _looked(sight, places, land, i, j):
    """Whether a pair sees each other, and how far both may go before that may change [m].

    Not looked at before it may be in range; and first where land was.
    """
    x, y, other_x, other_y = places.x[i], places.y[i], places.x[j], places.y[j]
    dx, dy = other_x - x, other_y - y
    square = dx * dx + dy * dy
    if square > places.range_square:
        return True, 0.5 * (math.sqrt(square) - math.sqrt(places.range_square))
    if sight.where[i, j] > 0.0:
        slack = _still_hidden(land, x, y, other_x, other_y, sight.where[i, j])
        if slack > 0.0:
            return False, slack
    seen, slack, sight.where[i, j] = look_along(land, x, y, other_x, other_y, sight.until[i, j] <= 0.0)
    return seen, slack
