"""A target that flees: from every buoy that it sees, and from walls; with nothing to flee from it wanders.

The escape rule of chases, along the sum of (x - x_p) / |x - x_p|^2 over the pursuers p within sight: Janosov, Viragh,
Vasarhelyi, Vicsek, "Group chasing tactics: how to catch a faster prey", New Journal of Physics 19, 2017. Walls push by
the same law from the nearest point of each within the wall sight. The turn in a step is limited as the waypoint
target's is.
"""

import math
from dataclasses import dataclass
from typing import Annotated

from shoal.compiler.kernel import kernel
from shoal.core.units import Degrees, Doc, Meters, Range, Seconds
from shoal.world.targets.contract import Target
from shoal.world.targets.moves import advance_straight, heading_of, turn, wander


@dataclass(frozen=True, kw_only=True)
class Evasive:
    """Flees from the buoys that it sees and from walls; otherwise wanders."""

    sight: Annotated[Meters, Range(), Doc("it flees from buoys nearer than this [m]")]
    wall_sight: Annotated[Meters, Range(open=True), Doc("it turns from edges nearer than this [m]")]
    max_turn: Annotated[Degrees, Range(0.0, 180.0, open=True), Doc("largest turn in a step [deg]")] = 20.0
    persistence: Annotated[
        Seconds, Range(open=True), Doc("of its wandering: after this time the mean cosine of the turn is 1/e [s]")
    ] = 10.0


@kernel
def escape(target, around):
    """Sum of (x - x_p) / |x - x_p|^2 over the agents alive within sight and the walls within theirs [1/m]."""
    away_x = 0.0
    away_y = 0.0
    for i in range(around.agents):
        dx = target.x - around.x[i]
        dy = target.y - around.y[i]
        square = dx * dx + dy * dy
        if around.alive[i] > 0.0 and 0.0 < square <= target.sight * target.sight:
            away_x += dx / square
            away_y += dy / square
    away_x += _from_walls(target.x, target.half_x, target.wall_sight)
    away_y += _from_walls(target.y, target.half_y, target.wall_sight)
    return away_x, away_y


@kernel
def flee(target, around, draw):
    """Turn toward the way out, at most so far per step, and go on."""
    away_x, away_y = escape(target, around)
    heading = heading_of(target)
    if away_x != 0.0 or away_y != 0.0:
        angle = math.atan2(away_y, away_x) - heading
        angle = math.atan2(math.sin(angle), math.cos(angle))
        most = math.atan2(target.turn_sin, target.turn_cos)
        turn(target, heading + min(max(angle, -most), most))
    else:
        wander(target, around.time_step, draw)
    advance_straight(target, target.speed * around.time_step)


@kernel
def _from_walls(place, half, sight):
    """Push of the two walls of one axis [1/m]."""
    low = max(place + half, 1e-3 * sight)
    high = max(half - place, 1e-3 * sight)
    push = 1.0 / low if low < sight else 0.0
    return push - 1.0 / high if high < sight else push


TARGET = Target(
    name="evasive",
    options=Evasive,
    advance=flee,
    make={
        "turn_cos": lambda options: math.cos(math.radians(options.max_turn)),
        "turn_sin": lambda options: math.sin(math.radians(options.max_turn)),
        "diffusion": lambda options: 1.0 / options.persistence,  # of the heading [1/s]
    },
)
