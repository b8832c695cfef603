"""What each agent hears: its leader and the sum of its neighbors' influence."""

from typing import Any, NamedTuple

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.compiler.lanes import WIDTH, counting, either, everywhere, put, take
from shoal.core.messages import Briefing, Own, Report, Truth
from shoal.strategies import asking
from shoal.world.neighbors import as_single, within, zero_of


class Arrived(NamedTuple):
    """The reports that arrive in a step, (L,) each: what is said, what is told of memories, and when [s]."""

    said: Any
    told: Any
    at: float


class InTurn(Arrived):
    """The same where listeners decide one after the other, and cannot be lanes."""


class Single(Arrived):
    """The same where distances are in single precision."""


class Listeners(NamedTuple):
    """The agents that decide together, from `first` on, (B,) each; and the time [s]."""

    first: int
    x: Any
    y: Any
    vx: Any
    vy: Any
    on_target: Any
    max_speed: Any
    fleet: Any
    time_step: float
    time: float


@kernel
def choose_leaders(arrived, listeners, links, params, agents, leader, lowest):
    """Set leader[i] to the index of the neighbor that listener i follows, -1 if none; lowest[i] is its priority.

    Speakers that may not lead are skipped before the inner loop: few agents are on target at a time.
    """
    lanes, said, told, at = listeners.x.size, arrived.said, arrived.told, arrived.at
    for i in range(lanes):
        leader[i] = -1
        lowest[i] = np.inf
    for j in range(agents):
        other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j], at, None)
        if asking.leads(other, params):
            for i in range(lanes):
                me = listener(listeners, i)
                rank = asking.rank_of(links.rank, j, i, params)
                other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j], at, rank)
                priority = asking.priority(me, other, params)
                better = within(links, j, i) and priority < lowest[i]
                lowest[i] = priority if better else lowest[i]
                leader[i] = j if better else leader[i]


@kernel
def sum_by_lanes(arrived, listeners, links, params, agents, sums):
    """Add up what the neighbors of each listener exert on it, and count them in links.heard; lanes are whole blocks.

    sums : (S, L), one row per sum of the strategy and one lane per listener
    """
    square, said, told, at = links.square, arrived.said, arrived.told, arrived.at
    none = everywhere(zero_of(links))
    for i in range(0, listeners.x.size, WIDTH):
        me = listeners_from(listeners, i, none)
        reach, heard, totals = take(links.reach, i, none), none, asking.no_sums(none, params)
        for j in range(agents):
            rank = asking.ranks_of(links.rank, j, i, params)
            other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j], at, rank)
            hears = take(square, (j, i), none) <= reach
            heard = either(hears, heard + 1.0, heard)
            totals = asking.added(totals, asking.influence(me, other, params), hears)
        put(links.heard, i, heard)
        asking.put_sums(sums, i, totals)


@kernel
def sum_influence(arrived, listeners, links, params, agents, sums):
    """The same for any number of listeners, and for influences with branches: lanes of inner loops."""
    lanes, heard, said, told, at = listeners.x.size, links.heard, arrived.said, arrived.told, arrived.at
    for i in range(lanes):
        asking.clear(sums, i, params)
        heard[i] = 0
    for j in range(agents):
        if asking.has_influence(params):
            for i in range(lanes):
                me = listener(listeners, i)
                rank = asking.rank_of(links.rank, j, i, params)
                other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j], at, rank)
                pushed = asking.influence(me, other, params)
                heard_now = within(links, j, i)
                asking.add(sums, i, pushed, heard_now)
                heard[i] += 1 if heard_now else 0
        else:
            for i in range(lanes):
                heard[i] += 1 if within(links, j, i) else 0


@kernel
def sum_single_by_lanes(arrived, listeners, links, params, agents, sums):
    """The same in single precision."""
    sum_by_lanes(arrived, listeners, as_single(links), params, agents, sums)


@kernel
def sum_single_influence(arrived, listeners, links, params, agents, sums):
    """The same by distances in single precision."""
    sum_influence(arrived, listeners, as_single(links), params, agents, sums)


@kernel
def choose_single_leaders(arrived, listeners, links, params, agents, leader, lowest):
    """The same by distances in single precision."""
    choose_leaders(arrived, listeners, as_single(links), params, agents, leader, lowest)


@kernel
def listeners_from(listeners, i, none):
    """Lanes i, i + 1, ... of a block as one listener whose numbers are lanes, as precise as `none`."""
    briefing = Briefing(0, 0.0, 0.0, 0.0, 0.0, 0.0, False, 0.0, 0.0)
    truth = Truth(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return Own(
        counting(listeners.first + i),
        take(listeners.x, i, none),
        take(listeners.y, i, none),
        take(listeners.vx, i, none),
        take(listeners.vy, i, none),
        take(listeners.on_target, i, none),
        take(listeners.max_speed, i, none),
        listeners.time_step,
        listeners.time,
        take(listeners.fleet, i, none),
        briefing,
        truth,
        0.0,
        0.0,
        False,
    )


@kernel
def listener(listeners, i):
    """Lane i of a block, as far as pairs need it: listeners in the inner loops have no briefing and no truth."""
    return listener_at(listeners, i, listeners.x[i], listeners.y[i])


@kernel
def listener_at(listeners, i, x, y):
    """Lane i of a block, which is at x, y."""
    briefing = Briefing(0, 0.0, 0.0, 0.0, 0.0, 0.0, False, 0.0, 0.0)
    truth = Truth(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return Own(
        listeners.first + i,
        x,
        y,
        listeners.vx[i],
        listeners.vy[i],
        listeners.on_target[i],
        listeners.max_speed[i],
        listeners.time_step,
        listeners.time,
        listeners.fleet[i],
        briefing,
        truth,
        0.0,
        0.0,
        False,
    )
