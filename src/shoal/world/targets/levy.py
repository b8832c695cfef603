"""Levy walk: straight legs whose lengths l follow P(l) ~ l^-exponent between two bounds; reflection at the edge.

Viswanathan et al., "Optimizing the success of random searches", Nature 401, 1999.
"""

import math
from dataclasses import dataclass
from typing import Annotated

from shoal.compiler.kernel import kernel
from shoal.core.draws import uniform
from shoal.core.units import Doc, Meters, Range
from shoal.world.targets.contract import Target
from shoal.world.targets.moves import advance_straight, any_heading


@dataclass(frozen=True, kw_only=True)
class Levy:
    """A Levy walk: legs of power-law length in random directions, reflected at the edge."""

    exponent: Annotated[float, Range(1.0, 5.0), Doc("mu: P(l) ~ l^-mu")] = 2.0
    shortest: Annotated[Meters, Range(open=True), Doc("shortest leg [m]")]
    longest: Annotated[Meters, Range(open=True), Doc("longest leg [m]")]


def in_order(options: Levy) -> None:
    """Refuse a shortest leg that is longer than the longest."""
    if options.shortest > options.longest:
        raise ValueError(f"shortest is {options.shortest:g} m, more than longest, {options.longest:g} m; swap them")


@kernel
def begin(target, around, draw):
    """Draw the first leg."""
    begin_leg(target, draw)


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
def go_leg(target, around, draw):
    """Go on; a new leg begins at the end of the step in which the old one ends."""
    distance = target.speed * around.time_step
    advance_straight(target, distance)
    target.leg -= distance
    if target.leg <= 0.0:
        begin_leg(target, draw)


TARGET = Target(
    name="levy",
    options=Levy,
    begin=begin,
    advance=go_leg,
    check=in_order,
    state={"leg": float},  # what is left of it [m]
)
