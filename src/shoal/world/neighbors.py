"""Who hears whom: the k nearest others, ties to the lower index.

There are no index lists. Agent i hears j where square[j, i] <= reach[i]: any reach between the squares of the k-th
and the (k+1)-th distance serves, and neighborhoods change slowly, so the last step's reach is a good first guess.
Agents are lanes: the inner loops run over all listeners i and nothing else, so that they compile to vector code.
"""

from typing import NamedTuple

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.core.agents import aligned_zeros
from shoal.world.lists import Lists, is_listed, new_lists

ROUNDS = 40
_BELOW = 1.0 - 2.0**-52


class Links(NamedTuple):
    """Squared distances [m^2] from speaker (row) to listener (lane), and each listener's reach; the rest is scratch.

    Rows are padded to an even number with infinity; an agent is infinitely far from itself. `wanted` is k of each
    listener where not all pairs can be linked. `rank` says how many of those heard are nearer, agents for those not
    heard; it has no rows where the strategy does not ask.

    Where there are many agents, `lists` says who hears whom instead, and `square` and `rank` have no rows; `silent` are
    those whom nobody can hear then.
    """

    square: np.ndarray
    reach: np.ndarray
    heard: np.ndarray
    wanted: np.ndarray
    below: np.ndarray
    above: np.ndarray
    low: np.ndarray
    high: np.ndarray
    off: np.ndarray
    rank: np.ndarray
    order: np.ndarray
    silent: np.ndarray
    lists: Lists


def new_links(agents: int, lanes: int, ranked: bool = False, listed: int = 0) -> Links:
    """Return links of `agents` speakers to `lanes` listeners; `ranked` ones know how many are nearer.

    listed : the most that an agent hears where there are many, and lists say whom; 0: distances of all pairs do
    """
    rows = 0 if listed else agents + agents % 2
    square = aligned_zeros(rows * lanes).reshape((rows, lanes))
    square[:] = np.inf
    reach = aligned_zeros(lanes)
    reach[:] = 1.0
    heard = np.zeros(lanes, np.int64)
    return Links(
        square,
        reach,
        heard,
        np.zeros(lanes, np.int64),
        aligned_zeros(lanes),
        aligned_zeros(lanes),
        aligned_zeros(lanes),
        aligned_zeros(lanes),
        np.zeros(lanes, np.int64),
        np.zeros((rows if ranked else 0, lanes), np.int64),
        np.zeros(agents if ranked and not listed else 0, np.int64),
        np.zeros(lanes if listed else 0, np.bool_),
        new_lists(agents if listed else 0, listed, ranked),
    )


@kernel
def linked(links, j, i):
    """Whether listener i hears speaker j, however neighbors are found."""
    if links.silent.size > 0:
        return is_listed(links.lists, j, i)
    return within(links, j, i)


@kernel
def within(links, j, i):
    """Whether listener i hears speaker j, where distances say so: without a branch, for loops over lanes."""
    return links.square[j, i] <= links.reach[i]


@kernel
def measure_distances(links, speaker_x, speaker_y, listener_x, listener_y, first, agents):
    """Fill `links.square`; listener lane i is agent first + i."""
    lanes = listener_x.size
    square = links.square
    for j in range(0, agents - 1, 2):
        x, y = speaker_x[j], speaker_y[j]
        next_x, next_y = speaker_x[j + 1], speaker_y[j + 1]
        for i in range(lanes):
            dx = listener_x[i] - x
            dy = listener_y[i] - y
            square[j, i] = dx * dx + dy * dy
            dx = listener_x[i] - next_x
            dy = listener_y[i] - next_y
            square[j + 1, i] = dx * dx + dy * dy
    if agents % 2:
        for i in range(lanes):
            dx = listener_x[i] - speaker_x[agents - 1]
            dy = listener_y[i] - speaker_y[agents - 1]
            square[agents - 1, i] = dx * dx + dy * dy
    for i in range(min(lanes, agents - first)):
        square[first + i, i] = np.inf


