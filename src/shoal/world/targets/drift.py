"""A target that drifts: with a uniform current, and a random walk on top of it.

What leaves its box comes back in at the opposite side, as the next one would.
"""

import math

from shoal.compiler.kernel import kernel
from shoal.core.draws import normal
from shoal.world.targets.moves import heading_of, turn


@kernel
def drift(target, time_step, draw):
    """The current, and the own speed along a heading that diffuses."""
    turn(target, heading_of(target) + math.sqrt(2.0 * target.diffusion * time_step) * normal(draw, 3))
    target.x = _wrapped(target.x + (target.current_x + target.speed * target.heading_x) * time_step, target.half_x)
    target.y = _wrapped(target.y + (target.current_y + target.speed * target.heading_y) * time_step, target.half_y)


@kernel
def _wrapped(place, half):
    return (place + half) % (2.0 * half) - half
