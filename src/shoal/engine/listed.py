"""Listening where there are many: agents go by their lists of neighbors (world/lists.py), in blocks that lie together.

The same as in listen.py, to the bit: lists are ascending, and whom an agent does not hear adds nothing there. The type
of `memories` decides which is compiled, see arrivals.py.
"""

from typing import Any, NamedTuple

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.compiler.lanes import everywhere, gather, mask_of, narrow, take
from shoal.core.messages import Briefing, Own, Report, Truth
from shoal.engine.listen import listener_at
from shoal.strategies import asking
from shoal.world.lists import LANES, note_leader


class Listed(NamedTuple):
    """The reports that arrive in a step, (L,) each: what is said, what is told of memories, and when [s]."""

    said: Any
    told: Any
    at: float


class SingleListed(Listed):
    """The same in single precision."""


@kernel
def sum_listed_by_lanes(arrived, listeners, links, params, agents, sums):
    """Add up what the neighbors of each listener exert on it, (S, L): a block at a time."""
    _sum_by_lanes(arrived, listeners, links, params, agents, sums, everywhere(0.0))


@kernel
def sum_single_listed_by_lanes(arrived, listeners, links, params, agents, sums):
    """The same in single precision."""
    _sum_by_lanes(arrived, listeners, links, params, agents, sums, narrow(everywhere(0.0)))


@kernel
def _sum_by_lanes(arrived, listeners, links, params, agents, sums, none):
    """The same, as precise as `none`."""
    lists, said, told, at = links.lists, arrived.said, arrived.told, arrived.at
    order = lists.cells.order
    block = np.empty((sums.shape[0], LANES))
    for number in range(lists.begins.size - 1):
        p = number * LANES
        me, totals = listeners_at(listeners, lists.cells, p, none), asking.no_sums(none, params)
        for c in range(lists.begins[number], lists.begins[number + 1]):
            q = lists.near[c]
            j = order[q]
            x, y = lists.cells.x[q], lists.cells.y[q]
            rank = asking.ranks_of(lists.rank, c, 0, params)
            other = Report(j, x, y, said.vx[j], said.vy[j], said.on_target[j], told[j], at, rank)
            totals = asking.added(totals, asking.influence(me, other, params), mask_of(lists.hears[c]))
        asking.put_sums(block, 0, totals)
        _hand_out(block, order, p, sums, agents)


@kernel
def _hand_out(block, order, p, sums, agents):
    """Give the agents at places p, p + 1, ... their sums."""
    for lane in range(min(LANES, agents - p)):
        for each in range(block.shape[0]):
            sums[each, order[p + lane]] = block[each, lane]


@kernel
def listeners_at(listeners, cells, p, none):
    """The agents at places p, p + 1, ... as one listener whose numbers are lanes, as precise as `none`."""
    i = take(cells.order, p, none)
    briefing = Briefing(0, 0.0, 0.0, 0.0, 0.0, 0.0, False, 0.0, 0.0)
    truth = Truth(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return Own(
        i,
        take(cells.own_x, p, none),
        take(cells.own_y, p, none),
        gather(listeners.vx, i, none),
        gather(listeners.vy, i, none),
        gather(listeners.on_target, i, none),
        gather(listeners.max_speed, i, none),
        listeners.time_step,
        listeners.time,
        gather(listeners.fleet, i, none),
        briefing,
        truth,
        0.0,
        0.0,
        False,
    )


@kernel
def sum_listed_influence(arrived, listeners, links, params, agents, sums):
    """The same for influences with branches."""
    lists, said, told, at = links.lists, arrived.said, arrived.told, arrived.at
    cells, order = lists.cells, lists.cells.order
    block = np.empty((sums.shape[0], LANES))
    for number in range(lists.begins.size - 1):
        p = number * LANES
        for lane in range(LANES):
            asking.clear(block, lane, params)
        for c in range(lists.begins[number], lists.begins[number + 1]):
            q = lists.near[c]
            j = order[q]
            for lane in range(LANES):
                me = listener_at(listeners, order[p + lane], cells.own_x[p + lane], cells.own_y[p + lane])
                rank = asking.rank_of(lists.rank, c, lane, params)
                other = Report(j, cells.x[q], cells.y[q], said.vx[j], said.vy[j], said.on_target[j], told[j], at, rank)
                pushed = asking.influence(me, other, params)
                asking.add(block, lane, pushed, (lists.hears[c] >> lane) & 1 != 0)
        _hand_out(block, order, p, sums, agents)


@kernel
def choose_listed_leaders(arrived, listeners, links, params, agents, leader, lowest):
    """Set leader[i] to the index of the neighbor that listener i follows, -1 if none; lowest[i] is its priority."""
    lists, said, told, at = links.lists, arrived.said, arrived.told, arrived.at
    cells, order = lists.cells, lists.cells.order
    anybody = False
    for j in range(agents):
        leader[j] = -1
        lowest[j] = np.inf
        other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j], at, None)
        leads = asking.leads(other, params)
        note_leader(lists, j, leads)
        anybody |= leads
    for number in range(lists.begins.size - 1 if anybody else 0):
        p = number * LANES
        for c in range(lists.begins[number], lists.begins[number + 1]):
            q = lists.near[c]
            if lists.leads[q] != 0:
                j = order[q]
                for lane in range(LANES):
                    if (lists.hears[c] >> lane) & 1 != 0:
                        i = order[p + lane]
                        me = listener_at(listeners, i, cells.own_x[p + lane], cells.own_y[p + lane])
                        rank = asking.rank_of(lists.rank, c, lane, params)
                        other = Report(
                            j, cells.x[q], cells.y[q], said.vx[j], said.vy[j], said.on_target[j], told[j], at, rank
                        )
                        priority = asking.priority(me, other, params)
                        if priority < lowest[i]:
                            lowest[i] = priority
                            leader[i] = j
