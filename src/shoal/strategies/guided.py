"""Guided: the paper's rule, of which somebody outside says a_R and the attraction at every step: for environments."""

from typing import NamedTuple

from shoal.strategies import contract
from shoal.strategies.contract import strategy
from shoal.strategies.parts import inverse_power, power


class Guided(NamedTuple):
    """Parameters, as in knn_pso.py; repulsion_step [m]."""

    inertia: float = 1.0
    repulsion_exponent: float = 6.0
    repulsion_step: float = 1.0


def influence(me, other, params):
    """One term of Eq. 4 without a_R^d, which `decide` multiplies."""
    return inverse_power(me, other, params.repulsion_exponent)


def decide(me, heard, memory, params, draw):
    """The paper's velocity with the a_R and the attraction of the step.

    v <- omega v + (attraction (Nbest - x) + repulsion_step sum_j (a_R / r_ij)^d (x_i - x_j) / r_ij) / dt
    """
    push = params.repulsion_step * power(memory.repulsion, params.repulsion_exponent)
    step_x = push * heard.sum_x
    step_y = push * heard.sum_y
    if heard.found and not me.on_target:
        step_x += memory.attraction * (heard.x - me.x)
        step_y += memory.attraction * (heard.y - me.y)
    rate = 1.0 / me.time_step
    return params.inertia * me.vx + rate * step_x, params.inertia * me.vy + rate * step_y


strategy(contract.GUIDED, params=Guided, memory={"repulsion": "m", "attraction": "1"}, influence=influence)(decide)
GUIDED = contract.owner_of(Guided)
