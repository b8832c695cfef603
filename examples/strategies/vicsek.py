"""Vicsek's model: everybody at one speed, in the mean direction of the neighbors within a radius, give or take chance.

Vicsek, Czirok, Ben-Jacob, Cohen, Shochet, "Novel type of phase transition in a system of self-driven particles",
Physical Review Letters 75, 1995. The arena has walls where theirs is a torus: headings are mirrored there.
"""

import math
from typing import NamedTuple

import shoal


class Vicsek(NamedTuple):
    radius: shoal.Meters = 4.0
    noise: float = 0.5  # eta [rad]: headings vary by up to half of it to both sides
    speed: float = 0.5  # in the agent's top speed


def begin(me, memory, params, draw):
    memory.heading = 2.0 * math.pi * shoal.uniform(draw, 0)


def influence(me, other, params):
    """The direction in which a neighbor within the radius heads."""
    dx, dy = me.x - other.x, me.y - other.y
    within = dx * dx + dy * dy <= params.radius * params.radius
    return (math.cos(other.told.heading), math.sin(other.told.heading)) if within else (0.0, 0.0)


@shoal.strategy(
    "vicsek",
    params=Vicsek,
    memory={"heading": "rad"},
    tells=("heading",),
    begin=begin,
    influence=influence,
    sums=("cos", "sin"),
    reference="Vicsek et al., Physical Review Letters 75, 1995",
)
def vicsek(me, heard, memory, params, draw):
    """Head where the neighbors head on average, the agent itself among them."""
    toward_x = heard.sums.cos + math.cos(memory.heading)
    toward_y = heard.sums.sin + math.sin(memory.heading)
    memory.heading = math.atan2(toward_y, toward_x) + params.noise * (shoal.uniform(draw, 0) - 0.5)
    if abs(me.x) >= me.briefing.half_x and me.x * math.cos(memory.heading) > 0.0:
        memory.heading = math.pi - memory.heading
    if abs(me.y) >= me.briefing.half_y and me.y * math.sin(memory.heading) > 0.0:
        memory.heading = -memory.heading
    speed = params.speed * me.max_speed
    return speed * math.cos(memory.heading), speed * math.sin(memory.heading)
