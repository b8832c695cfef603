"""How close agents come to each other: does repulsion keep them from colliding?"""

import math
from typing import Any

from shoal.compiler.kernel import kernel
from shoal.metrics.contract import Facts, Measurement, Metric, Sum

EVERY = 25  # steps between two looks: a hundredth of the time of a run
NONE_SEEN = 1e300  # [m^2] where the smallest square begins: finite, so that tallies can be subtracted


@kernel
def tally_closest(tally, step, world, swarm, targets, scratch):
    """Keep the smallest squared distance [m^2] between two agents present, at the start of every 25th step."""
    if step.number % EVERY != 0:
        return
    least = tally.closest[0]
    for i in range(world.agents):
        least = least_square(swarm, i, least)
    tally.closest[0] = least


@kernel
def least_square(swarm, i, least):
    """The least of a square [m^2] and those of the distances from agent i to the present ones before it."""
    x = swarm.x[i]
    y = swarm.y[i]
    if swarm.alive[i] > 0.0:
        for j in range(i):
            dx = swarm.x[j] - x
            dy = swarm.y[j] - y
            square = dx * dx + dy * dy
            if square < least and swarm.alive[j] > 0.0:
                least = square
    return least


def closest(tally: Any, facts: Facts) -> float:
    """The smallest distance [m], NaN if no two agents were ever there."""
    square = float(tally.closest.min(initial=NONE_SEEN))
    return math.sqrt(square) if square < NONE_SEEN else float("nan")


MEASUREMENT = Measurement(
    "closest",
    sums=(
        Sum("closest", "m^2", "not a sum: least square of a distance between two agents", ("run",), start=NONE_SEEN),
    ),
    before_move=tally_closest,
    metrics=(
        Metric(
            "closest",
            "m",
            "smallest distance between two agents, looked at every 25 steps; of one run, and the longer the smaller",
            closest,
            better="higher",
            once=True,
        ),
    ),
    order=6,
)
