"""The k nearest of one agent, however many are near it: where more are than a block of agents has room for.

So it is where agents are in heaps, or sit at one place. Of too many only the nearest are kept while others are looked
at.
"""

import math

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.world.cells import row_of, span
from shoal.world.nearest import square_between

_SLACK = 1e-6  # of a reach: rounding of edges of cells, and of squares in single precision
_MORE = 1.5  # agents to look for besides the k, so that they are among them in most steps
_INDEX = (1 << 32) - 1  # tells the compiler that an index is not negative


@kernel
def search_one(lists, p, k, reach, reception, swarm):
    """Put the k nearest of the agent at place p into lists.found, or all that it can hear; return how many.

    reach : (N,) first guesses of how far each hears [m^2]; the agent's is set to a better one
    """
    cells = lists.cells
    i = cells.order[p]
    if k <= 0:
        return 0
    limit = reach[i]
    said_x = cells.x[p]
    cells.x[p] = np.nan  # nobody hears itself
    while True:
        limit = limit if reception.by_truth else min(limit, reception.range_square)
        count = _look_around(lists, p, k, limit, reception, swarm)
        everywhere = limit >= reception.range_square and not reception.by_truth
        if count >= k or everywhere or _covers(cells, p, limit):
            break
        limit *= max(1.5, min(16.0, (k + 2.0) / (count + 1.0)))
    cells.x[p] = said_x
    if count >= k:
        reach[i] = max(limit * ((k + _MORE) / count), 1e-300)
    return _keep_nearest(lists, count, k)


@kernel
def _covers(cells, p, limit):
    """Whether all agents are nearer than the root of `limit` to the one at place p."""
    grid = cells.grid
    x, y = cells.own_x[p], cells.own_y[p]
    right, top = grid[0] + grid[4] / grid[2], grid[1] + grid[5] / grid[3]
    dx, dy = max(abs(x - grid[0]), abs(x - right)), max(abs(y - grid[1]), abs(y - top))
    return not limit < 1.01 * (dx * dx + dy * dy)  # of an agent that is nowhere, too


@kernel
def _look_around(lists, p, k, limit, reception, swarm):
    """Put all within the root of `limit` of the agent at place p into lists.found; of too many, the k nearest at least.

    Goes by rows of cells, in each as far as the circle does.
    """
    cells, found, distance = lists.cells, lists.found, lists.distance
    grid = cells.grid
    x, y = cells.own_x[p], cells.own_y[p]
    radius = math.sqrt(limit) * (1.0 + _SLACK)
    count = 0
    row, last = row_of(grid, y - radius), row_of(grid, y + radius)
    next_begin, next_end = span(cells, x, x, y, y, radius, row)
    while row <= last:
        begin, end = next_begin, next_end
        row += 1
        if row <= last:
            next_begin, next_end = span(cells, x, x, y, y, radius, row)  # now: a processor works on both at once
        while begin < end:
            if count == found.size:
                count = _hear(lists, p, count, reception, swarm)
                count = _keep_nearest(lists, count, k)
                if count == k:
                    limit = 0.0
                    for n in range(count):
                        limit = max(limit, distance[n])
            stop = min(end, begin + found.size - count)
            for q in range(begin, stop):
                square = square_between(x, y, cells.x[q & _INDEX], cells.y[q & _INDEX], reception.single)
                distance[count & _INDEX] = square
                found[count & _INDEX] = q
                count += 1 if square <= limit else 0
            begin = stop
    return _hear(lists, p, count, reception, swarm)


@kernel
def _hear(lists, p, count, reception, swarm):
    """Leave out of `count` found those out of range where reports do not say quite where agents are."""
    if not reception.by_truth:
        return count
    found, distance, order = lists.found, lists.distance, lists.cells.order
    x, y = swarm.x[order[p]], swarm.y[order[p]]
    kept = 0
    for n in range(count):
        j = order[found[n]]
        dx, dy = swarm.x[j] - x, swarm.y[j] - y
        found[kept], distance[kept] = found[n], distance[n]
        kept += 1 if dx * dx + dy * dy <= reception.range_square else 0
    return kept


@kernel
def _keep_nearest(lists, count, k):
    """Keep the k nearest of `count` found, of those equally far the lower index; return how many there are."""
    found, distance, order = lists.found, lists.distance, lists.cells.order
    while count > k:
        farthest, farthest_odd = distance[0], distance[count - 1]
        for n in range(0, count - 1, 2):  # two chains, no branches
            d, odd = distance[n], distance[n + 1]
            farthest = d if d > farthest else farthest
            farthest_odd = odd if odd > farthest_odd else farthest_odd
        farthest = max(farthest, farthest_odd)
        worst, equal = 0, 0
        for n in range(count):
            worst = n if distance[n] == farthest else worst
            equal += 1 if distance[n] == farthest else 0
        if equal > 1:
            for n in range(count):
                if distance[n] == farthest and order[found[n]] > order[found[worst]]:
                    worst = n
        count -= 1
        found[worst & _INDEX], distance[worst & _INDEX] = found[count & _INDEX], distance[count & _INDEX]
    return count
