"""PSO with a personal best that ages: the memory-driven swarm that the paper argues against.

Kennedy and Eberhart, "Particle swarm optimization", ICNN 1995: the cognitive term; with a binary sensor the personal
best is the last place where the agent itself was on target. Its limited age follows Carlisle and Dozier, "Adapting
particle swarm optimization to dynamic environments", ICAI 2000 (outdated memory is discarded). The rest is knn-pso.
"""

from typing import Annotated, NamedTuple

from shoal.core.draws import uniform
from shoal.core.units import Doc, Follows, Meters, Range, Seconds
from shoal.strategies.contract import strategy
from shoal.strategies.parts import adapted, inverse_power, power


class MemoryPso(NamedTuple):
    """Parameters; those of knn-pso, and the memory's."""

    inertia: Annotated[float, Range(), Doc("omega: share of the velocity kept from one step to the next")] = 1.0
    cognitive: Annotated[
        float, Range(), Doc("c1: largest share of the distance to the own best wanted in one step")
    ] = 0.5
    social: Annotated[float, Range(), Doc("c2: largest share of the distance to the leader wanted in one step")] = 0.5
    max_age: Annotated[Seconds, Follows("spacing"), Range(), Doc("the own best is forgotten when this old")] = 5.0
    repulsion_start: Annotated[Meters, Follows("spacing"), Range(), Doc("a_R at the start")] = 0.5013256549262001
    repulsion_min: Annotated[
        Meters, Follows("spacing"), Range(), Doc("a_R shrinks while above this and somebody is on target")
    ] = 0.375
    repulsion_max: Annotated[
        Meters, Follows("spacing"), Range(), Doc("a_R grows while below this and nobody is on target")
    ] = 1.5
    delta: Annotated[Meters, Follows("step"), Range(), Doc("change of a_R in one step")] = 0.01
    repulsion_exponent: Annotated[float, Range(0.0, 100.0), Doc("d: steepness of the repulsion")] = 6.0
    repulsion_step: Annotated[
        Meters, Follows("step"), Range(), Doc("displacement by a neighbor at distance a_R in one step")
    ] = 1.0


def begin(me, memory, params, draw):
    """a_R at the start, and no best."""
    memory.repulsion = params.repulsion_start
    memory.best_time = -1e9


def influence(me, other, params):
    """One term of the repulsion without a_R^d."""
    return inverse_power(me, other, params.repulsion_exponent)


def decide(me, heard, memory, params, draw):
    """k-nearest PSO with a personal best of limited age.

    v <- omega v + (c1 r1 (best_i - x) + c2 r2 (Nbest - x) + repulsion) / dt, best_i while younger than max_age
    """
    memory.repulsion = adapted(
        memory.repulsion,
        me.on_target or heard.found,
        params.repulsion_min,
        params.repulsion_max,
        params.delta,
        params.delta,
    )
    if me.on_target:
        memory.best_x = me.x
        memory.best_y = me.y
        memory.best_time = me.time
    push = params.repulsion_step * power(memory.repulsion, params.repulsion_exponent)
    step_x = push * heard.sum_x
    step_y = push * heard.sum_y
    if not me.on_target:
        if me.time - memory.best_time < params.max_age:
            share = params.cognitive * uniform(draw, 0)
            step_x += share * (memory.best_x - me.x)
            step_y += share * (memory.best_y - me.y)
        if heard.found:
            share = params.social * uniform(draw, 1)
            step_x += share * (heard.x - me.x)
            step_y += share * (heard.y - me.y)
    rate = 1.0 / me.time_step
    return params.inertia * me.vx + rate * step_x, params.inertia * me.vy + rate * step_y


strategy(
    "memory-pso",
    params=MemoryPso,
    memory={"repulsion": "m", "best_x": "m", "best_y": "m", "best_time": "s"},
    begin=begin,
    influence=influence,
    reference="Kennedy, Eberhart, ICNN 1995; Carlisle, Dozier, ICAI 2000",
)(decide)
