"""Hear all neighbors, but keep apart from the six nearest only; go to where the target was heard of for 50 steps."""

import math
from typing import NamedTuple

import shoal


class SixNearest(NamedTuple):
    nearest: int = 6
    spacing: shoal.Meters = 1.5  # at this distance a neighbor pushes by 1 m in a step
    remember: int = 50  # steps
    social: float = 0.5


def begin(me, memory, params, draw):
    memory.heard = -1e9


def influence(me, other, params):
    if other.rank >= params.nearest:
        return 0.0, 0.0
    dx, dy = me.x - other.x, me.y - other.y
    distance = math.sqrt(dx * dx + dy * dy) + 1e-9
    push = (params.spacing / max(distance, 0.1)) ** 6 / distance
    return push * dx, push * dy


@shoal.strategy(
    "six-nearest",
    params=SixNearest,
    memory={"x": "m", "y": "m", "heard": "s"},
    begin=begin,
    influence=influence,
    sums=("push_x", "push_y"),
)
def six_nearest(me, heard, memory, params, draw):
    """Run to the last place told, for as long as it is remembered."""
    if me.on_target:
        memory.x, memory.y, memory.heard = me.x, me.y, me.time
    elif heard.found:
        memory.x, memory.y, memory.heard = heard.x, heard.y, me.time
    step_x, step_y = heard.sums.push_x, heard.sums.push_y
    if not me.on_target and me.time - memory.heard < params.remember * me.time_step:
        share = params.social * shoal.uniform(draw, 0)
        step_x += share * (memory.x - me.x)
        step_y += share * (memory.y - me.y)
    return me.vx + step_x / me.time_step, me.vy + step_y / me.time_step
