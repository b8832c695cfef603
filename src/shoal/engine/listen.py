"""What each agent hears: its leader and the sum of its neighbors' influence."""

import numpy as np

from shoal.core.agents import Own, Report
from shoal.core.kernel import kernel
from shoal.strategies import contract


@kernel
def choose_leaders(swarm, block, links, params, first, agents, time_step, leader, rank):
    """Set leader[i] to the index of the neighbor that listener i follows, -1 if none.

    Speakers that may not lead are skipped before the inner loop: few agents are on target at a time.
    """
    x, y, vx, vy, on_target, max_speed = block
    lanes = x.size
    square, reach = links.square, links.reach
    for i in range(lanes):
        leader[i] = -1
        rank[i] = np.inf
    for j in range(agents):
        other = Report(j, swarm.x[j], swarm.y[j], swarm.vx[j], swarm.vy[j], swarm.on_target[j])
        if contract.leads(other, params):
            for i in range(lanes):
                me = Own(first + i, x[i], y[i], vx[i], vy[i], on_target[i], max_speed[i], time_step)
                priority = contract.priority(me, other, params)
                better = square[j, i] <= reach[i] and priority < rank[i]
                rank[i] = priority if better else rank[i]
                leader[i] = j if better else leader[i]


@kernel
def sum_influence(swarm, block, links, params, first, agents, time_step, sum_x, sum_y):
    """Add up what the neighbors of each listener exert on it, and count them in links.heard."""
    x, y, vx, vy, on_target, max_speed = block
    lanes = x.size
    square, reach, heard = links.square, links.reach, links.heard
    for i in range(lanes):
        sum_x[i] = 0.0
        sum_y[i] = 0.0
        heard[i] = 0
    for j in range(agents):
        if contract.has_influence(params):
            other = Report(j, swarm.x[j], swarm.y[j], swarm.vx[j], swarm.vy[j], swarm.on_target[j])
            for i in range(lanes):
                me = Own(first + i, x[i], y[i], vx[i], vy[i], on_target[i], max_speed[i], time_step)
                push_x, push_y = contract.influence(me, other, params)
                linked = square[j, i] <= reach[i]
                sum_x[i] += push_x if linked else 0.0
                sum_y[i] += push_y if linked else 0.0
                heard[i] += 1 if linked else 0
        else:
            for i in range(lanes):
                heard[i] += 1 if square[j, i] <= reach[i] else 0
