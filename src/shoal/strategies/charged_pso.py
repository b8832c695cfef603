"""Charged PSO: particles that repel each other like charges, so that the swarm never collapses.

Blackwell and Bentley, "Dynamic search with charged swarms", GECCO 2002: a_i = sum_j Q_i Q_j / r_ij^3 (x_i - x_j) for
p_core <= r_ij <= p, the strength at the core inside it, nothing beyond the perception limit p. All are charged alike;
the attraction is to the neighborhood's best only, since a personal best is a place where the target no longer is.
"""

import math
from typing import Annotated, NamedTuple

from shoal.core.draws import uniform
from shoal.core.units import Doc, Follows, Meters, Range
from shoal.strategies.contract import strategy


class ChargedPso(NamedTuple):
    """Parameters."""

    inertia: Annotated[float, Range(), Doc("omega: share of the velocity kept from one step to the next")] = 0.7
    social: Annotated[float, Range(), Doc("c: largest share of the distance to the leader wanted in one step")] = 0.5
    charge: Annotated[
        Meters,
        Follows("spacing", "spacing", "step"),
        Range(),
        Doc("q: two charges this far apart push each other this far in a step"),
    ] = 0.63
    core: Annotated[
        Meters, Follows("spacing"), Range(), Doc("p_core: nearer ones push no harder than at this distance")
    ] = 0.3
    perception: Annotated[Meters, Follows("spacing"), Range(), Doc("p: those farther away do not push")] = 4.0


def influence(me, other, params):
    """Coulomb's push of one neighbor, without the charges [m^-2]."""
    dx = me.x - other.x
    dy = me.y - other.y
    square = dx * dx + (dy * dy + _SOFTENING)
    held = max(square, params.core * params.core)
    push = (square <= params.perception * params.perception) / (held * math.sqrt(square))
    return push * dx, push * dy


def decide(me, heard, memory, params, draw):
    """PSO of particles that repel each other like charges.

    v <- omega v + (c r (Nbest - x) + q^3 sum_j (x_i - x_j) / (max(r_ij, p_core)^2 r_ij)) / dt
    """
    strength = params.charge * params.charge * params.charge
    step_x = strength * heard.sum_x
    step_y = strength * heard.sum_y
    if heard.found and not me.on_target:
        share = params.social * uniform(draw, 0)
        step_x += share * (heard.x - me.x)
        step_y += share * (heard.y - me.y)
    rate = 1.0 / me.time_step
    return params.inertia * me.vx + rate * step_x, params.inertia * me.vy + rate * step_y


_SOFTENING = 1e-60  # [m^2]

strategy("charged-pso", params=ChargedPso, influence=influence, reference="Blackwell, Bentley, GECCO 2002")(decide)
