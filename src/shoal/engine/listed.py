"""Listening where there are many: agents go by their lists of neighbors (world/lists.py), in blocks that lie together.

The same as in listen.py, to the bit: lists are ascending, and whom an agent does not hear adds nothing there. The type
of `memories` decides which is compiled, see arrivals.py.
"""

from typing import Any, NamedTuple

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.core.messages import Report
from shoal.engine.listen import listener_at
from shoal.strategies import contract
from shoal.world.lists import LANES, note_leader


class Listed(NamedTuple):
    """The reports that arrive in a step, (L,) each: what is said, what is told of memories, and when [s]."""

    said: Any
    told: Any
    at: float


@kernel
def sum_listed_influence(arrived, listeners, links, params, agents, sums):
    """Add up what the neighbors of each listener exert on it, (S, L)."""
    lists, said, told, at = links.lists, arrived.said, arrived.told, arrived.at
    cells, slots = lists.cells, lists.slots
    if not contract.has_influence(params):
        for i in range(agents):
            contract.clear(sums, i, params)
        return
    block = np.empty((sums.shape[0], LANES))
    for number in range(slots.shape[0]):
        longest = 0
        for lane in range(LANES):
            contract.clear(block, lane, params)
            longest = max(longest, lists.heard[number, lane])
        first = number * LANES
        for slot in range(longest):
            for lane in range(LANES):
                p, q = first + lane, slots[number, slot, lane]
                i, j = cells.order[p], cells.order[q]
                me = listener_at(listeners, i, cells.own_x[p], cells.own_y[p])
                rank = contract.rank_of(lists.rank[number], slot, lane, params)
                other = Report(j, cells.x[q], cells.y[q], said.vx[j], said.vy[j], said.on_target[j], told[j], at, rank)
                pushed = contract.influence(me, other, params)
                contract.add(block, lane, pushed, slot < lists.heard[number, lane])
        for lane in range(min(LANES, agents - first)):
            i = cells.order[first + lane]
            for each in range(block.shape[0]):
                sums[each, i] = block[each, lane]


@kernel
def choose_listed_leaders(arrived, listeners, links, params, agents, leader, lowest):
    """Set leader[i] to the index of the neighbor that listener i follows, -1 if none; lowest[i] is its priority."""
    lists, said, told, at = links.lists, arrived.said, arrived.told, arrived.at
    cells = lists.cells
    anybody = False
    for j in range(agents):
        leader[j] = -1
        other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j], at, None)
        leads = contract.leads(other, params)
        note_leader(lists, j, leads)
        anybody |= leads
    if not anybody:
        return
    for p in range(agents):
        number, lane = p // LANES, p % LANES
        i = cells.order[p]
        best = np.inf
        me = listener_at(listeners, i, cells.own_x[p], cells.own_y[p])
        for slot in range(lists.heard[number, lane]):
            q = lists.slots[number, slot, lane]
            if lists.leads[q] != 0:
                j = cells.order[q]
                rank = contract.rank_of(lists.rank[number], slot, lane, params)
                other = Report(j, cells.x[q], cells.y[q], said.vx[j], said.vy[j], said.on_target[j], told[j], at, rank)
                priority = contract.priority(me, other, params)
                if priority < best:
                    best = priority
                    leader[i] = j
