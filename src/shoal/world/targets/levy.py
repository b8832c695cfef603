"""Levy walk: straight legs whose lengths l follow P(l) ~ l^-exponent between two bounds; reflection at the edge.

Viswanathan et al., "Optimizing the success of random searches", Nature 401, 1999.
"""

import math

from shoal.compiler.kernel import kernel
from shoal.core.draws import uniform
from shoal.world.targets.moves import advance_straight, any_heading


@kernel
def begin_leg(target, draw):
    """Draw a heading and a length, by inversion of its distribution."""
    any_heading(target, draw)
    chance = uniform(draw, 3)
    span = math.log(target.longest / target.shortest)
    power = 1.0 - target.exponent
    # (1 + chance ((longest / shortest)^power - 1))^(1 / power), by logarithms: powers would overflow or cancel
    steps = math.log1p(chance * math.expm1(power * span)) / power if power != 0.0 else chance * span
    target.leg = target.shortest * math.exp(steps)


@kernel
def go_leg(target, time_step, draw):
    """Go on; a new leg begins at the end of the step in which the old one ends."""
    way = target.speed * time_step
    advance_straight(target, way)
    target.leg -= way
    if target.leg <= 0.0:
        begin_leg(target, draw)
