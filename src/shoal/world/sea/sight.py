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
_SHORTEST = 0.1  # step along a line, in cells
_SURE = 0.08  # cells that a line is below the shore so that no step leaps over it: more than SHORTEST / STEEPEST
_DEEP = 4.0  # cells below the shore: a line that is there is hidden for long enough
_FAR = 16.0  # cells between places along a line that are tried first
_TRIES = 32  # of them, at most


class Speakers(NamedTuple):
    """Where N speakers are, as waves go: x, y (N,) [m]; the square of the range of a radio [m^2].

    mutual : they are where they listen, too: both see each other, or neither does
    """

    x: Floats
    y: Floats
    range_square: float
    mutual: bool


class Sight(NamedTuple):
    """What is known of the pairs of N speakers and L listeners.

    A pair must be looked at again when either has gone so far that what was seen may have changed.

    speaker_until : (N, L) how long the speaker's way may grow before [m], below 0: land hides it; listener_until :
        (L, N) the listener's. Where all speak from where they listen both are in the first one
    speaker_soonest, listener_soonest : (N,), (L,) the least of each row [m]
    speaker_way, listener_way : (N,), (L,) how far each has gone [m], and some
    speaker_x, speaker_y : (N,), listener_x, listener_y : (L,) where they were last [m]
    where : (N, L) how far along the way was land, 0 to 1: it is looked for there first
    hidden : (L,) how many speakers land hides from a listener
    """

    speaker_until: Floats
    listener_until: Floats
    speaker_soonest: Floats
    listener_soonest: Floats
    speaker_way: Floats
    listener_way: Floats
    speaker_x: Floats
    speaker_y: Floats
    listener_x: Floats
    listener_y: Floats
    where: Floats
    hidden: npt.NDArray[np.int64]


def new_sight(agents: int, lanes: int) -> Sight:
    """Nothing is known, but that nobody hides from itself; of no agents, nothing is kept."""
    speakers, listeners = (aligned_zeros(agents * lanes) for _ in range(2))
    speaker_until, listener_until = speakers.reshape((agents, lanes)), listeners.reshape((lanes, agents))
    np.fill_diagonal(speaker_until[:, :agents], np.inf)
    np.fill_diagonal(listener_until[:agents], np.inf)
    return Sight(
        speaker_until=speaker_until,
        listener_until=listener_until,
        speaker_soonest=np.zeros(agents),
        listener_soonest=np.zeros(lanes),
        speaker_way=np.ones(agents),
        listener_way=np.ones(lanes),
        speaker_x=np.zeros(agents),
        speaker_y=np.zeros(agents),
        listener_x=np.zeros(lanes),
        listener_y=np.zeros(lanes),
        where=np.zeros((agents, lanes)),
        hidden=np.zeros(lanes, np.int64),
    )


@kernel
def in_sight(land, x, y, other_x, other_y):
    """Whether no land lies between two places [m]; the same both ways. Cheap where both are far from the shore."""
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
    free = clearance_at(land, a, b)
    slack = 0.5 * (free + clearance_at(land, a + da, b + db) - _STEEPEST * distance)
    if slack > 0.0:
        return True, slack / _STEEPEST, 0.0
    deepest = 0.0
    there = 0.0
    tries = min(int(distance / (_FAR * land.cell)), _TRIES) if doubt else 0
    for number in range(tries):  # most of what is hidden is behind much land
        share = (number + 0.5) / tries
        after = room_at(land, a + share * da, b + share * db)
        if after < deepest and after < -_SURE * land.cell:  # else a step may leap over it
            deepest = after
            there = share
    slack = max(free, 0.0)
    share = 0.0 if deepest >= -_DEEP * land.cell else 1.0
    shortest, steps = _SHORTEST * land.cell, 1.0 / max(distance, 1e-9)
    while share < 1.0:
        step = max(abs(free) / _STEEPEST, shortest)
        share = min(share + step * steps, 1.0)
        after = room_at(land, a + share * da, b + share * db)
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
    return (depth - _SURE * land.cell) / _STEEPEST


