"""Which agents detect a target: the paper's disc (Eq. 1), with chances to miss it and of false alarms."""

from shoal.compiler.kernel import kernel
from shoal.core.draws import split, uniform
from shoal.world.sea.sight import in_sight

_DETECTION = 1 << 21  # purposes that no strategy draws for
_FALSE_ALARM = _DETECTION + 1


@kernel
def within_reach(dx, dy, reach):
    """Whether a target dx, dy [m] away is within a sensor's radius plus its own, `reach` [m]: Eq. 1."""
    return dx * dx + dy * dy <= reach * reach


@kernel
def notices(key, target, detection):
    """Whether a sensor notices a target within its reach, by its chance; `key` is the agent's of the step."""
    return uniform(split(key, _DETECTION), target) < detection


@kernel
def imagines(key, false_alarm):
    """Whether a sensor reports an absent target, by its chance; `key` is the agent's of the step."""
    return uniform(key, _FALSE_ALARM) < false_alarm


@kernel
def sense(swarm, targets, effects, sea, world, step_key):
    """Set on_target (f_i = -1 in the paper) of every agent within its sensor radius plus a target's radius.

    Kwa et al., Heterogeneous Swarms, Eq. 1. Counts the watchers of every target and returns how many agents watch any,
    which are `engaged`: false alarms set on_target, but watch nothing.

    effects : (L,) records of what disturbances do to each agent, see world/disturbances/contract.py
    sea : its land hides targets
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
                sees = within_reach(dx, dy, swarm.sensor_radius[i] + target.radius) & (swarm.alive[i] > 0.0)
                if world.coastal and sees:
                    sees = in_sight(sea.land, swarm.x[i], swarm.y[i], target.x, target.y)
                if world.imperfect:
                    sees &= notices(split(step_key, i), j, swarm.detection[i] * effects[i].senses)
                swarm.on_target[i] |= sees
                watchers += sees
        targets[j].watchers = watchers
    for i in range(agents):
        swarm.engaged[i] = swarm.on_target[i]
        engaged += swarm.on_target[i]
    if world.imperfect:
        for i in range(agents):
            alarm = imagines(split(step_key, i), swarm.false_alarm[i] * effects[i].senses)
            swarm.on_target[i] |= alarm & (swarm.alive[i] > 0.0)
    return engaged
