"""Plain global-best PSO: everybody hears everybody, nobody keeps apart.

Kennedy and Eberhart, "Particle swarm optimization", ICNN 1995, with the inertia of Shi and Eberhart, "A modified
particle swarm optimizer", ICEC 1998; without memory, since the optimum moves.
"""

from typing import Annotated, NamedTuple

from shoal.core.draws import uniform
from shoal.core.units import Doc, Range
from shoal.strategies.contract import strategy


class GlobalPso(NamedTuple):
    """Parameters."""

    inertia: Annotated[float, Range(), Doc("omega: share of the velocity kept from one step to the next")] = 1.0
    social: Annotated[float, Range(), Doc("c: largest share of the distance to the best wanted in one step")] = 0.5


def decide(me, heard, memory, params, draw):
    """Plain global-best PSO: all-to-all, no repulsion.

    v <- omega v + c r (Gbest - x) / dt
    """
    vx = params.inertia * me.vx
    vy = params.inertia * me.vy
    if heard.found and not me.on_target:
        rate = params.social * uniform(draw, 0) / me.time_step
        vx += rate * (heard.x - me.x)
        vy += rate * (heard.y - me.y)
    return vx, vy


strategy("global-pso", params=GlobalPso, hears_all=True, reference="Kennedy, Eberhart, ICNN 1995")(decide)
