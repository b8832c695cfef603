"""The paper's strategy with a repulsion that never changes: what the adaptive one is argued against.

Kwa, Leong Kit, Bouffanais, "Optimal Swarm Strategy for Dynamic Target Search and Tracking", AAMAS 2020 (the constant
case); Kwa et al., OCEANS 2020, Eqs. 2-4 without Algorithm 1.
"""

from typing import Annotated, NamedTuple

from shoal.core.draws import uniform
from shoal.core.units import Doc, Follows, Meters, Range
from shoal.strategies.contract import strategy
from shoal.strategies.parts import inverse_power, power


class ConstantRepulsion(NamedTuple):
    """Parameters, as in knn-pso."""

    inertia: Annotated[float, Range(), Doc("omega: share of the velocity kept from one step to the next")] = 1.0
    social: Annotated[float, Range(), Doc("c: largest share of the distance to the leader wanted in one step")] = 0.5
    repulsion: Annotated[
        Meters, Follows("spacing"), Range(), Doc("a_R; sqrt(pi R^2 / N) with R = 2 m and N = 50 in the published runs")
    ] = 0.5013256549262001
    repulsion_exponent: Annotated[float, Range(0.0, 100.0), Doc("d: steepness of the repulsion")] = 6.0
    repulsion_step: Annotated[
        Meters, Follows("step"), Range(), Doc("displacement by a neighbor at distance a_R in one step")
    ] = 1.0


def influence(me, other, params):
    """One term of Eq. 4 without a_R^d."""
    return inverse_power(me, other, params.repulsion_exponent)


def decide(me, heard, memory, params, draw):
    """k-nearest PSO with constant repulsion.

    v <- omega v + (c r (Nbest - x) + repulsion_step sum_j (a_R / r_ij)^d (x_i - x_j) / r_ij) / dt
    """
    push = params.repulsion_step * power(params.repulsion, params.repulsion_exponent)
    step_x = push * heard.sum_x
    step_y = push * heard.sum_y
    if heard.found and not me.on_target:
        share = params.social * uniform(draw, 0)
        step_x += share * (heard.x - me.x)
        step_y += share * (heard.y - me.y)
    rate = 1.0 / me.time_step
    return params.inertia * me.vx + rate * step_x, params.inertia * me.vy + rate * step_y


strategy(
    "constant-repulsion",
    params=ConstantRepulsion,
    influence=influence,
    reference="Kwa, Leong Kit, Bouffanais, AAMAS 2020",
)(decide)
