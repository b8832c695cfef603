"""A target without a will: a person or a boat that water and wind carry, from somewhere around a last known place."""

import math
from dataclasses import dataclass
from typing import Annotated

from shoal.compiler.kernel import kernel
from shoal.core.draws import uniform
from shoal.core.units import Doc, Meters, Range
from shoal.world.sea.land import clearance
from shoal.world.targets.contract import Target
from shoal.world.targets.moves import go

_TRIES = 64


@dataclass(frozen=True, kw_only=True)
class Adrift:
    """Only water and wind move it, from a place that is known so well; it may leave the arena."""

    x: Annotated[Meters, Doc("last known place, eastward [m]")] = 0.0
    y: Annotated[Meters, Doc("last known place, northward [m]")] = 0.0
    spread: Annotated[Meters, Range(), Doc("it starts anywhere within this of it [m]")] = 0.0


@kernel
def begin(target, around, draw):
    """Start anywhere in the disc where there is water."""
    middle_x, middle_y = target.x, target.y
    for attempt in range(_TRIES):
        distance = target.spread * math.sqrt(uniform(draw, 2 * attempt))
        angle = 2.0 * math.pi * uniform(draw, 2 * attempt + 1)
        target.x, target.y = middle_x + distance * math.cos(angle), middle_y + distance * math.sin(angle)
        if clearance(around.shore, target.x, target.y) > 0.0:
            break


@kernel
def advance(target, around, draw):
    """Be carried."""
    go(target, 0.0, 0.0)


@kernel
def carried_to(target):
    """To nowhere that it knows."""
    return 0.0, 0.0, target.x, target.y


TARGET = Target(
    name="adrift",
    options=Adrift,
    begin=begin,
    advance=advance,
    heading_to=carried_to,
    moves=False,
)
