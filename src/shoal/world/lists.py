"""Who hears whom where there are many: for every few agents that lie together, whom any of them hears.

The links are those of neighbors.py, ties included: of those equally far, the lower index. What is near a block of
agents is found in the cells around it (cells.py), and sorted by index, so that sums have the same bits as sums over all
agents, to which those not heard add nothing. Then the nearest are found as among few agents, by lanes (nearest.py).
"""

import math
from typing import Any, NamedTuple

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.compiler.lanes import WIDTH, any_of, counting, either, everywhere, larger, put, smaller, take, truths
from shoal.core.agents import aligned_zeros
from shoal.core.draws import split, uniform
from shoal.world.cells import Cells, new_cells, put_into_cells, row_of, span
from shoal.world.crowds import search_one
from shoal.world.nearest import count_within, reach_of, settle_tie, square_between

LANES = WIDTH  # agents of a block; the last one may have fewer
_PATIENCE = 24  # looks around a block before its agents are searched for one by one
_SLACK = 1e-6  # of a reach: rounding of edges of cells, and of squares in single precision
_AHEAD = 1.15  # a block is looked around as far as its agents heard in the last step, and this much more (of squares)


class Lists(NamedTuple):
    """The neighbors of agents in the order of their cells; P of them, padded to whole blocks of LANES.

    cells : who is where
    begins : (P / LANES + 1,) where the neighbors of each block begin
    near : (M,) those whom any agent of a block hears, as places in cells.order, ascending by index
    hears : (M,) which agents of the block hear them: a bit per lane
    rank : (M, LANES) how many of those that an agent hears are nearer; no rows where the strategy does not ask
    leads : (P,) 1 where an agent may lead, as places in cells.order
    most : (1,) the most neighbors that an agent has
    found, ids, sorted, distance : (R,) scratch of a search: places in cells.order, indices, the places by index,
        squares of distances [m^2]; square : (R, LANES) of all agents of a block
    wanted, reach, limit, true_x, true_y : (LANES,) of the agents of a block: k, how far they hear, how far around them
        is looked [m^2], where they are [m]
    """

    cells: Cells
    begins: np.ndarray
    near: np.ndarray
    hears: np.ndarray
    rank: np.ndarray
    leads: np.ndarray
    most: np.ndarray
    found: np.ndarray
    ids: np.ndarray
    sorted: np.ndarray
    distance: np.ndarray
    square: np.ndarray
    wanted: np.ndarray
    reach: np.ndarray
    limit: np.ndarray
    true_x: np.ndarray
    true_y: np.ndarray


