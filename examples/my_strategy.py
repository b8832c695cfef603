"""Wander; keep apart; run to whoever is on target."""

import math
from typing import NamedTuple

import shoal


class Wander(NamedTuple):
    turn_chance: float = 0.02  # per step
    spacing: shoal.Meters = 2.0


def keep_apart(me, other, params):
    dx, dy = me.x - other.x, me.y - other.y
    distance = math.sqrt(dx * dx + dy * dy) + 1e-9
    push = max(0.0, params.spacing / distance - 1.0)
    return push * dx, push * dy


@shoal.strategy("wander", params=Wander, memory={"heading": "rad"}, influence=keep_apart)
def wander(me, heard, memory, params, draw):
    """Walk straight, turn now and then, chase the nearest neighbor on target."""
    if heard.found:
        return (heard.x - me.x) / me.time_step, (heard.y - me.y) / me.time_step  # there in one step
    if shoal.uniform(draw, 0) < params.turn_chance:
        memory.heading = 2 * math.pi * shoal.uniform(draw, 1)
    vx = me.max_speed * math.cos(memory.heading) + heard.sum_x
    return vx, me.max_speed * math.sin(memory.heading) + heard.sum_y
