"""Straight lines with reflection: angle of incidence = angle of reflection at the edge of the box."""

from shoal.compiler.kernel import kernel
from shoal.world.targets.moves import advance_straight


@kernel
def go_straight(target, time_step):
    """Go on, reflected where the edge is."""
    advance_straight(target, target.speed * time_step)
