"""A target that drifts: with a uniform current, and a random walk on top of it.

What leaves its box comes back in at the opposite side, as the next one would.
"""

from dataclasses import dataclass
from typing import Annotated

from shoal.compiler.kernel import kernel
from shoal.core.units import Doc, MetersPerSecond, Range, Seconds
from shoal.world.targets.contract import Target
from shoal.world.targets.moves import go, wander


@dataclass(frozen=True, kw_only=True)
class Drift:
    """Drifts with a uniform current, its own speed on top in a direction that wanders; re-enters at the other side."""

    speed: Annotated[MetersPerSecond, Range(), Doc("own speed [m/s]")] = 0.0
    current_x: Annotated[MetersPerSecond, Doc("eastward current [m/s]")] = 0.0
    current_y: Annotated[MetersPerSecond, Doc("northward current [m/s]")] = 0.0
    persistence: Annotated[
        Seconds, Range(open=True), Doc("of its own motion: after this time the mean cosine of the turn is 1/e [s]")
    ] = 10.0


@kernel
def drift(target, around, draw):
    """The current, and the own speed along a heading that diffuses."""
    time_step = around.time_step
    wander(target, time_step, draw)
    go(
        target,
        (target.current_x + target.speed * target.heading_x) * time_step,
        (target.current_y + target.speed * target.heading_y) * time_step,
    )
    target.x = _wrapped(target.x, target.half_x)
    target.y = _wrapped(target.y, target.half_y)


@kernel
def drift_to(target):
    """With the current, to nowhere."""
    vx = target.speed * target.heading_x + target.current_x
    return vx, target.speed * target.heading_y + target.current_y, target.x, target.y


@kernel
def _wrapped(place, half):
    return (place + half) % (2.0 * half) - half


TARGET = Target(
    name="drift",
    options=Drift,
    advance=drift,
    heading_to=drift_to,
    make={"diffusion": lambda options: 1.0 / options.persistence},  # of the heading [1/s]
)
