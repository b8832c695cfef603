"""The paper's target: constant speed toward uniform random waypoints, turning at most so far per step."""

import math
from dataclasses import dataclass
from typing import Annotated

from shoal.compiler.kernel import kernel
from shoal.core.draws import split
from shoal.core.units import Degrees, Doc, Meters, Range
from shoal.world.sea.land import anywhere_afloat
from shoal.world.targets.contract import Target
from shoal.world.targets.moves import go


@dataclass(frozen=True, kw_only=True)
class Waypoint:
    """The paper's target: constant speed toward uniform random waypoints, turning at most so far per step."""

    max_turn: Annotated[Degrees, Range(0.0, 180.0, open=True), Doc("largest turn in a step [deg]")] = 20.0
    waypoint_reach: Annotated[Meters, Range(open=True), Doc("a new waypoint is taken when closer than this [m]")]
    waypoint_patience: Annotated[int, Range(open=True), Doc("or after this many steps on the same one")] = 200


@kernel
def begin_waypoint(target, around, draw):
    """Take a waypoint and head for it."""
    take_waypoint(target, around, split(draw, 2))
    dx = target.waypoint_x - target.x
    dy = target.waypoint_y - target.y
    distance = math.sqrt(dx * dx + dy * dy)
    target.heading_x = dx / distance if distance > 0.0 else 1.0
    target.heading_y = dy / distance if distance > 0.0 else 0.0


@kernel
def seek_waypoint(target, around, draw):
    """Turn toward the waypoint, at most so far per step, and go on; take a new one when near or tired of it."""
    dx = target.waypoint_x - target.x
    dy = target.waypoint_y - target.y
    distance = math.sqrt(dx * dx + dy * dy)
    if distance > 0.0:
        dx /= distance
        dy /= distance
        along = target.heading_x * dx + target.heading_y * dy
        across = target.heading_x * dy - target.heading_y * dx
        if along >= target.turn_cos:
            target.heading_x = dx
            target.heading_y = dy
        else:
            turn_sin = target.turn_sin if across >= 0.0 else -target.turn_sin
            heading_x = target.turn_cos * target.heading_x - turn_sin * target.heading_y
            target.heading_y = turn_sin * target.heading_x + target.turn_cos * target.heading_y
            target.heading_x = heading_x
    distance = target.speed * around.time_step
    go(target, distance * target.heading_x, distance * target.heading_y)
    target.waypoint_age += 1
    dx = target.waypoint_x - target.x
    dy = target.waypoint_y - target.y
    near = dx * dx + dy * dy < target.waypoint_reach * target.waypoint_reach
    if near or target.waypoint_age >= target.waypoint_patience:
        take_waypoint(target, around, draw)


@kernel
def take_waypoint(target, around, draw):
    """Choose a waypoint uniform in the water of the target's box."""
    target.waypoint_x, target.waypoint_y = anywhere_afloat(around.shore, target.half_x, target.half_y, draw)
    target.waypoint_age = 0


@kernel
def to_waypoint(target):
    """To its waypoint."""
    return target.speed * target.heading_x, target.speed * target.heading_y, target.waypoint_x, target.waypoint_y


TARGET = Target(
    name="waypoint",
    options=Waypoint,
    begin=begin_waypoint,
    advance=seek_waypoint,
    heading_to=to_waypoint,
    state={"waypoint_x": float, "waypoint_y": float, "waypoint_age": int},
    make={
        "turn_cos": lambda options: math.cos(math.radians(options.max_turn)),
        "turn_sin": lambda options: math.sin(math.radians(options.max_turn)),
    },
)
