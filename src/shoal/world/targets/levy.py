"""Levy walk: straight legs whose lengths l follow P(l) ~ l^-exponent between two bounds; reflection at the edge.

Viswanathan et al., "Optimizing the success of random searches", Nature 401, 1999.
"""

from shoal.core.draws import uniform
from shoal.core.kernel import kernel
from shoal.world.targets.moves import advance_straight, any_heading


@kernel
def begin_leg(target, draw):
    """Draw a heading and a length, by inversion of its distribution."""
    any_heading(target, draw)
    chance = uniform(draw, 3)
    if target.exponent == 1.0:
        target.leg = target.shortest * (target.longest / target.shortest) ** chance
    else:
        power = 1.0 - target.exponent
        low = target.shortest**power
        target.leg = (low + chance * (target.longest**power - low)) ** (1.0 / power)


@kernel
def go_leg(target, time_step, draw):
    """Go on; a new leg begins where the old one ends."""
    way = target.speed * time_step
    advance_straight(target, way)
    target.leg -= way
    if target.leg <= 0.0:
        begin_leg(target, draw)
