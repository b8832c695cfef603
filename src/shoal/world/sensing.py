"""Who detects a target: the paper's disc (Eq. 1)."""

from shoal.core.kernel import kernel


@kernel
def sense(swarm, targets, agents):
    """Set on_target (f_i = -1 in the paper) of every agent within its sensor radius plus a target's radius.

    Kwa et al., Heterogeneous Swarms, Eq. 1. Returns how many agents are on target.
    """
    engaged = 0
    for i in range(agents):
        swarm.on_target[i] = False
    for target in targets:
        if target.present:
            for i in range(agents):
                dx = swarm.x[i] - target.x
                dy = swarm.y[i] - target.y
                reach = swarm.sensor_radius[i] + target.radius
                swarm.on_target[i] |= dx * dx + dy * dy <= reach * reach
    for i in range(agents):
        engaged += swarm.on_target[i]
    return engaged