def new_lists(agents: int, most: int, ranked: bool) -> Lists:
    """Return lists of up to `most` neighbors of so many agents."""
    blocks = -(-agents // LANES)
    kept = blocks * min(LANES * most, agents) + 1  # memory that is never written to costs nothing
    room = LANES * -(-max(6 * most + 256, LANES * most) // LANES) if agents else 0
    return Lists(
        new_cells(LANES * blocks),
        np.zeros(blocks + 1, np.int64),
        np.zeros(kept, np.int32),
        np.zeros(kept, np.uint8),
        np.zeros((kept if ranked else 0, LANES), np.int64),
        np.zeros(LANES * blocks, np.uint8),
        np.array([most]),
        np.zeros(room, np.int32),
        aligned_zeros(room),
        np.zeros(room, np.int32),
        aligned_zeros(room),
        aligned_zeros(room * LANES).reshape((room, LANES)),
        *(aligned_zeros(LANES) for _ in range(5)),
    )


class Reception(NamedTuple):
    """What decides in a step whose report an agent may hear at all, besides who is nearest.

    range_square [m^2] : how far reports go; by_truth : that is from where agents are to where they are, not as they say
    loss : chance that a report is lost, by a draw of `key`
    single : distances are in single precision
    """

    range_square: float
    by_truth: bool
    single: bool
    loss: float
    key: Any


@kernel
def list_nearest(links, reports, swarm, reception, agents):
    """Fill links.lists and links.heard: of each agent, links.wanted of those who are not in links.silent."""
    lists = links.lists
    put_into_cells(lists.cells, reports, swarm, links.reach, agents, reception.single)
    for i in range(agents):
        if links.silent[i]:
            lists.cells.x[lists.cells.place[i]] = np.nan  # nearest to nobody
    end = 0
    for block in range(lists.begins.size - 1):
        lists.begins[block] = end
        end = _list_block(lists, links, LANES * block, min(LANES * block + LANES, agents), end, reception, swarm)
    lists.begins[lists.begins.size - 1] = end


@kernel
def _list_block(lists, links, p, last, end, reception, swarm):
    """Find the neighbors of the agents at places p..last; return where those of the next block begin."""
    _begin_block(lists, links, p, last, swarm)
    wanted = take(lists.wanted, 0, everywhere(0.0))
    guess = take(lists.reach, 0, wanted)
    limit = _AHEAD * guess
    farthest_of_all = _extent(lists.cells, p, last)
    for _ in range(_PATIENCE):
        limit = limit if reception.by_truth else smaller(limit, reception.range_square)
        put(lists.limit, 0, limit)
        count = _look_around(lists, p, last)
        if count > lists.found.size - LANES:
            limit = 0.25 * limit
            continue
        _sort(lists, count)
        _measure(lists, p, count, reception, swarm)
        reach = reach_of(lists.square, count, 0, wanted, guess)
        reach = either(wanted > 0.0, reach, -1.0)
        heard, farthest, beyond = count_within(lists.square, count, 0, reach, 0.0 * wanted)
        put(lists.reach, 0, reach)
        if any_of((heard > wanted) | ((heard < wanted) & (beyond < np.inf))):
            _settle(lists, count, last - p)
            reach = take(lists.reach, 0, wanted)
            heard, farthest, beyond = count_within(lists.square, count, 0, reach, 0.0 * wanted)
        partial = limit < farthest_of_all
        partial = partial if reception.by_truth else partial & (limit < reception.range_square)
        short, blind = heard < wanted, farthest > limit
        if not any_of((short | blind) & partial):
            return _keep(lists, links, p, last, count, end, reception)
        growth = larger(1.5, smaller(16.0, (wanted + 2.0) / (heard + 1.0)))
        limit = either(short & partial, limit * growth, limit)
        limit = either(blind & partial, farthest, limit)
    return _list_crowd(lists, links, p, last, end, reception, swarm)


@kernel
def _begin_block(lists, links, p, last, swarm):
    """What the agents at places p..last want, and how far they heard in the last step; lanes besides want nothing."""
    order = lists.cells.order
    for lane in range(LANES):
        lists.wanted[lane], lists.reach[lane] = 0.0, -1.0
    for lane in range(last - p):
        i = order[p + lane]
        lists.true_x[lane], lists.true_y[lane] = swarm.x[i], swarm.y[i]
        if links.wanted[i] > 0:
            lists.wanted[lane], lists.reach[lane] = links.wanted[i], links.reach[i]


@kernel
def _box(cells, p, last):
    """The box [m] around where the agents at places p..last believe to be; those that are nowhere aside."""
    left, right, bottom, top = np.inf, -np.inf, np.inf, -np.inf
    for each in range(p, last):
        x, y = cells.own_x[each], cells.own_y[each]
        left, right = min(left, x), max(right, x)
        bottom, top = min(bottom, y), max(top, y)
    return left, right, bottom, top


@kernel
def _extent(cells, p, last):
    """A square [m^2] that no distance between these and any agent exceeds."""
    grid = cells.grid
    left, right, bottom, top = _box(cells, p, last)
    wide = max(right - grid[0], grid[0] + grid[4] / grid[2] - left)
    high = max(top - grid[1], grid[1] + grid[5] / grid[3] - bottom)
    return 1.01 * (wide * wide + high * high)


@kernel
def _look_around(lists, p, last):
    """Put all that are within lists.limit of any of the agents at places p..last into lists.found, as places.

    Returns how many; more than lists.found.size - LANES: not all, there is no room.
    """
    cells, found = lists.cells, lists.found
    grid = cells.grid
    farthest = -1.0
    for lane in range(last - p):
        farthest = max(farthest, lists.limit[lane])
    if farthest < 0.0:
        return 0
    radius = math.sqrt(farthest) * (1.0 + _SLACK)
    left, right, bottom, top = _box(cells, p, last)
    limit = take(lists.limit, 0, everywhere(0.0)) * (1.0 + _SLACK)
    own_x, own_y = take(cells.own_x, p, limit), take(cells.own_y, p, limit)
    room, count = found.size - LANES, 0
    for row in range(row_of(grid, bottom - radius), row_of(grid, top + radius) + 1):
        begin, end = span(cells, left, right, bottom, top, radius, row)
        while begin < end:
            if count > room:
                return count
            stop = min(end, begin + room + 1 - count)
            for q in range(begin, stop):
                dx, dy = own_x - cells.x[q], own_y - cells.y[q]
                found[count] = q
                count += 1 if any_of(dx * dx + dy * dy <= limit) else 0
            begin = stop
    return count


@kernel
def _sort(lists, count):
    """Put the first `count` places found into lists.sorted, ascending by the index of who is there."""
    found, ids, order, zero = lists.found, lists.ids, lists.cells.order, everywhere(0.0)
    for n in range(count):
        ids[n] = order[found[n]]
    for n in range(count, count + LANES):
        ids[n] = np.inf
    for first in range(0, count, LANES):
        mine, before = take(ids, first, zero), zero
        for n in range(count):
            before = either(ids[n] < mine, before + 1.0, before)
        put(lists.distance, 0, before)
        for n in range(first, min(first + LANES, count)):
            lists.sorted[int(lists.distance[n - first])] = found[n]


@kernel
def _measure(lists, p, count, reception, swarm):
    """Set lists.square of all found to the agents of a block; NaN of oneself, and of those out of range."""
    cells, lane, none = lists.cells, counting(p), everywhere(0.0)
    own_x, own_y = take(cells.own_x, p, none), take(cells.own_y, p, none)
    true_x, true_y = take(lists.true_x, 0, none), take(lists.true_y, 0, none)
    for c in range(count):
        q = lists.sorted[c]
        square = square_between(own_x, own_y, cells.x[q], cells.y[q], reception.single)
        far = square
        if reception.by_truth:
            j = cells.order[q]
            far_x, far_y = swarm.x[j] - true_x, swarm.y[j] - true_y
            far = far_x * far_x + far_y * far_y
        put(lists.square, (c, 0), either((far <= reception.range_square) & (lane != q), square, np.nan))


@kernel
def _settle(lists, count, lanes):
    """Settle ties of agents at the same distance."""
    for lane in range(lanes):
        if lists.wanted[lane] > 0.0:
            k = int(lists.wanted[lane])
            lists.reach[lane] = settle_tie(lists.square, count, lane, k, lists.reach[lane])


@kernel
def _keep(lists, links, p, last, count, end, reception):
    """Keep whom the agents at places p..last hear, of `count` sorted; return where those of the next block begin."""
    kept, reach = end, take(lists.reach, 0, everywhere(0.0))
    for c in range(count):
        square = take(lists.square, (c, 0), reach)
        hears = truths(square <= reach)
        if reception.loss > 0.0:
            hears = _left(lists.cells.order, hears, p, last, lists.sorted[c], reception)
        lists.near[kept], lists.hears[kept] = lists.sorted[c], hears
        put(lists.square, (kept - end, 0), square)  # of those kept, for their ranks
        kept += 1 if hears != 0 else 0
    for lane in range(last - p):
        i = lists.cells.order[p + lane]
        heard = 0
        for c in range(end, kept):
            heard += (lists.hears[c] >> lane) & 1
        links.heard[i] = heard
        if lists.reach[lane] < np.inf:
            links.reach[i] = max(lists.reach[lane], 1e-300)
        if lists.rank.shape[0] > 0:
            _rank(lists, end, kept, lane)
    return kept


@kernel
def _left(order, hears, p, last, q, reception):
    """Those of the agents at places p..last who hear the one at place q, as bits, without those to whom it is lost."""
    left = 0
    for lane in range(last - p):
        lost = uniform(split(reception.key, _LOSS + order[q]), order[p + lane]) < reception.loss
        left |= 0 if lost else hears & (1 << lane)
    return left


_LOSS = 1 << 33  # the stream of world/radio.py


@kernel
def _rank(lists, begin, end, lane):
    """Say of each that an agent hears how many are nearer, of those equally far the lower index first."""
    for c in range(begin, end):
        nearer = 0
        mine = lists.square[c - begin, lane]
        for other in range(begin, end):
            square = lists.square[other - begin, lane]
            is_nearer = square < mine or (square == mine and other < c)
            nearer += 1 if is_nearer and (lists.hears[other] >> lane) & 1 else 0
        lists.rank[c, lane] = nearer


@kernel
def _list_crowd(lists, links, p, last, end, reception, swarm):
    """As _list_block, agent by agent: for heaps of agents, of whom there are more near than there is room for."""
    order, count = lists.cells.order, 0
    for lane in range(last - p):
        i = order[p + lane]
        found = search_one(lists, p + lane, links.wanted[i], links.reach, reception, swarm)
        links.heard[i] = 0
        for n in range(found):
            q = lists.found[n]
            if reception.loss <= 0.0 or _left(order, 1, p + lane, p + lane + 1, q, reception) != 0:
                lists.sorted[count], lists.ids[count] = q, order[q]
                lists.square[count, 0], lists.square[count, 1] = lane, lists.distance[n]
                links.heard[i] += 1
                count += 1
    kept, previous = end, -1
    for _ in range(count):
        least = 0
        for n in range(count):
            least = n if lists.ids[n] < lists.ids[least] else least
        q, lane = lists.sorted[least], int(lists.square[least, 0])
        if order[q] != previous:
            previous = order[q]
            lists.near[kept], lists.hears[kept] = q, 0
            kept += 1
        lists.hears[kept - 1] |= 1 << lane
        lists.ids[least] = np.inf
        if lists.rank.shape[0] > 0:
            lists.rank[kept - 1, lane] = _rank_in_crowd(lists, least, count)
    return kept


@kernel
def _rank_in_crowd(lists, one, count):
    """How many of `count` found by the same agent are nearer than this one."""
    lane, mine, i = lists.square[one, 0], lists.square[one, 1], lists.cells.order[lists.sorted[one]]
    nearer = 0
    for n in range(count):
        square = lists.square[n, 1]
        is_nearer = square < mine or (square == mine and lists.cells.order[lists.sorted[n]] < i)
        nearer += 1 if is_nearer and lists.square[n, 0] == lane else 0
    return nearer


@kernel
def heard_of(lists, i, slot):
    """Whom agent i hears as number `slot`, from 0, ascending; -1 where there are fewer."""
    p = lists.cells.place[i]
    block, lane = p // LANES, p % LANES
    for c in range(lists.begins[block], lists.begins[block + 1]):
        slot -= (lists.hears[c] >> lane) & 1
        if slot < 0:
            return int(lists.cells.order[lists.near[c]])
    return -1


@kernel
def is_listed(lists, j, i):
    """Whether agent i hears j: a search by halves."""
    p, order, near = lists.cells.place[i], lists.cells.order, lists.near
    block, lane = p // LANES, p % LANES
    low, high = lists.begins[block], lists.begins[block + 1]
    last = high
    while low < high:
        middle = (low + high) // 2
        if order[near[middle]] < j:
            low = middle + 1
        else:
            high = middle
    return low < last and order[near[low]] == j and (lists.hears[low] >> lane) & 1 != 0


@kernel
def note_leader(lists, j, leads):
    """Note whether agent j may lead; not in the kernel that asks, see the trap in compiler/kernel.py."""
    lists.leads[lists.cells.place[j]] = 1 if leads else 0


@kernel
def note_contact(lists, reports, contact, agents):
    """Set contact[i] to 1 where agent i hears somebody on target."""
    order = lists.cells.order
    for block in range(lists.begins.size - 1):
        for c in range(lists.begins[block], lists.begins[block + 1]):
            if reports.on_target[order[lists.near[c]]]:
                for p in range(LANES * block, min(LANES * block + LANES, agents)):
                    contact[order[p]] |= (lists.hears[c] >> (p % LANES)) & 1
