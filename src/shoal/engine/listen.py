"""What each agent hears: its leader and the sum of its neighbors' influence."""

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.core.messages import Briefing, Own, Report, Truth
from shoal.strategies import contract


@kernel
def choose_leaders(said, told, block, links, params, first, agents, clock, leader, lowest):
    """Set leader[i] to the index of the neighbor that listener i follows, -1 if none; lowest[i] is its priority.

    Speakers that may not lead are skipped before the inner loop: few agents are on target at a time.
    """
    lanes = block[0].size
    square, reach, at = links.square, links.reach, clock[2]
    for i in range(lanes):
        leader[i] = -1
        lowest[i] = np.inf
    for j in range(agents):
        other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j], at, None)
        if contract.leads(other, params):
            for i in range(lanes):
                me = _listener(block, first, i, clock)
                rank = contract.rank_of(links.rank, j, i, params)
                other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j], at, rank)
                priority = contract.priority(me, other, params)
                better = square[j, i] <= reach[i] and priority < lowest[i]
                lowest[i] = priority if better else lowest[i]
                leader[i] = j if better else leader[i]


@kernel
def sum_influence(said, told, block, links, params, first, agents, clock, sums):
    """Add up what the neighbors of each listener exert on it, and count them in links.heard.

    sums : (S, L), one row per sum of the strategy and one lane per listener
    """
    lanes = block[0].size
    square, reach, heard, at = links.square, links.reach, links.heard, clock[2]
    for i in range(lanes):
        contract.clear(sums, i, params)
        heard[i] = 0
    for j in range(agents):
        if contract.has_influence(params):
            for i in range(lanes):
                me = _listener(block, first, i, clock)
                rank = contract.rank_of(links.rank, j, i, params)
                other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j], at, rank)
                pushed = contract.influence(me, other, params)
                linked = square[j, i] <= reach[i]
                contract.add(sums, i, pushed, linked)
                heard[i] += 1 if linked else 0
        else:
            for i in range(lanes):
                heard[i] += 1 if square[j, i] <= reach[i] else 0


@kernel
def _listener(block, first, i, clock):
    """Lane i of a block, as far as pairs need it: listeners in the inner loops have no briefing and no truth."""
    x, y, vx, vy, on_target, max_speed, fleet = block
    time_step, time, _ = clock
    briefing = Briefing(0, 0.0, 0.0, 0.0, 0.0, 0.0)
    truth = Truth(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return Own(
        first + i, x[i], y[i], vx[i], vy[i], on_target[i], max_speed[i], time_step, time, fleet[i], briefing, truth
    )
