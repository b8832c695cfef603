"""Persistent random walk: constant speed, a heading that diffuses, reflection at the edge.

Kareiva and Shigesada, "Analyzing insect movement as a correlated random walk", Oecologia 56, 1983: the mean cosine of
the turn made in a time t is exp(-diffusion t).
"""

import math

from shoal.compiler.kernel import kernel
from shoal.core.draws import normal
from shoal.world.targets.moves import advance_straight, heading_of, turn


@kernel
def walk(target, time_step, draw):
    """Turn a little by chance, and go on."""
    turn(target, heading_of(target) + math.sqrt(2.0 * target.diffusion * time_step) * normal(draw, 3))
    advance_straight(target, target.speed * time_step)
