"""Locally constrained PSO whose agents keep an equilibrium distance: attraction beyond it, repulsion within.

After Coquet, Aubert, Martin et al., "A Local Charged Particle Swarm Optimization to track an underwater mobile source"
(OCEANS 2019), which adds to a local PSO an interaction that vanishes at an equilibrium distance. The interaction here
is the attraction-repulsion of Gazi and Passino, "Stability analysis of swarms", IEEE Trans. Automatic Control 48, 2003:
g(y) = -y (a - b exp(-|y|^2 / c)), with exp replaced by the rational (1 + |y|^2 / c)^-2, whose zero is at
|y| = r_eq = sqrt(c (sqrt(b / a) - 1)) and which needs no exponential per pair.
"""

import math
from typing import Annotated, NamedTuple

from shoal.core.draws import uniform
from shoal.core.units import Doc, Follows, Meters, Range
from shoal.strategies.contract import strategy


class AttractionRepulsion(NamedTuple):
    """Parameters."""

    inertia: Annotated[float, Range(), Doc("omega: share of the velocity kept from one step to the next")] = 0.7
    social: Annotated[float, Range(), Doc("c: largest share of the distance to the leader wanted in one step")] = 0.5
    equilibrium: Annotated[
        Meters,
        Follows("spacing"),
        Range(open=True),
        Doc("r_eq: distance at which two agents neither attract nor repel"),
    ] = 2.4
    attraction: Annotated[
        float, Range(open=True), Doc("a: share of the distance to a far neighbor wanted in one step")
    ] = 0.002
    repulsion: Annotated[
        float, Range(open=True), Doc("b: share of the distance to a near neighbor by which it pushes in one step")
    ] = 0.5


def influence(me, other, params):
    """The displacement toward (a) or from (b) one neighbor [m]."""
    dx = me.x - other.x
    dy = me.y - other.y
    width = params.equilibrium * params.equilibrium / (math.sqrt(params.repulsion / params.attraction) - 1.0)
    fall = 1.0 + (dx * dx + dy * dy) / width
    pull = params.repulsion / (fall * fall) - params.attraction
    return pull * dx, pull * dy


def decide(me, heard, memory, params, draw):
    """Local PSO whose agents keep an equilibrium distance.

    v <- omega v + (c r (Nbest - x) + sum_j (b / (1 + r_ij^2 / w)^2 - a) (x_i - x_j)) / dt
    with w = r_eq^2 / (sqrt(b / a) - 1)
    """
    step_x = heard.sum_x
    step_y = heard.sum_y
    if heard.found and not me.on_target:
        share = params.social * uniform(draw, 0)
        step_x += share * (heard.x - me.x)
        step_y += share * (heard.y - me.y)
    rate = 1.0 / me.time_step
    return params.inertia * me.vx + rate * step_x, params.inertia * me.vy + rate * step_y


strategy(
    "attraction-repulsion",
    params=AttractionRepulsion,
    influence=influence,
    reference="after Coquet et al., OCEANS 2019; Gazi, Passino, IEEE TAC 48, 2003",
)(decide)
