"""Velocity fluctuation, from which Xi and the response are made."""

import math

from shoal.compiler.kernel import kernel


@kernel
def tally_velocity_fluctuation(tally, batch, swarm, agents, active, scratch):
    """Add |u_i| = |v_i - mean v| of every agent, by fleet; v at the start of the step.

    Kwa et al., Heterogeneous Swarms, Eq. 5. Eq. 7 as printed sums vectors that cancel to zero; the norm is meant.
    `active` agents are alive; the others lie still and count for nothing.
    """
    mean_x = 0.0
    mean_y = 0.0
    for i in range(agents):
        mean_x += swarm.vx[i]
        mean_y += swarm.vy[i]
    mean_x /= max(active, 1)  # all may be lost
    mean_y /= max(active, 1)
    for i in range(agents):
        ux = swarm.vx[i] - mean_x
        uy = swarm.vy[i] - mean_y
        scratch[i] = swarm.alive[i] * math.sqrt(ux * ux + uy * uy)
    begin = 0
    for fleet in range(swarm.fleet_end.size):
        total = 0.0
        there = 0
        for i in range(begin, swarm.fleet_end[fleet]):
            total += scratch[i]
            there += swarm.alive[i] > 0.0
        tally.agent_steps[batch, fleet] += there
        begin = swarm.fleet_end[fleet]
        tally.fluctuation[batch, fleet] += total
