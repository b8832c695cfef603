"""How any target moves along its heading, and turns."""

import math

from shoal.compiler.kernel import kernel
from shoal.core.draws import uniform


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
def heading_of(target):
    """The angle of the heading [rad]."""
    return math.atan2(target.heading_y, target.heading_x)


@kernel
def advance_straight(target, way):
    """Move along the heading; at the edge of its box, place and heading are mirrored."""
    target.x += way * target.heading_x
    target.y += way * target.heading_y
    if abs(target.x) > target.half_x:
        target.x = math.copysign(max(2.0 * target.half_x - abs(target.x), -target.half_x), target.x)
        target.heading_x = -target.heading_x
    if abs(target.y) > target.half_y:
        target.y = math.copysign(max(2.0 * target.half_y - abs(target.y), -target.half_y), target.y)
        target.heading_y = -target.heading_y
