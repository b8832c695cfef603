"""Who hears whom where there are many: a list of the k nearest of each agent, found in the cells around it.

The links are those of neighbors.py, ties included: of those equally far, the lower index. Lists are ascending, so that
sums over them have the same bits as sums over all agents, to which those not heard add nothing.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.core.agents import aligned_zeros
from shoal.core.draws import split, uniform
from shoal.world.cells import Cells, new_cells, put_into_cells, row_of, span

VECTOR = 32  # a multiple of what a processor compares at once
LANES = 16  # agents whose lists lie together, and who listen together
_MORE = 1.5  # agents to look for besides the k, so that they are among them in most steps
_LAST = np.int32(2**31 - 1)
_SLACK = 1e-9  # of a reach: rounding of edges of cells


class Lists(NamedTuple):
    """The neighbors of agents in the order of their cells; P of them, padded to whole blocks of LANES.

    cells : who is where
    slots : (P / LANES, K, LANES) whom each hears, as places in cells.order, ascending by index; itself in those unused
    heard : (P / LANES, LANES) how many each hears
    rank : as slots: how many of those heard are nearer; no blocks where the strategy does not ask
    leads : (P,) 1 where an agent may lead, as places in cells.order
    found, distance : (R,) scratch of one search: places in cells.order, squares of distances [m^2]
    ids, sorted : (R,) scratch of a sort
    """

    cells: Cells
    slots: np.ndarray
    heard: np.ndarray
    rank: np.ndarray
    leads: np.ndarray
    found: np.ndarray
    distance: np.ndarray
    ids: np.ndarray
    sorted: np.ndarray


def new_lists(agents: int, most: int, ranked: bool) -> Lists:
    """Return lists of up to `most` neighbors of so many agents."""
    blocks = -(-agents // LANES)
    room = VECTOR * (-(-2 * most // VECTOR) + 2) if agents else 0
    return Lists(
        new_cells(LANES * blocks),
        np.zeros((blocks, most, LANES), np.int32),
        np.zeros((blocks, LANES), np.int32),
        np.zeros((blocks if ranked else 0, most, LANES), np.int32),
        np.zeros(LANES * blocks, np.uint8),
        np.zeros(room, np.int32),
        aligned_zeros(room),
        np.zeros(room, np.int32),
        np.zeros(room, np.int32),
    )


class Reception(NamedTuple):
    """What decides in a step whose report an agent may hear at all, besides who is nearest.

    range_square [m^2] : how far reports go; by_truth : that is from where agents are to where they are, not as they say
    loss : chance that a report is lost, by a draw of `key`
    """

    range_square: float
    by_truth: bool
    loss: float
    key: Any


@kernel
def list_nearest(links, reports, swarm, reception, agents):
    """Fill links.lists and links.heard: of each agent, links.wanted of those who are not in links.silent."""
    lists = links.lists
    put_into_cells(lists.cells, reports, swarm, links.reach, agents)
    for i in range(agents):
        if links.silent[i]:
            lists.cells.x[lists.cells.place[i]] = np.nan  # nearest to nobody
    for p in range(agents):
        i = lists.cells.order[p]
        count = _search(lists, p, links.wanted[i], links.reach, reception, swarm)
        count = _lose(lists, count, i, reception)
        _write(lists, p, count)
        links.heard[i] = count


@kernel
def _search(lists, p, k, reach, reception, swarm):
    """Put the k nearest of the agent at place p into lists.found, or all that it can hear; return how many."""
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
    next_begin, next_end = span(cells, x, y, radius, row)
    while row <= last:
        begin, end = next_begin, next_end
        row += 1
        if row <= last:
            next_begin, next_end = span(cells, x, y, radius, row)  # now: a processor works on both at once
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
                dx = x - cells.x[q & _INDEX]
                dy = y - cells.y[q & _INDEX]
                square = dx * dx + dy * dy
                distance[count & _INDEX] = square
                found[count & _INDEX] = q
                count += 1 if square <= limit else 0
            begin = stop
    return _hear(lists, p, count, reception, swarm)


_INDEX = (1 << 32) - 1  # tells the compiler that an index is not negative


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


@kernel
def _lose(lists, count, i, reception):
    """Leave out of `count` found whose report to agent i is lost."""
    if reception.loss <= 0.0:
        return count
    found, distance, order = lists.found, lists.distance, lists.cells.order
    kept = 0
    for n in range(count):
        found[kept], distance[kept] = found[n], distance[n]
        lost = uniform(split(reception.key, _LOSS + order[found[n]]), i) < reception.loss
        kept += 0 if lost else 1
    return kept


_LOSS = 1 << 33  # the stream of world/radio.py


@kernel
def _write(lists, p, count):
    """Write the first `count` found into the slots of place p, ascending by index."""
    found, ids, ascending, order = lists.found, lists.ids, lists.sorted, lists.cells.order
    block, lane = p // LANES, p % LANES
    slots = lists.slots[block]
    whole = (count + VECTOR - 1) // VECTOR * VECTOR
    for n in range(count):
        ids[n] = order[found[n]]
    for n in range(count, whole):
        ids[n] = _LAST
    for n in range(count):
        mine = ids[n]
        before = np.int32(0)
        for m in range(whole):  # no branches: a sort by counting
            before = np.int32(before + (1 if ids[m] < mine else 0))
        ascending[n] = before
        slots[before, lane] = found[n]
    for n in range(count, slots.shape[0]):
        slots[n, lane] = p
    lists.heard[block, lane] = count
    if lists.rank.shape[0] > 0:
        _rank(lists, block, lane, count)


@kernel
def _rank(lists, block, lane, count):
    """Say of each found how many are nearer, of those equally far the lower index first; lists.sorted has its slot."""
    distance, ids = lists.distance, lists.ids
    for n in range(count):
        nearer = 0
        for m in range(count):
            nearer += distance[m] < distance[n] or (distance[m] == distance[n] and ids[m] < ids[n])
        lists.rank[block, lists.sorted[n], lane] = nearer


@kernel
def heard_of(lists, i, slot):
    """Whom agent i hears in a slot."""
    p = lists.cells.place[i]
    return lists.cells.order[lists.slots[p // LANES, slot, p % LANES]]


@kernel
def count_of(lists, i):
    """How many agent i hears."""
    p = lists.cells.place[i]
    return lists.heard[p // LANES, p % LANES]


@kernel
def is_listed(lists, j, i):
    """Whether agent i hears j: a search by halves."""
    p = lists.cells.place[i]
    order, block, lane = lists.cells.order, lists.slots[p // LANES], p % LANES
    low, high = 0, lists.heard[p // LANES, lane]
    while low < high:
        middle = (low + high) // 2
        if order[block[middle, lane]] < j:
            low = middle + 1
        else:
            high = middle
    return low < lists.heard[p // LANES, lane] and order[block[low, lane]] == j


@kernel
def note_leader(lists, j, leads):
    """Note whether agent j may lead; not in the kernel that asks, see the trap in compiler/kernel.py."""
    lists.leads[lists.cells.place[j]] = 1 if leads else 0
