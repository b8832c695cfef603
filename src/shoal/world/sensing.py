"""Which agents detect a target: the paper's disc (Eq. 1), with chances to miss it and of false alarms."""

import math

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
def glimpsed(distance, rate, time_step):
    """Chance to detect a target `distance` [m] away in a time-step: Koopman's law of the inverse cube.

    The rate of detection at range r is m / r^3, so that the chance in time t is 1 - exp(-m t / r^3), whatever the steps
    that t is made of. A target that passes in a straight line at speed v and least distance x is then detected with
    the chance 1 - exp(-2 m / (v x^2)), and the sweep width is sqrt(8 pi m / v). Koopman, Search and Screening, 1946
    (Pergamon, 1980), chapter 3, where m = k h.

    distance : to the rim of the target, 0 or less where the agent is on it; rate : m [m^3/s], 0 of a definite range
    """
    if rate <= 0.0 or distance <= 0.0:
        return 1.0
    return -math.expm1(-rate * time_step / (distance * distance * distance))


@kernel
def imagines(key, false_alarm):
    """Whether a sensor reports an absent target, by its chance; `key` is the agent's of the step."""
    return uniform(key, _FALSE_ALARM) < false_alarm


@kernel
def detects(swarm, target, j, effects, sea, world, step_key, i):
    """Whether agent i detects target j, which is present."""
    dx = swarm.x[i] - target.x
    dy = swarm.y[i] - target.y
    sees = within_reach(dx, dy, swarm.horizon[i] + target.radius) & (swarm.alive[i] > 0.0)
    if world.coastal and sees:
        sees = in_sight(sea.land, swarm.x[i], swarm.y[i], target.x, target.y)
    if world.imperfect:
        chance = swarm.detection[i] * effects[i].senses
        if swarm.glimpse[i] > 0.0:
            distance = math.sqrt(dx * dx + dy * dy) - target.radius
            chance *= glimpsed(distance, swarm.glimpse[i], world.time_step)
        sees &= notices(split(step_key, i), j, chance)
    return sees


@kernel
def believes(swarm, effects, step_key, i):
    """Whether agent i believes to be on target where sensors imagine some: it is engaged, or has a false alarm."""
    alarm = imagines(split(step_key, i), swarm.false_alarm[i] * effects[i].senses)
    return swarm.engaged[i] | (alarm & (swarm.alive[i] > 0.0))


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
                sees = detects(swarm, target, j, effects, sea, world, step_key, i)
                swarm.on_target[i] |= sees
                watchers += sees
        targets[j].watchers = watchers
    for i in range(agents):
        swarm.engaged[i] = swarm.on_target[i]
        engaged += swarm.on_target[i]
    if world.imperfect:
        for i in range(agents):
            swarm.on_target[i] = believes(swarm, effects, step_key, i)
    return engaged
