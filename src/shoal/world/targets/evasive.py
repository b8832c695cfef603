"""A target that flees: from every buoy that it sees, and from walls; with nothing to flee from it wanders.

The escape rule of chases, along the sum of (x - x_p) / |x - x_p|^2 over the pursuers p within sight: Janosov, Viragh,
Vasarhelyi, Vicsek, "Group chasing tactics: how to catch a faster prey", New Journal of Physics 19, 2017. Walls push by
the same law from the nearest point of each within the wall sight. The turn in a step is limited as the waypoint
target's is.
"""

import math

from shoal.compiler.kernel import kernel
from shoal.core.draws import normal
from shoal.world.targets.moves import advance_straight, heading_of, turn


@kernel
def escape(target, swarm, agents):
    """Sum of (x - x_p) / |x - x_p|^2 over the agents alive within sight and the walls within theirs [1/m]."""
    away_x = 0.0
    away_y = 0.0
    for i in range(agents):
        dx = target.x - swarm.x[i]
        dy = target.y - swarm.y[i]
        square = dx * dx + dy * dy
        if swarm.alive[i] > 0.0 and 0.0 < square <= target.sight * target.sight:
            away_x += dx / square
            away_y += dy / square
    away_x += _from_walls(target.x, target.half_x, target.wall_sight)
    away_y += _from_walls(target.y, target.half_y, target.wall_sight)
    return away_x, away_y


@kernel
def flee(target, swarm, agents, time_step, draw):
    """Turn toward the way out, at most so far per step, and go on."""
    away_x, away_y = escape(target, swarm, agents)
    heading = heading_of(target)
    if away_x != 0.0 or away_y != 0.0:
        angle = math.atan2(away_y, away_x) - heading
        angle = math.atan2(math.sin(angle), math.cos(angle))
        most = math.atan2(target.turn_sin, target.turn_cos)
        turn(target, heading + min(max(angle, -most), most))
    else:
        turn(target, heading + math.sqrt(2.0 * target.diffusion * time_step) * normal(draw, 3))
    advance_straight(target, target.speed * time_step)


@kernel
def _from_walls(place, half, sight):
    """Push of the two walls of one axis [1/m]."""
    low = max(place + half, 1e-3 * sight)
    high = max(half - place, 1e-3 * sight)
    push = 1.0 / low if low < sight else 0.0
    return push - 1.0 / high if high < sight else push
