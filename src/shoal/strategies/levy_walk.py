"""Levy walk: straight legs whose lengths follow a power law; nobody listens to anybody.

Viswanathan et al., "Optimizing the success of random searches", Nature 401, 1999: P(l) ~ l^-mu, optimal near mu = 2.
"""

import math
from typing import Annotated, NamedTuple

from shoal.compiler.kernel import kernel
from shoal.core.draws import uniform
from shoal.core.units import Doc, Follows, Meters, Range
from shoal.strategies.contract import strategy
from shoal.strategies.parts import turned_from_walls


class LevyWalk(NamedTuple):
    """Parameters."""

    exponent: Annotated[float, Range(1.0, 5.0), Doc("mu: P(l) ~ l^-mu; 1 is nearly straight, 3 nearly Brownian")] = 2.0
    shortest: Annotated[Meters, Follows("reach"), Range(open=True), Doc("shortest leg")] = 1.0
    longest: Annotated[Meters, Follows("spacing"), Range(open=True), Doc("longest leg")] = 20.0


def begin(me, memory, params, draw):
    """The first leg."""
    memory.heading = 2.0 * math.pi * uniform(draw, 0)
    memory.leg = leg_length(uniform(draw, 1), params.exponent, params.shortest, params.longest)


def decide(me, heard, memory, params, draw):
    """Levy walk: legs of power-law length, in any direction."""
    if memory.leg <= 0.0:
        memory.heading = 2.0 * math.pi * uniform(draw, 0)
        memory.leg = leg_length(uniform(draw, 1), params.exponent, params.shortest, params.longest)
    memory.heading = turned_from_walls(me, memory.heading)
    memory.leg -= me.max_speed * me.time_step
    return me.max_speed * math.cos(memory.heading), me.max_speed * math.sin(memory.heading)


@kernel
def leg_length(chance, exponent, shortest, longest):
    """Length [m] with P(l) ~ l^-exponent between two bounds, by inversion of its distribution."""
    if exponent == 1.0:
        return shortest * (longest / shortest) ** chance
    power = 1.0 - exponent
    return shortest * (1.0 + chance * ((longest / shortest) ** power - 1.0)) ** (1.0 / power)


strategy(
    "levy-walk",
    params=LevyWalk,
    memory={"heading": "rad", "leg": "m"},
    begin=begin,
    reference="Viswanathan et al., Nature 401, 1999",
)(decide)
