"""Who hears whom: the k nearest others, ties to the lower index.

There are no index lists. Agent i hears j where square[j, i] <= reach[i]: any reach between the squares of the k-th
and the (k+1)-th distance serves, and neighborhoods change slowly, so the last step's reach is a good first guess.
Agents are lanes: what loops over pairs handles several listeners at once, in a vector register (compiler/lanes.py).
"""

from typing import NamedTuple

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.compiler.lanes import WIDTH, any_of, everywhere, farthest, put, take
from shoal.core.agents import aligned_zeros
from shoal.world.lists import Lists, is_listed, new_lists
from shoal.world.nearest import reach_of, settle_tie


class Single(NamedTuple):
    """`square` and `reach` of Links in single precision."""

    square: np.ndarray
    reach: np.ndarray


class Links(NamedTuple):
    """Squared distances [m^2] from speaker (row) to listener (lane), and each listener's reach; the rest is scratch.

    Rows are padded to an even number with infinity; an agent is infinitely far from itself. `wanted` is k of each
    listener, or fewer where not all pairs can be linked. `rank` says how many of those heard are nearer, agents for
    those not heard; it has no rows where the strategy does not ask.

    Where there are many agents, `lists` says who hears whom instead, and `square` and `rank` have no rows; `silent` are
    those whom nobody can hear then. In single precision `single` does, and `square` has no rows.
    """

    square: np.ndarray
    reach: np.ndarray
    heard: np.ndarray
    wanted: np.ndarray
    rank: np.ndarray
    order: np.ndarray
    silent: np.ndarray
    lists: Lists
    single: Single


def new_links(agents: int, lanes: int, ranked: bool = False, listed: int = 0, single: bool = False) -> Links:
    """Return links of `agents` speakers to `lanes` listeners; `ranked` ones know how many are nearer.

    listed : the most that an agent hears where there are many, and lists say whom; 0: distances of all pairs do
    single : whether distances are in single precision
    """
    rows = 0 if listed else agents + agents % 2

    def squares(rows: int, kind: type) -> np.ndarray:
        room: np.ndarray = aligned_zeros(rows * lanes).view(kind)[: rows * lanes].reshape((rows, lanes))
        room[:] = np.inf
        return room

    reach = aligned_zeros(lanes)
    reach[:] = 1.0
    heard = np.zeros(lanes, np.int64)
    return Links(
        squares(0 if single else rows, np.float64),
        reach,
        heard,
        np.zeros(lanes, np.int64),
        np.zeros((rows if ranked else 0, lanes), np.int64),
        np.zeros(agents if ranked and not listed else 0, np.int64),
        np.zeros(lanes if listed else 0, np.bool_),
        new_lists(agents if listed else 0, listed, ranked),
        Single(squares(rows if single else 0, np.float32), reach.astype(np.float32)),
    )


@kernel
def as_single(links):
    """The same links with distances in single precision, for kernels that go by these."""
    single = links.single
    return Links(
        single.square,
        single.reach,
        links.heard,
        links.wanted,
        links.rank,
        links.order,
        links.silent,
        links.lists,
        single,
    )


@kernel
def zero_of(links):
    """Zero, as precise as the distances."""
    return links.reach.dtype.type(0.0)


@kernel
def linked(links, j, i):
    """Whether listener i hears speaker j, however neighbors are found."""
    if links.silent.size > 0:
        return is_listed(links.lists, j, i)
    if links.square.shape[0] == 0:
        return within(links.single, j, i)
    return within(links, j, i)


@kernel
def within(links, j, i):
    """Whether listener i hears speaker j, where distances say so: without a branch, for loops over lanes."""
    return links.square[j, i] <= links.reach[i]


@kernel
def measure_distances(links, speaker_x, speaker_y, listener_x, listener_y, first, agents):
    """Fill `links.square`; listener lane i is agent first + i."""
    lanes = listener_x.size
    if lanes % WIDTH == 0:
        for i in range(0, lanes, WIDTH):
            _measure_from(links, speaker_x, speaker_y, listener_x, listener_y, i, everywhere(zero_of(links)), agents)
    else:
        for i in range(lanes):
            _measure_from(links, speaker_x, speaker_y, listener_x, listener_y, i, zero_of(links), agents)
    for i in range(min(lanes, agents - first)):
        links.square[first + i, i] = np.inf


@kernel
def _measure_from(links, speaker_x, speaker_y, listener_x, listener_y, i, none, agents):
    """Fill the columns of the listeners from i on, of as many as `none` has lanes."""
    x, y = take(listener_x, i, none), take(listener_y, i, none)
    for j in range(agents):
        dx, dy = x - speaker_x[j], y - speaker_y[j]
        put(links.square, (j, i), dx * dx + dy * dy)


@kernel
def link_nearest(links, agents):
    """Set `links.reach` so that every listener hears its `links.wanted` nearest.

    Where the k-th and the next are equally far, a listener may hear more or fewer until `settle_ties`.
    """
    lanes = links.reach.size
    if lanes % WIDTH == 0:
        for i in range(0, lanes, WIDTH):
            _set_reach(links, i, everywhere(zero_of(links)), agents)
    else:
        for i in range(lanes):
            _set_reach(links, i, zero_of(links), agents)


@kernel
def _set_reach(links, i, none, agents):
    """Set the reach of the listeners from i on, of as many as `none` has lanes."""
    wanted = take(links.wanted, i, none) + none
    if any_of(wanted < agents - 1.0):
        put(links.reach, i, reach_of(links.square, links.square.shape[0], i, wanted, take(links.reach, i, none)))
    else:
        put(links.reach, i, farthest(none))


@kernel
def count_heard(links, agents):
    """Set `links.heard` to how many each listener hears."""
    for i in range(links.reach.size):
        links.heard[i] = 0
    for j in range(agents):
        for i in range(links.reach.size):
            links.heard[i] += 1 if within(links, j, i) else 0


@kernel
def settle_ties(links, agents):
    """Correct the listeners whose `links.heard` is not `links.wanted`; return whether there were any."""
    corrected = False
    for i in range(links.reach.size):
        if links.heard[i] != min(links.wanted[i], agents):
            links.reach[i] = settle_tie(links.square, agents, i, links.wanted[i], links.reach[i])
            corrected = True
    return corrected


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
