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
from shoal.world.sea.land import BLOCK, clearance_at, room_at

_STEEPEST = math.sqrt(2.0)  # how fast the distance between the middles of cells may change, at most
_BLUNT = 0.5  # cells from the shore, on land, that do not hide: a raster knows the shore no better
_FINE = 8  # samples in a cell, where one is too rough
_SURE = 0.1  # cells that a line is below that so that no two samples miss it: more than STEEPEST / 2 / FINE
_DEEP = 4.0  # cells below it: a line that is there is hidden for long enough
_OPEN = 2.0  # cells to the shore that are room enough: how soon a line must be looked at again hardly matters
_WIDE = 1.0  # the same, where a stretch is known from its ends
_TIGHT = 0.2  # the same, where samples are a cell apart


class Places(NamedTuple):
    """Where N agents are, or were when they spoke: x, y (N,) [m]; the square of the range of a radio [m^2]."""

    x: Floats
    y: Floats
    range_square: float


class Sight(NamedTuple):
    """What is known of the pairs of N agents, in L lanes.

    until : (N, L) how long the way of the first of a pair may grow before it must be looked at again [m], below 0: land
        hides the other; that of the second is in the other half
    way : (N,) how far each has gone [m], and some
    x, y : (N,) where they were last [m]
    where : (N, L) how far along the line was land, 0 to 1: it is looked for there first
    hidden : (N,) how many others land hides from each
    """

    until: Floats
    way: Floats
    x: Floats
    y: Floats
    where: Floats
    hidden: npt.NDArray[np.int64]


def new_sight(agents: int, lanes: int) -> Sight:
    """Nothing is known, but that nobody hides from itself, or in a lane that nobody is in."""
    until = aligned_zeros(agents * lanes).reshape((agents, lanes))
    until[:, agents:] = np.inf
    np.fill_diagonal(until[:, :agents], np.inf)
    return Sight(
        until=until,
        way=np.ones(agents),
        x=np.zeros(agents),
        y=np.zeros(agents),
        where=np.zeros((agents, lanes)),
        hidden=np.zeros(agents, np.int64),
    )


class Look(NamedTuple):
    """What is known of a line: how far its deepest place is below what hides [m], and where, 0 to 1; its room [m].

    deepest : 0 where nothing hides; slack : the least distance to the shore
    """

    deepest: float
    there: float
    slack: float


class Line(NamedTuple):
    """From (a, b) by (da, db), in cells; fall : how much the distance to the shore may change along a stretch [m]."""

    a: float
    b: float
    da: float
    db: float
    fall: float


@kernel
def in_sight(land, x, y, other_x, other_y):
    """Whether no land lies between two places [m]; the same both ways. Cheap where both are far from the shore.

    Half a cell of land does not count: the places themselves may lie at the shore.
    """
    seen, _, _ = look_along(land, x, y, other_x, other_y)
    return seen


@kernel
def look_along(land, x, y, other_x, other_y):
    """Look from the western of two places to the other: land hides where one of the samples along the line is on it.

    Samples are at most an eighth of a cell apart. Which of them are looked at changes no answer: the others are too far
    from the shore. Those looked at wait for no other, so that a processor can fetch them together.

    Returns
    -------
    whether no land lies between; how far both may move, at least, before that may change [m]; how far along the way is
    the deepest land that was found, 0 to 1
    """
    if other_x < x or (other_x == x and other_y < y):
        x, y, other_x, other_y = other_x, other_y, x, y
    a, b = (x - land.x) * land.per_meter, (y - land.y) * land.per_meter
    da, db = (other_x - x) * land.per_meter, (other_y - y) * land.per_meter
    length = math.sqrt(da * da + db * db)
    stretches = int(length / BLOCK) + 1
    share = 1.0 / stretches
    line = Line(a, b, da, db, _STEEPEST * land.cell * length / stretches)
    free, last = _free(land, line, 0.0), _free(land, line, 1.0)
    slack = 0.5 * (free + last - line.fall * stretches)
    if slack > 0.0:
        return True, slack / _STEEPEST, 0.0
    found = Look(min(free, 0.0), 0.0, np.inf)
    known = 0  # free is that of the start of this stretch
    for number in range(stretches):
        middle = (number + 0.5) * share
        room = room_at(land, a + middle * da, b + middle * db)
        if room >= _OPEN * land.cell:
            found = Look(found.deepest, found.there, min(found.slack, room))
        elif room <= -land.cell:
            if room + _BLUNT * land.cell < found.deepest:
                found = Look(room + _BLUNT * land.cell, middle, 0.0)
        else:
            if known != number:
                free = _free(land, line, number * share)
            last = _free(land, line, (number + 1) * share)
            found = _look_closely(land, line, number * share, share, free, last, found)
            free, known = last, number + 1
        if found.deepest < -_DEEP * land.cell:
            break
    if found.deepest < 0.0:
        return False, max(-found.deepest - _SURE * land.cell, 0.0) / _STEEPEST, found.there
    return True, max(found.slack, 0.0) / _STEEPEST, 0.0


