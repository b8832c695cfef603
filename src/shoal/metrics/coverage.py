"""Coverage: how much of the arena agents look at within a window of steps, and how fast they sweep it."""

import math

from shoal.core.kernel import kernel

WINDOW = 1000  # steps
CELLS = 32  # along each side of the arena
_EVERY = 4  # steps between looks: an agent passes less than a cell meanwhile
_FIRST = WINDOW // 10  # the steps at the start of a window that the sweep rate is measured over


@kernel
def tally_coverage(tally, batch, world, swarm, number):
    """Mark the cells of a grid within reach of an agent's sensor; count them at a tenth and at the end of each window.

    tally.seen holds for each cell the last window in which it was seen, plus one.
    """
    if number % _EVERY != 0:
        return
    window = number // WINDOW + 1
    seen = tally.seen
    wide = CELLS / (2.0 * world.half_x)
    high = CELLS / (2.0 * world.half_y)
    for i in range(world.agents):
        if swarm.alive[i] > 0.0:
            column = math.floor((swarm.x[i] + world.half_x) * wide)
            row = math.floor((swarm.y[i] + world.half_y) * high)
            seen[0, min(max(row, 0), CELLS - 1) * CELLS + min(max(column, 0), CELLS - 1)] = window
    into = number % WINDOW
    if into == _FIRST - _EVERY or into == WINDOW - _EVERY:
        covered = 0
        for cell in range(seen.shape[1]):
            covered += seen[0, cell] == window
        share = covered / seen.shape[1]
        if into == WINDOW - _EVERY:
            tally.windows[batch] += 1.0
            tally.covered[batch] += share
        else:
            tally.sweeps[batch] += 1.0
            tally.swept[batch] += share
