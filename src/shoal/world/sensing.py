"""Who detects a target: the paper's disc (Eq. 1), with chances to miss it and to see what is not there."""

from shoal.compiler.kernel import kernel
from shoal.core.draws import split, uniform

_DETECTION = 1 << 21  # purposes that no strategy draws for
_FALSE_ALARM = _DETECTION + 1


@kernel
def sense(swarm, targets, world, step_key):
    """Set on_target (f_i = -1 in the paper) of every agent within its sensor radius plus a target's radius.

    Kwa et al., Heterogeneous Swarms, Eq. 1. Counts the watchers of every target and returns how many agents watch any:
    false alarms set on_target, but watch nothing.
    """
    agents = world.agents
    engaged = 0
    for i in range(agents):
        swarm.on_target[i] = False
    for j in range(targets.size):
        target = targets[j]
        watchers = 0
        if target.present:
            for i in range(agents):
                dx = swarm.x[i] - target.x
                dy = swarm.y[i] - target.y
                reach = swarm.sensor_radius[i] + target.radius
                sees = (dx * dx + dy * dy <= reach * reach) & (swarm.alive[i] > 0.0)
                if world.imperfect:
                    sees &= uniform(split(split(step_key, i), _DETECTION), j) < swarm.detection[i]
                swarm.on_target[i] |= sees
                watchers += sees
        targets[j].watchers = watchers
    for i in range(agents):
        engaged += swarm.on_target[i]
    if world.imperfect:
        for i in range(agents):
            false_alarm = uniform(split(step_key, i), _FALSE_ALARM) < swarm.false_alarm[i]
            swarm.on_target[i] |= false_alarm & (swarm.alive[i] > 0.0)
    return engaged