@kernel
def link_nearest(links, neighbors, agents):
    """Set `links.reach` so that every listener hears its k nearest; `neighbors` is k per lane.

    Where the k-th and the next are equally far, a listener may hear more or fewer until `settle_ties`.
    """
    lanes = links.reach.size
    everybody = True
    for i in range(lanes):
        everybody &= neighbors[i] >= agents - 1
    if everybody:
        for i in range(lanes):
            links.reach[i] = _FARTHEST
        return
    for i in range(lanes):
        links.low[i] = 0.0
        links.high[i] = _FARTHEST
    for attempt in range(ROUNDS):
        _count(links)
        if _step_once(links, neighbors) <= lanes // _FEW:
            break
        _guess(links, neighbors, attempt)
    for i in range(lanes):
        if abs(links.off[i]) > 1:
            _walk(links, i, links.off[i])


@kernel
def count_heard(links, agents):
    """Set `links.heard` to how many each listener hears."""
    for i in range(links.reach.size):
        links.heard[i] = 0
    for j in range(agents):
        for i in range(links.reach.size):
            links.heard[i] += 1 if within(links, j, i) else 0


@kernel
def settle_ties(links, neighbors, agents):
    """Correct the listeners whose `links.heard` is not k; return whether there were any."""
    corrected = False
    for i in range(links.reach.size):
        if links.heard[i] != min(neighbors[i], agents):
            _settle_tie(links, i, neighbors[i], agents)
            corrected = True
    return corrected


_FARTHEST = 1e300
_FEW = 4  # a quarter of the lanes is cheaper to correct one by one


@kernel
def _count(links):
    """Count speakers within reach; find the farthest within and the nearest beyond. Two rows a turn: 15 % faster."""
    rows, lanes = links.square.shape
    square, reach, heard, below, above = links.square, links.reach, links.heard, links.below, links.above
    for i in range(lanes):
        heard[i] = 0
        below[i] = 0.0
        above[i] = np.inf
    for j in range(0, rows, 2):
        for i in range(lanes):
            limit = reach[i]
            number = heard[i]
            farthest = below[i]
            nearest = above[i]
            d = square[j, i]
            inside = d <= limit
            number += 1 if inside else 0
            within = d if inside else 0.0
            farthest = within if within > farthest else farthest
            beyond = np.inf if inside else d
            nearest = beyond if beyond < nearest else nearest
            d = square[j + 1, i]
            inside = d <= limit
            number += 1 if inside else 0
            within = d if inside else 0.0
            farthest = within if within > farthest else farthest
            beyond = np.inf if inside else d
            nearest = beyond if beyond < nearest else nearest
            heard[i] = number
            below[i] = farthest
            above[i] = nearest


@kernel
def _step_once(links, neighbors):
    """Step every reach over one speaker toward hearing k; return how many listeners a better guess would bring nearer.

    `off` is how many speakers were missing. No branches: how far off each lies is chance, and a wrong prediction costs
    more than all of this.
    """
    reach, heard, below, above, low, high, off = (
        links.reach, links.heard, links.below, links.above, links.low, links.high, links.off,
    )  # fmt: skip
    unsettled = 0
    for i in range(reach.size):
        off[i] = neighbors[i] - heard[i]
    for i in range(reach.size):
        missing = off[i]
        nearest, farthest = above[i], below[i]
        low[i] = nearest if missing > 0 else low[i]
        high[i] = farthest if missing < 0 else high[i]
        wide = 4.0 * farthest
        middle = 0.5 * (farthest + (nearest if nearest < wide else wide))
        step = nearest if missing > 0 else farthest * _BELOW
        reach[i] = middle if missing == 0 else step
    for i in range(reach.size):
        unsettled += (off[i] * off[i] > 1) & (low[i] < high[i])
    return unsettled


