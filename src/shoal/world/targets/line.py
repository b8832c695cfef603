"""Straight lines with reflection: angle of incidence = angle of reflection at the edge of the box."""

from dataclasses import dataclass

from shoal.compiler.kernel import kernel
from shoal.world.targets.contract import Target
from shoal.world.targets.moves import advance_straight


@dataclass(frozen=True, kw_only=True)
class Line:
    """Straight lines, reflected at the edge."""


@kernel
def go_straight(target, around, draw):
    """Go on, reflected where the edge is."""
    advance_straight(target, target.speed * around.time_step)


TARGET = Target(name="line", options=Line, advance=go_straight)
