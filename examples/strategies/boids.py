"""Boids: keep apart, fly along, stay together; and run to whoever is on target.

Reynolds, "Flocks, herds, and schools: a distributed behavioral model", SIGGRAPH 1987.
"""

import math
from typing import NamedTuple

import shoal


class Boids(NamedTuple):
    spacing: shoal.Meters = 1.5  # nearer neighbors push
    separation: float = 1.0
    alignment: float = 0.3
    cohesion: float = 0.05  # per second
    chase: float = 1.0  # per second


def influence(me, other, params):
    """What one neighbor adds to each sum: a push, its velocity, and the displacement to it."""
    dx, dy = me.x - other.x, me.y - other.y
    distance = math.sqrt(dx * dx + dy * dy) + 1e-9
    push = max(0.0, params.spacing / distance - 1.0) / distance
    return push * dx, push * dy, other.vx - me.vx, other.vy - me.vy, -dx, -dy


@shoal.strategy(
    "boids",
    params=Boids,
    influence=influence,
    sums=("push_x", "push_y", "align_x", "align_y", "join_x", "join_y"),
    reference="Reynolds, SIGGRAPH 1987",
)
def boids(me, heard, memory, params, draw):
    """Separation, alignment and cohesion, at once."""
    sums, each = heard.sums, 1.0 / max(heard.neighbors, 1)
    vx = (
        me.vx
        + params.separation * sums.push_x
        + each * (params.alignment * sums.align_x + params.cohesion * sums.join_x)
    )
    vy = (
        me.vy
        + params.separation * sums.push_y
        + each * (params.alignment * sums.align_y + params.cohesion * sums.join_y)
    )
    if heard.found and not me.on_target:
        vx += params.chase * (heard.x - me.x)
        vy += params.chase * (heard.y - me.y)
    return vx, vy