@kernel
def _free(land, line, share):
    """Distance to land that hides at a place along a line [m]."""
    return clearance_at(land, line.a + share * line.da, line.b + share * line.db) + _BLUNT * land.cell


@kernel
def _look_closely(land, line, start, share, free, last, found):
    """Look at a stretch that begins at `start` and is a `share` of the line; free, last : the distances at its ends."""
    deepest, there, slack = found
    if last < deepest:
        deepest, there = last, start + share
    low = 0.5 * (free + last - line.fall)
    if low >= _WIDE * land.cell:
        return Look(deepest, there, min(slack, low))
    share /= BLOCK
    fall = line.fall / BLOCK
    for piece in range(BLOCK):
        after = last
        if piece < BLOCK - 1:
            after = _free(land, line, start + (piece + 1) * share)
            if after < deepest:
                deepest, there = after, start + (piece + 1) * share
        low = 0.5 * (free + after - fall)
        if low < _TIGHT * land.cell and deepest >= 0.0:
            low, before = np.inf, free
            for number in range(1, _FINE + 1):
                then = after
                if number < _FINE:
                    at = start + (piece + number / _FINE) * share
                    then = _free(land, line, at)
                    if then < deepest:
                        deepest, there = then, at
                low = min(low, 0.5 * (before + then - fall / _FINE))
                before = then
        slack = min(slack, low)
        free = after
    return Look(deepest, there, slack)


@kernel
def _still_hidden(land, x, y, other_x, other_y, share):
    """How far both may move before a place on the way from the western to the other is no longer on land [m]."""
    if other_x < x or (other_x == x and other_y < y):
        x, y, other_x, other_y = other_x, other_y, x, y
    a, b = x + share * (other_x - x), y + share * (other_y - y)
    a, b = (a - land.x) * land.per_meter, (b - land.y) * land.per_meter
    depth = -room_at(land, a, b)
    if depth < _DEEP * land.cell:
        depth = -clearance_at(land, a, b)
    return (depth - (_BLUNT + _SURE) * land.cell) / _STEEPEST


@kernel
def hide_behind_land(links, sight, places, land, neighbors, first, agents):
    """Unlink those whom land hides from the agents from `first` on; links.wanted becomes k, or all that are left."""
    square, hidden, until = links.square, sight.hidden, sight.until
    lanes = min(links.reach.size, agents - first)
    _go_on(sight, places, agents)
    for i in range(agents):
        way = sight.way[i]
        due = 0
        for j in range(until.shape[1]):
            due += 1 if abs(until[i, j]) < way else 0
        if due > 0:
            _look_around(sight, places, land, i, due)
    for j in range(agents):
        if hidden[j] > 0:
            for i in range(lanes):  # unsigned: else it does not compile to vector code
                behind = until[np.uintp(j), np.uintp(first + i)] < 0.0
                was = square[np.uintp(j), np.uintp(i)]
                square[np.uintp(j), np.uintp(i)] = np.inf if behind else was
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
def _look_around(sight, places, land, i, due):
    """Look from an agent at those others, `due` of them, where that may have changed, as far as radios reach."""
    until, way = sight.until, sight.way[i]
    j = 0
    while due > 0:
        if abs(until[i, j]) < way:
            due -= 1
            before = 1 if until[i, j] < 0.0 else 0
            seen, slack = _looked(sight, places, land, i, j)
            sign = 1.0 if seen else -1.0
            until[i, j] = sign * (way + slack)
            until[j, i] = sign * (sight.way[j] + slack)
            sight.where[j, i] = sight.where[i, j]
            change = (0 if seen else 1) - before
            sight.hidden[i] += change
            sight.hidden[j] += change
        j += 1


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
    seen, slack, sight.where[i, j] = look_along(land, x, y, other_x, other_y)
    return seen, slack