@kernel
def _guess(links, neighbors, attempt):
    """Estimate the reach of listeners that are far off: counts grow like the square of the distance.

    A guess stays inside the bracket found so far, which is bisected after a few rounds.
    """
    for i in range(links.reach.size):
        low, high = links.low[i], links.high[i]
        k = neighbors[i]
        heard = k - links.off[i]
        if abs(links.off[i]) > 1 and low < high:
            guess = low * ((k + 0.5) / (heard + 1.5)) if heard < k else high * ((k + 0.5) / (heard - 0.5))
            if attempt > 3 or guess < low or guess >= high:
                guess = 0.5 * (low + min(high, 4.0 * low))
            links.reach[i] = guess


@kernel
def _walk(links, i, off):
    """Step listener i's reach, stepped once already, over the rest of `off` speakers."""
    square = links.square
    reach = links.reach[i]
    for _ in range(abs(off) - 1):
        if off > 0:
            nearest = np.inf
            nearest_odd = np.inf  # two chains: each comparison waits for the one before
            for j in range(0, square.shape[0], 2):
                d, odd = square[j, i], square[j + 1, i]
                nearest = d if d > reach and d < nearest else nearest
                nearest_odd = odd if odd > reach and odd < nearest_odd else nearest_odd
            further = min(nearest, nearest_odd)
        else:
            farthest = 0.0
            farthest_odd = 0.0
            for j in range(0, square.shape[0], 2):
                d, odd = square[j, i], square[j + 1, i]
                farthest = d if d <= reach and d > farthest else farthest
                farthest_odd = odd if odd <= reach and odd > farthest_odd else farthest_odd
            further = max(farthest, farthest_odd) * _BELOW
        if further == reach:
            break  # all are at one place: ties, see below
        reach = further
    links.reach[i] = reach


@kernel
def _settle_tie(links, i, k, agents):
    """Move listener i's reach to its k-th distance; of those at it, put the surplus out, highest indices first."""
    square = links.square
    reach = links.reach[i]
    while True:
        within = 0
        equal = 0
        farthest = -1.0
        second = -1.0
        beyond = np.inf
        for j in range(agents):
            d = square[j, i]
            if d > reach:
                beyond = min(beyond, d)
                continue
            within += 1
            if d > farthest:
                second = farthest
                farthest = d
                equal = 1
            elif d == farthest:
                equal += 1
            elif d > second:
                second = d
        if within < k and beyond < np.inf:
            reach = beyond
        elif within - equal >= k and second >= 0.0:  # it is below zero where distances are NaN
            reach = second
        else:
            break
    links.reach[i] = reach
    surplus = within - k
    for j in range(agents - 1, -1, -1):
        if surplus > 0 and square[j, i] == farthest:
            square[j, i] = np.inf
            surplus -= 1


@kernel
def rank_heard(links, agents):
    """Set `links.rank` of every pair: by distance, ties to the lower index. Nothing where nobody asks for it."""
    square, reach, rank, order = links.square, links.reach, links.rank, links.order
    if rank.shape[0] == 0:
        return
    for i in range(reach.size):
        count = 0
        for j in range(agents):
            rank[j, i] = agents
            if within(links, j, i):
                order[count] = j
                count += 1
        _sort_by_distance(order, count, square, i)
        for number in range(count):
            rank[order[number], i] = number


@kernel
def _sort_by_distance(order, count, square, i):
    """Sort the first `count` speakers by how far they are from listener i, then by index: a heap sort, in place."""
    for root in range(count // 2 - 1, -1, -1):
        _sift_down(order, root, count, square, i)
    for last in range(count - 1, 0, -1):
        order[0], order[last] = order[last], order[0]
        _sift_down(order, 0, last, square, i)


@kernel
def _sift_down(order, root, count, square, i):
    """Let the speaker at `root` sink in the heap until nobody below it is farther."""
    while 2 * root + 1 < count:
        below = 2 * root + 1
        if below + 1 < count and _is_nearer(order[below], order[below + 1], square, i):
            below += 1
        if not _is_nearer(order[root], order[below], square, i):
            return
        order[root], order[below] = order[below], order[root]
        root = below


@kernel
def _is_nearer(a, b, square, i):
    return square[a, i] < square[b, i] or (square[a, i] == square[b, i] and a < b)