@kernel
def hide_behind_land(links, sight, speakers, swarm, land, first, agents):
    """Unlink speakers that land hides from the agents from `first` on; links.wanted becomes k, or all that are left."""
    square, hidden, until = links.square, sight.hidden, sight.speaker_until
    lanes = min(links.reach.size, agents - first)
    if until.size == 0:  # one listener after the other: what is known would be another's
        _look_at_all(square, hidden, speakers, swarm, land, first, lanes, agents)
    else:
        _go_on(sight.speaker_way, sight.speaker_x, sight.speaker_y, speakers.x, speakers.y, agents)
        _look_around(sight, speakers, swarm, land, agents)
        for j in range(agents):
            if speakers.mutual and hidden[j] == 0:
                continue
            for i in range(lanes):
                square[j, i] = np.inf if until[j, i] < 0.0 else square[j, i]
    for i in range(links.wanted.size):
        links.wanted[i] = min(swarm.neighbors[first + i], agents - 1 - hidden[i]) if i < lanes else 0


@kernel
def _look_at_all(square, hidden, speakers, swarm, land, first, lanes, agents):
    """Look at every pair in range."""
    for i in range(lanes):
        hidden[i] = 0
        x, y = swarm.x[first + i], swarm.y[first + i]
        for j in range(agents):
            near = square[j, i] <= speakers.range_square
            if near and not in_sight(land, x, y, speakers.x[j], speakers.y[j]):
                square[j, i] = np.inf
                hidden[i] += 1


@kernel
def _go_on(way, last_x, last_y, x, y, agents):
    """Let ways grow by how far each went since last time [m], and keep where they are now, in place."""
    for i in range(agents):
        dx, dy = x[i] - last_x[i], y[i] - last_y[i]
        way[i] += math.sqrt(dx * dx + dy * dy)
        last_x[i], last_y[i] = x[i], y[i]


@kernel
def _look_around(sight, speakers, swarm, land, agents):
    """Look at the pairs of which either has gone far enough."""
    soonest, way, until = sight.speaker_soonest, sight.speaker_way, sight.speaker_until
    for j in range(agents):
        if soonest[j] < way[j]:
            least = np.inf
            for i in range(agents):
                if abs(until[j, i]) < way[j]:
                    _look_again(sight, speakers, swarm, land, j, i)
                least = min(least, abs(until[j, i]))
            soonest[j] = least
    if speakers.mutual:
        return
    soonest, way, until = sight.listener_soonest, sight.listener_way, sight.listener_until
    _go_on(way, sight.listener_x, sight.listener_y, swarm.x, swarm.y, agents)
    for i in range(agents):
        if soonest[i] < way[i]:
            least = np.inf
            for j in range(agents):
                if until[i, j] < way[i]:
                    _look_again(sight, speakers, swarm, land, j, i)
                least = min(least, until[i, j])
            soonest[i] = least


@kernel
def _look_again(sight, speakers, swarm, land, j, i):
    """Look whether listener i sees speaker j; if they speak where they listen, both see each other.

    A pair out of range is not looked at before it may be in range.
    """
    until, hidden = sight.speaker_until, sight.hidden
    before = 1 if until[j, i] < 0.0 else 0
    dx, dy = swarm.x[i] - speakers.x[j], swarm.y[i] - speakers.y[j]
    square = dx * dx + dy * dy
    seen, slack = True, 0.0
    if square > speakers.range_square:
        slack = 0.5 * (math.sqrt(square) - math.sqrt(speakers.range_square))
    else:
        seen, slack = _looked(sight, speakers, swarm, land, j, i)
    sign = 1.0 if seen else -1.0
    change = (0 if seen else 1) - before
    until[j, i] = sign * (sight.speaker_way[j] + slack)
    hidden[i] += change
    if speakers.mutual:
        until[i, j] = sign * (sight.speaker_way[i] + slack)
        sight.where[i, j] = sight.where[j, i]
        sight.speaker_soonest[i] = min(sight.speaker_soonest[i], sight.speaker_way[i] + slack)
        hidden[j] += change
    else:
        sight.listener_until[i, j] = sight.listener_way[i] + slack
        sight.listener_soonest[i] = min(sight.listener_soonest[i], sight.listener_way[i] + slack)


@kernel
def _looked(sight, speakers, swarm, land, j, i):
    """Whether a pair sees each other, and how far both may go before that may change [m]: first where land was."""
    x, y, other_x, other_y = swarm.x[i], swarm.y[i], speakers.x[j], speakers.y[j]
    if sight.where[j, i] > 0.0:
        slack = _still_hidden(land, x, y, other_x, other_y, sight.where[j, i])
        if slack > 0.0:
            return False, slack
    doubt = sight.speaker_until[j, i] <= 0.0
    seen, slack, sight.where[j, i] = look_along(land, x, y, other_x, other_y, doubt)
    return seen, slack
