"""The paper's strategy: k-nearest particle-swarm attraction with adaptive repulsion.

Kwa, Tokic, Yue, Bouffanais, "Heterogeneous Swarms for Maritime Dynamic Target Search and Tracking", OCEANS 2020:
Eqs. 2-4, Algorithms 1 and 2. The predecessor (Kwa, Leong Kit, Bouffanais, AAMAS 2020) differs in parameters only.
"""

from typing import Annotated, NamedTuple

from shoal.core.draws import uniform
from shoal.core.units import Choice, Doc, Follows, Meters, Range
from shoal.strategies.contract import strategy
from shoal.strategies.parts import adapted, inverse_power, power


class KnnPso(NamedTuple):
    """Parameters; the paper adds pure numbers per step, so social and repulsion_step act once per time-step."""

    inertia: Annotated[float, Range(), Doc("omega: share of the velocity kept from one step to the next")] = 1.0
    social: Annotated[float, Range(), Doc("c: largest share of the distance to the leader wanted in one step")] = 0.5
    social_draws: Annotated[int, Choice(("scalar", "per-axis")), Doc("r: one draw for both axes, or one each")] = 0
    follow: Annotated[int, Choice(("nearest", "lowest-index")), Doc("which neighbor on target is followed")] = 0
    repulsion_start: Annotated[Meters, Follows("spacing"), Range(), Doc("a_R at the start")] = 0.5013256549262001
    repulsion_min: Annotated[
        Meters, Follows("spacing"), Range(), Doc("a_R shrinks while above this and somebody is on target")
    ] = 0.375
    repulsion_max: Annotated[
        Meters, Follows("spacing"), Range(), Doc("a_R grows while below this and nobody is on target")
    ] = 1.5
    delta: Annotated[Meters, Follows("step"), Range(), Doc("growth of a_R in one step with nobody on target")] = 0.01
    shrink: Annotated[float, Range(), Doc("deltas that a_R shrinks by in one step with somebody on target")] = 1.0
    repulsion_exponent: Annotated[float, Range(0.0, 100.0), Doc("d: steepness of the repulsion")] = 6.0
    repulsion_step: Annotated[
        Meters, Follows("step"), Range(), Doc("displacement by a neighbor at distance a_R in one step")
    ] = 1.0


def begin(me, memory, params, draw):
    """a_R at the start."""
    memory.repulsion = params.repulsion_start


def priority(me, other, params):
    """Nbest: the nearest neighbor on target, or the one of lowest index."""
    dx = me.x - other.x
    dy = me.y - other.y
    nearest = dx * dx + dy * dy
    return nearest if params.follow == 0 else float(other.id)


def influence(me, other, params):
    """One term of Eq. 4 without a_R^d, which `decide` multiplies."""
    return inverse_power(me, other, params.repulsion_exponent)


def decide(me, heard, memory, params, draw):
    """k-nearest PSO with adaptive repulsion: the paper's.

    v <- omega v + (c r (Nbest - x) + repulsion_step sum_j (a_R / r_ij)^d (x_i - x_j) / r_ij) / dt     Eq. 2 + Eq. 4
    """
    contact = me.on_target or heard.found
    memory.repulsion = adapted(
        memory.repulsion,
        contact,
        params.repulsion_min,
        params.repulsion_max,
        params.delta,
        params.delta * params.shrink,
    )
    push = params.repulsion_step * power(memory.repulsion, params.repulsion_exponent)
    step_x = push * heard.sum_x
    step_y = push * heard.sum_y
    if heard.found and not me.on_target:
        draw_x = uniform(draw, 0)
        draw_y = draw_x if params.social_draws == 0 else uniform(draw, 1)
        step_x += params.social * draw_x * (heard.x - me.x)
        step_y += params.social * draw_y * (heard.y - me.y)
    rate = 1.0 / me.time_step
    return params.inertia * me.vx + rate * step_x, params.inertia * me.vy + rate * step_y


strategy(
    "knn-pso",
    params=KnnPso,
    memory={"repulsion": "m"},
    begin=begin,
    priority=priority,
    influence=influence,
    reference="Kwa, Tokic, Yue, Bouffanais, OCEANS 2020",
)(decide)
