"""How close agents come to each other: does repulsion keep them from colliding?"""

import math
from typing import Any

from shoal.compiler.kernel import kernel
from shoal.metrics.contract import Facts, Measurement, Metric, Sum
from shoal.world.cells import put_into_cells, row_of, span

EVERY = 25  # steps between two looks: a hundredth of the time of a run
NONE_SEEN = 1e300  # [m^2] where the smallest square begins: finite, so that tallies can be subtracted


@kernel
def tally_closest(tally, step, world, swarm, targets, scratch):
    """Keep the smallest squared distance [m^2] between two agents present, at the start of every 25th step."""
    if step.number % EVERY != 0:
        return
    if scratch.links.silent.size > 0:
        tally.closest[0] = least_in_cells(
            scratch.links.lists.cells, scratch.links.reach, swarm, world.agents, tally.closest[0]
        )
    else:
        tally.closest[0] = least_of_all(swarm, world.agents, tally.closest[0])


@kernel
def least_of_all(swarm, agents, least):
    """The smallest of the squared distances of all pairs present, and of `least`."""
    for i in range(agents):
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


@kernel
def least_in_cells(cells, reach, swarm, agents, least):
    """The same, of many agents: pairs that may be nearer than the nearest so far lie in cells around each other."""
    put_into_cells(cells, swarm, swarm, reach, agents, False)
    for turn in range(2):  # first with whoever comes next in a cell, so that there is little to look at after
        for p in range(agents):
            i = cells.order[p]
            if swarm.alive[i] > 0.0:
                x, y = swarm.x[i], swarm.y[i]
                if turn == 0:
                    least = _least(cells, swarm, i, p + 1, min(p + 2, agents), least)
                    continue
                radius = math.sqrt(least)
                for row in range(row_of(cells.grid, y - radius), row_of(cells.grid, y + radius) + 1):
                    begin, end = span(cells, x, x, y, y, radius, row)
                    least = _least(cells, swarm, i, max(begin, p + 1), end, least)
    return least


@kernel
def _least(cells, swarm, i, begin, end, least):
    """The smallest of `least` and the squared distances of agent i to those at places begin..end."""
    for q in range(begin, end):
        j = cells.order[q]
        dx = swarm.x[j] - swarm.x[i]
        dy = swarm.y[j] - swarm.y[i]
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
