"""The last sighting, stamped with its time and passed on from agent to agent: memory that the network shares.

Blackboard-like memory of the swarm as Kwa, Leong Kit and Bouffanais discuss for evasive targets ("Balancing Collective
Exploration and Exploitation in Multi-Agent and Multi-Robot Systems: A Review", Frontiers in Robotics and AI 8, 2022,
on memory); gossip of the freshest entry as in Demers et al., "Epidemic algorithms for replicated database
maintenance", PODC 1987 (last write wins by time stamp). The rest is knn-pso. A neighbor on target is a sighting of the
step in which its report arrives: with a delayed radio, stamps are as late.
"""

from typing import Annotated, NamedTuple

from shoal.core.draws import uniform
from shoal.core.units import Doc, Follows, Meters, Range, Seconds
from shoal.strategies.contract import strategy
from shoal.strategies.parts import adapted, inverse_power, power


class SharedSighting(NamedTuple):
    """Parameters; those of knn-pso, and the memory's."""

    inertia: Annotated[float, Range(), Doc("omega: share of the velocity kept from one step to the next")] = 1.0
    social: Annotated[float, Range(), Doc("c: largest share of the distance to the sighting wanted in one step")] = 0.5
    max_age: Annotated[
        Seconds,
        Follows("reach"),
        Range(),
        Doc("an older sighting attracts nobody; 3 m/s leave a reach of 1 m in 0.33 s"),
    ] = 0.3
    repulsion_start: Annotated[Meters, Follows("spacing"), Range(), Doc("a_R at the start")] = 0.5013256549262001
    repulsion_min: Annotated[
        Meters, Follows("spacing"), Range(), Doc("a_R shrinks while above this and a sighting is fresh")
    ] = 0.375
    repulsion_max: Annotated[Meters, Follows("spacing"), Range(), Doc("a_R grows while below this and none is")] = 1.5
    delta: Annotated[Meters, Follows("step"), Range(), Doc("change of a_R in one step")] = 0.01
    repulsion_exponent: Annotated[float, Range(0.0, 100.0), Doc("d: steepness of the repulsion")] = 6.0
    repulsion_step: Annotated[
        Meters, Follows("step"), Range(), Doc("displacement by a neighbor at distance a_R in one step")
    ] = 1.0


def begin(me, memory, params, draw):
    """a_R at the start, and no sighting."""
    memory.repulsion = params.repulsion_start
    memory.sighting_time = -1e9


def leads(other, params):
    """Whoever is on target, and whoever knows of a sighting."""
    return other.on_target or other.told.sighting_time >= 0.0


def priority(me, other, params):
    """The freshest sighting first, being on target freshest of all; of equal ones the nearest."""
    dx = me.x - other.x
    dy = me.y - other.y
    age = 0.0 if other.on_target else me.time - other.told.sighting_time
    return dx * dx + dy * dy + _SECOND * age


def influence(me, other, params):
    """One term of the repulsion without a_R^d."""
    return inverse_power(me, other, params.repulsion_exponent)


def decide(me, heard, memory, params, draw):
    """k-nearest PSO toward the freshest sighting known.

    v <- omega v + (c r (sighting - x) + repulsion) / dt while the sighting is younger than max_age
    """
    if me.on_target:
        memory.sighting_x = me.x
        memory.sighting_y = me.y
        memory.sighting_time = me.time
    elif heard.found and heard.on_target:
        memory.sighting_x = heard.x
        memory.sighting_y = heard.y
        memory.sighting_time = me.time
    elif heard.found and heard.told.sighting_time > memory.sighting_time:
        memory.sighting_x = heard.told.sighting_x
        memory.sighting_y = heard.told.sighting_y
        memory.sighting_time = heard.told.sighting_time
    fresh = me.time - memory.sighting_time < params.max_age
    memory.repulsion = adapted(
        memory.repulsion, fresh, params.repulsion_min, params.repulsion_max, params.delta, params.delta
    )
    push = params.repulsion_step * power(memory.repulsion, params.repulsion_exponent)
    step_x = push * heard.sum_x
    step_y = push * heard.sum_y
    if fresh and not me.on_target:
        share = params.social * uniform(draw, 0)
        step_x += share * (memory.sighting_x - me.x)
        step_y += share * (memory.sighting_y - me.y)
    rate = 1.0 / me.time_step
    return params.inertia * me.vx + rate * step_x, params.inertia * me.vy + rate * step_y


_SECOND = 1e12  # [m^2/s]: no distance outweighs a fresher sighting

strategy(
    "shared-sighting",
    params=SharedSighting,
    memory={"sighting_x": "m", "sighting_y": "m", "sighting_time": "s", "repulsion": "m"},
    tells=("sighting_x", "sighting_y", "sighting_time"),
    begin=begin,
    leads=leads,
    priority=priority,
    influence=influence,
    reference="Demers et al., PODC 1987 (gossip); Kwa et al., Front. Robot. AI 8, 2022 (memory)",
)(decide)
