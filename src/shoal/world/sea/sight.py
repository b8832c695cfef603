"""What land hides: whether a line between two places crosses it.

Radios ask for every pair in every step, so what was found is kept for as long as it must hold: the distance to the
shore cannot change faster along a way than its length, and neither can that of a line between two places that move.
"""

import math
from typing import NamedTuple

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.core.agents import Floats, aligned_zeros
from shoal.world.sea.land import clearance

_STEEPEST = math.sqrt(2.0)  # how fast the distance between the middles of cells may change, at most
_SHORTEST = 0.5  # step along a line, in cells
_SURE = 0.36  # cells that a line is below the shore so that no step leaps over it: more than SHORTEST / STEEPEST


class Places(NamedTuple):
    """Where speakers are, as waves go, (N,) each [m]."""

    x: Floats
    y: Floats


class Sight(NamedTuple):
    """What is known of the pairs of N speakers and L listeners.

    until : (N, L) what `travelled` may grow to before a pair must be looked at again [m]; below 0: land hides it
    travelled : (1,) sum over the steps of the longest way that anybody went [m], and some
    speaker_x, speaker_y : (N,), listener_x, listener_y : (L,) where they were last [m]
    """

    until: Floats
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
        until,
        np.ones(1),
        np.zeros(agents),
        np.zeros(agents),
        np.zeros(lanes if agents else 0),
        np.zeros(lanes if agents else 0),
    )


@kernel
def in_sight(land, x, y, other_x, other_y):
    """Whether no land lies between two places [m]. Cheap where both are far from the shore."""
    seen, _ = look_along(land, x, y, other_x, other_y)
    return seen


@kernel
def look_along(land, x, y, other_x, other_y):
    """Whether no land lies between two places, and how far both may move, at least, before that may change [m]."""
    dx = other_x - x
    dy = other_y - y
    distance = math.sqrt(dx * dx + dy * dy)
    free = clearance(land, x, y)
    slack = 0.5 * (free + clearance(land, other_x, other_y) - _STEEPEST * distance)
    if slack > 0.0:
        return True, slack / _STEEPEST
    slack = max(free, 0.0)
    deepest = 0.0
    gone = 0.0
    while gone < distance:
        step = min(max(abs(free) / _STEEPEST, _SHORTEST * land.cell), distance - gone)
        gone += step
        share = gone / distance
        after = clearance(land, x + share * dx, y + share * dy)
        if deepest < 0.0 <= after:
            break  # out of the first land on the way
        deepest = min(deepest, after)
        slack = min(slack, 0.5 * (free + after - _STEEPEST * step))
        free = after
    if deepest < 0.0:
        return False, max(-deepest - _SURE * land.cell, 0.0) / _STEEPEST
    return True, max(slack, 0.0) / _STEEPEST


@kernel
def hide_behind_land(links, sight, speakers, swarm, land, range_square, first, agents):
    """Unlink speakers, at Places, that land hides from the agents from `first` on."""
    square = links.square
    lanes = min(links.reach.size, agents - first)
    if sight.until.size == 0:  # one listener after the other: what is known would be another's
        for i in range(lanes):
            for j in range(agents):
                if square[j, i] <= range_square and not in_sight(
                    land, swarm.x[first + i], swarm.y[first + i], speakers.x[j], speakers.y[j]
                ):
                    square[j, i] = np.inf
        return
    sight.travelled[0] += _farthest(sight, speakers, swarm, lanes, agents)
    travelled = sight.travelled[0]
    for j in range(agents):
        unsure = False
        for i in range(lanes):
            until = sight.until[j, i]
            unsure |= abs(until) <= travelled
            square[j, i] = np.inf if until < -travelled else square[j, i]
        if unsure:
            for i in range(lanes):
                if abs(sight.until[j, i]) <= travelled and not _look_again(
                    sight, speakers, swarm, land, range_square, j, i
                ):
                    square[j, i] = np.inf


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
def _look_again(sight, speakers, swarm, land, range_square, j, i):
    """Whether listener i sees speaker j; a pair out of range is not looked at before it may be in range."""
    travelled = sight.travelled[0]
    dx = swarm.x[i] - speakers.x[j]
    dy = swarm.y[i] - speakers.y[j]
    square = dx * dx + dy * dy
    if square > range_square:
        sight.until[j, i] = travelled + 0.5 * (math.sqrt(square) - math.sqrt(range_square))
        return True
    seen, slack = look_along(land, swarm.x[i], swarm.y[i], speakers.x[j], speakers.y[j])
    sight.until[j, i] = travelled + slack if seen else -(travelled + slack)
    return seen
