"""Coverage: how much of the arena agents pass through within a window of steps, and how fast they reach new places."""

import math

from shoal.compiler.kernel import kernel
from shoal.metrics.contract import Measurement, Metric, Sum
from shoal.metrics.shares import share

WINDOW = 1000  # steps
CELLS = 32  # along each side of the arena
_FIRST = WINDOW // 10  # the steps at the start of a window that the rate is measured over


def reachable(width: float, height: float, margin: float) -> float:
    """Share of the cells that agents can be in, of an arena whose wall is `margin` inside its edge."""
    share = 1.0
    for side in (width, height):
        first = math.floor(margin / side * CELLS)
        last = min(math.floor((side - margin) / side * CELLS), CELLS - 1)
        share *= (last - first + 1) / CELLS
    return share


@kernel
def tally_coverage(tally, step, world, swarm, targets, scratch):
    """Mark the cells of a grid that agents are in; count them at a tenth and at the end of each window.

    An agent marks the cell that it is in at the start of a step, whatever its sensor's range. tally.seen holds for each
    cell 2 w in window w = 1, 2, ... if an agent was in it at the start of the window, 2 w + 1 if one came later: only
    these count for the rate, so that a swarm at rest has none.
    """
    mark_cells(tally, step, world, swarm, 0, world.agents)
    count_cells(tally, step)


@kernel
def mark_cells(tally, step, world, swarm, first, last):
    """Mark the cells that agents first..last are in."""
    window = step.number // WINDOW + 1
    seen = tally.seen
    mark = 2 * window + (1 if step.number % WINDOW > 0 else 0)
    wide = CELLS / (2.0 * world.half_x)
    high = CELLS / (2.0 * world.half_y)
    for i in range(first, last):
        if swarm.alive[i] > 0.0:
            column = int(math.floor((swarm.x[i] + world.half_x) * wide))  # noqa: RUF046  (on a card it is a float)
            row = int(math.floor((swarm.y[i] + world.half_y) * high))  # noqa: RUF046
            cell = min(max(row, 0), CELLS - 1) * CELLS + min(max(column, 0), CELLS - 1)
            if seen[0, cell] < 2 * window:
                seen[0, cell] = mark


@kernel
def count_cells(tally, step):
    """Count the marked cells, at a tenth and at the end of a window."""
    batch, window, into, seen = step.batch, step.number // WINDOW + 1, step.number % WINDOW, tally.seen
    if into == _FIRST or into == WINDOW - 1:
        covered = 0
        fresh = 0
        for cell in range(seen.shape[1]):
            covered += seen[0, cell] >= 2 * window
            fresh += seen[0, cell] == 2 * window + 1
        if into == _FIRST:
            tally.sweeps[batch] += 1.0
            tally.swept[batch] += fresh / seen.shape[1]
        else:
            tally.windows[batch] += 1.0
            tally.covered[batch] += covered / seen.shape[1]


MEASUREMENT = Measurement(
    "coverage",
    sums=(
        Sum("windows", "1", "windows of 1,000 steps that ended"),
        Sum("covered", "1", "share of the cells passed through, summed over these"),
        Sum("sweeps", "1", "windows whose first 100 steps ended"),
        Sum("swept", "1", "share of the cells newly passed through, summed over these"),
        Sum("seen", "1", "not a sum: when each cell was passed through last", ("run", CELLS * CELLS), integer=True),
    ),
    before_move=tally_coverage,
    metrics=(
        Metric(
            "coverage",
            "1",
            "share of the arena that agents pass through in 1,000 steps (grid of 32 x 32)",
            lambda t, f: share(t.covered, t.windows),
            better="higher",
            high="reach",
        ),
        Metric(
            "coverage_rate",
            "m^2/s",
            "area that agents newly pass through per second, over 100 steps",
            lambda t, f: share(t.swept, t.sweeps) * f.area / (100 * f.time_step),
            better="higher",
        ),
    ),
    order=5,
)
