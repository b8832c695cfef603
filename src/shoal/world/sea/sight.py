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
from shoal.world.sea.land import clearance, room

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

    until : (N, L) what `travelled` may grow to before a pair must be looked at again [m]; below 0: land hides it
    soonest : (N,) the least of them of each speaker [m]
    where : (N, L) how far along the way was land, 0 to 1: it is looked for there first
    hidden : (L,) how many speakers land hides from a listener
    travelled : (1,) sum over the steps of the longest way that anybody went [m], and some
    speaker_x, speaker_y : (N,), listener_x, listener_y : (L,) where they were last [m]
    """

    until: Floats
    soonest: Floats
    where: Floats
    hidden: npt.NDArray[np.int64]
    travelled: Floats
    speaker_x: Floats
    speaker_y: Floats
    listener_x: Floats
    listener_y: Floats


def new_sight(agents: int, lanes: int) -> Sight:
    """Nothing is known, but that nobody hides from itself; of no agents, nothing is kept."""
    until = aligned_zeros(agents * lanes).reshape((agents, lanes))
    np.fill_diagonal(until[:, :agents], np.inf)
    return Sight(
        until=until,
        soonest=np.zeros(agents),
        where=np.zeros(until.shape),
        hidden=np.zeros(lanes, np.int64),
        travelled=np.ones(1),
        speaker_x=np.zeros(agents),
        speaker_y=np.zeros(agents),
        listener_x=np.zeros(lanes),
        listener_y=np.zeros(lanes),
    )


@kernel
def in_sight(land, x, y, other_x, other_y):
    """Whether no land lies between two places [m]; the same both ways. Cheap where both are far from the shore."""
    seen, _, _ = look_along(land, x, y, other_x, other_y)
    return seen


@kernel
def look_along(land, x, y, other_x, other_y):
    """Look from the western of two places to the other.

    Returns
    -------
    whether no land lies between; how far both may move, at least, before that may change [m]; how far along the way is
    the deepest land that was found, 0 to 1
    """
    if other_x < x or (other_x == x and other_y < y):
        x, y, other_x, other_y = other_x, other_y, x, y
    dx = other_x - x
    dy = other_y - y
    distance = math.sqrt(dx * dx + dy * dy)
    free = clearance(land, x, y)
    slack = 0.5 * (free + clearance(land, other_x, other_y) - _STEEPEST * distance)
    if slack > 0.0:
        return True, slack / _STEEPEST, 0.0
    deepest = 0.0
    there = 0.0
    tries = min(int(distance / (_FAR * land.cell)), _TRIES)
    for number in range(tries):  # most of what is hidden is behind much land
        share = (number + 0.5) / tries
        after = room(land, x + share * dx, y + share * dy)
        if after < deepest:
            deepest = after
            there = share
    slack = max(free, 0.0)
    gone = 0.0 if deepest >= -_DEEP * land.cell else distance
    while gone < distance:
        step = min(max(abs(free) / _STEEPEST, _SHORTEST * land.cell), distance - gone)
        gone += step
        share = gone / distance
        after = room(land, x + share * dx, y + share * dy)
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
    depth = -room(land, x + share * (other_x - x), y + share * (other_y - y))
    return (depth - _SURE * land.cell) / _STEEPEST


@kernel
def hide_behind_land(links, sight, speakers, swarm, land, first, agents):
    """Unlink speakers that land hides from the agents from `first` on; links.wanted becomes k, or all that are left."""
    square, hidden, until = links.square, sight.hidden, sight.until
    lanes = min(links.reach.size, agents - first)
    if until.size == 0:  # one listener after the other: what is known would be another's
        _look_at_all(square, hidden, speakers, swarm, land, first, lanes, agents)
    else:
        sight.travelled[0] += _farthest(sight, speakers, swarm, lanes, agents)
        for j in range(agents):
            if sight.soonest[j] < sight.travelled[0]:
                _look_again(sight, speakers, swarm, land, j, j if speakers.mutual else lanes)
        for j in range(agents):
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
def _farthest(sight, speakers, swarm, lanes, agents):
    """The longest way that anybody went since last time [m]; keeps where they are now."""
    longest = 0.0
    for j in range(agents):
        dx, dy = speakers.x[j] - sight.speaker_x[j], speakers.y[j] - sight.speaker_y[j]
        longest = max(longest, dx * dx + dy * dy)
        sight.speaker_x[j], sight.speaker_y[j] = speakers.x[j], speakers.y[j]
    for i in range(lanes):
        dx, dy = swarm.x[i] - sight.listener_x[i], swarm.y[i] - sight.listener_y[i]
        longest = max(longest, dx * dx + dy * dy)
        sight.listener_x[i], sight.listener_y[i] = swarm.x[i], swarm.y[i]
    return math.sqrt(longest)


@kernel
def _look_again(sight, speakers, swarm, land, j, lanes):
    """Look which of the first listeners see speaker j, where that may have changed; if mutual, it sees them, too.

    A pair out of range is not looked at before it may be in range.
    """
    range_square = speakers.range_square
    travelled = sight.travelled[0]
    until, hidden = sight.until, sight.hidden
    soonest = np.inf
    for i in range(lanes):
        if abs(until[j, i]) < travelled:
            before = 1 if until[j, i] < 0.0 else 0
            dx, dy = swarm.x[i] - speakers.x[j], swarm.y[i] - speakers.y[j]
            square = dx * dx + dy * dy
            if square > range_square:
                until[j, i] = travelled + 0.5 * (math.sqrt(square) - math.sqrt(range_square))
            else:
                until[j, i] = _looked(sight, speakers, swarm, land, j, i)
            change = (1 if until[j, i] < 0.0 else 0) - before
            hidden[i] += change
            if speakers.mutual:
                until[i, j] = until[j, i]
                hidden[j] += change
        soonest = min(soonest, abs(until[j, i]))
    sight.soonest[j] = soonest


@kernel
def _looked(sight, speakers, swarm, land, j, i):
    """What `until` is of a pair that is looked at now: first where land was last time."""
    x, y, other_x, other_y = swarm.x[i], swarm.y[i], speakers.x[j], speakers.y[j]
    travelled = sight.travelled[0]
    if sight.where[j, i] > 0.0:
        slack = _still_hidden(land, x, y, other_x, other_y, sight.where[j, i])
        if slack > 0.0:
            return -(travelled + slack)
    seen, slack, sight.where[j, i] = look_along(land, x, y, other_x, other_y)
    return travelled + slack if seen else -(travelled + slack)
