"""What each agent hears: its leader and the sum of its neighbors' influence."""

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.core.messages import Briefing, Own, Report, Truth
from shoal.strategies import contract


@kernel
def choose_leaders(said, told, block, links, params, first, agents, clock, leader, rank):
    """Set leader[i] to the index of the neighbor that listener i follows, -1 if none.

    Speakers that may not lead are skipped before the inner loop: few agents are on target at a time.
    """
    lanes = block[0].size
    square, reach = links.square, links.reach
    for i in range(lanes):
        leader[i] = -1
        rank[i] = np.inf
    for j in range(agents):
        other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j])
        if contract.leads(other, params):
            for i in range(lanes):
                me = _listener(block, first, i, clock)
                priority = contract.priority(me, other, params)
                better = square[j, i] <= reach[i] and priority < rank[i]
                rank[i] = priority if better else rank[i]
                leader[i] = j if better else leader[i]


@kernel
def sum_influence(said, told, block, links, params, first, agents, clock, sum_x, sum_y):
    """Add up what the neighbors of each listener exert on it, and count them in links.heard."""
    lanes = block[0].size
    square, reach, heard = links.square, links.reach, links.heard
    for i in range(lanes):
        sum_x[i] = 0.0
        sum_y[i] = 0.0
        heard[i] = 0
    for j in range(agents):
        if contract.has_influence(params):
            other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j])
            for i in range(lanes):
                me = _listener(block, first, i, clock)
                push_x, push_y = contract.influence(me, other, params)
                linked = square[j, i] <= reach[i]
                sum_x[i] += push_x if linked else 0.0
                sum_y[i] += push_y if linked else 0.0
                heard[i] += 1 if linked else 0
        else:
            for i in range(lanes):
                heard[i] += 1 if square[j, i] <= reach[i] else 0


@kernel
def _listener(block, first, i, clock):
    """Lane i of a block, as far as pairs need it: listeners in the inner loops have no briefing and no truth."""
    x, y, vx, vy, on_target, max_speed, fleet = block
    time_step, time = clock
    briefing = Briefing(0, 0.0, 0.0, 0.0, 0.0, 0.0)
    truth = Truth(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return Own(
        first + i, x[i], y[i], vx[i], vy[i], on_target[i], max_speed[i], time_step, time, fleet[i], briefing, truth
    )
