"""How any target moves and turns. Where it is changes here alone: by its own displacement and the water's."""

import math

from shoal.compiler.kernel import kernel
from shoal.core.draws import normal, uniform


@kernel
def any_heading(target, draw):
    """Head anywhere."""
    turn(target, 2.0 * math.pi * uniform(draw, 2))


@kernel
def turn(target, heading):
    """Head for an angle [rad] from east to north."""
    target.heading_x = math.cos(heading)
    target.heading_y = math.sin(heading)


@kernel
def wander(target, time_step, draw):
    """Turn by chance, N(0, 2 diffusion dt); the heading diffuses at target.diffusion [1/s]. Takes draw 3."""
    turn(target, heading_of(target) + math.sqrt(2.0 * target.diffusion * time_step) * normal(draw, 3))


@kernel
def heading_of(target):
    """The angle of the heading [rad]."""
    return math.atan2(target.heading_y, target.heading_x)


@kernel
def go(target, dx, dy):
    """Move by its own displacement [m], and by what disturbances add to it."""
    target.x += dx + target.drift_x
    target.y += dy + target.drift_y


@kernel
def advance_straight(target, distance):
    """Move so far [m] along the heading; at the edge of its box the place is mirrored, and the heading leads inside."""
    go(target, distance * target.heading_x, distance * target.heading_y)
    if abs(target.x) > target.half_x:
        target.heading_x = -math.copysign(target.heading_x, target.x)
        target.x = math.copysign(max(2.0 * target.half_x - abs(target.x), -target.half_x), target.x)
    if abs(target.y) > target.half_y:
        target.heading_y = -math.copysign(target.heading_y, target.y)
        target.y = math.copysign(max(2.0 * target.half_y - abs(target.y), -target.half_y), target.y)
