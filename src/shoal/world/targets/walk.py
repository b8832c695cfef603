"""Persistent random walk: constant speed, a heading that diffuses, reflection at the edge.

Kareiva and Shigesada, "Analyzing insect movement as a correlated random walk", Oecologia 56, 1983: the mean cosine of
the turn made in a time t is exp(-diffusion t).
"""

from dataclasses import dataclass
from typing import Annotated

from shoal.compiler.kernel import kernel
from shoal.core.units import Doc, Range, Seconds
from shoal.world.targets.contract import Target
from shoal.world.targets.moves import advance_straight, wander


@dataclass(frozen=True, kw_only=True)
class Walk:
    """A persistent random walk, reflected at the edge."""

    persistence: Annotated[Seconds, Range(open=True), Doc("after this time the mean cosine of the turn is 1/e [s]")] = (
        10.0
    )


@kernel
def walk(target, around, draw):
    """Turn a little by chance, and go on."""
    wander(target, around.time_step, draw)
    advance_straight(target, target.speed * around.time_step)


TARGET = Target(
    name="walk",
    options=Walk,
    advance=walk,
    make={"diffusion": lambda options: 1.0 / options.persistence},  # of the heading [1/s]
)
