"""Stations, an estimate of the target, and a ring around it: beyond the paper, with the paper's information.

Ours. Every agent knows before it leaves how many there are and how large the area is; at sea it has a binary sensor and
hears of its k nearest neighbors where they are and whether they are on target, as in the paper; nothing else is sent.

1. Without contact, agents wait on the stations of an even cover.
2. Each keeps an estimate of the target (position, velocity, speed), moves it on from step to step and corrects it by
   what one bit says. Whoever is on target, the agent or its leader, has the target within reach: an estimate beyond is
   drawn to the rim. For the others it is outside: an estimate within is pushed to the rim. An agent just come on
   target has it on its rim. Every correction turns the estimated velocity and, slowly, changes the estimated speed.
3. While the contact is fresh, agents leave their stations for a ring around the estimate, each on the side of its own
   station and at a distance from the others: together they see the target wherever around the estimate it is, and what
   they see and do not see keeps the estimate narrow. An agent goes if its station is within chase x its top speed / the
   target's speed: fast agents follow a target that is little faster than they are, slow ones fill gaps near them.

How each part pays, and when it fails: docs/explanation/beyond-the-paper.md.
"""

import math
from typing import Annotated, NamedTuple

from shoal.core.units import Doc, Follows, Meters, Range, Seconds
from shoal.strategies.contract import strategy
from shoal.strategies.estimate import distance_to, hear, move_on, so_near
from shoal.strategies.parts import own_station, toward


class Encircle(NamedTuple):
    """Parameters."""

    spread: Annotated[float, Range(0.0, 1.0), Doc("stations cover this share of the sides that agents may go to")] = (
        0.82
    )
    chase: Annotated[
        Meters,
        Follows("spacing"),
        Range(),
        Doc("how far from its station an agent as fast as the target goes to meet it"),
    ] = 9.0
    ring: Annotated[Meters, Follows("reach"), Range(), Doc("distance of the ring from the estimate")] = 0.95
    spacing: Annotated[
        Meters, Follows("reach"), Range(), Doc("agents on the ring push each other when nearer than this")
    ] = 2.0
    push: Annotated[float, Range(), Doc("how strongly, as a share of the distance to the neighbor")] = 0.3
    lead: Annotated[
        float, Range(), Doc("share of the time to get there by which the ring is ahead of the estimate")
    ] = 0.1
    patience: Annotated[
        Seconds, Follows("reach"), Range(), Doc("after so long without contact agents go home and forget the estimate")
    ] = 1.0
    learn: Annotated[
        float, Range(0.0, 1.0), Doc("share of a correction along the path that goes into the estimated speed")
    ] = 0.05


def begin(me, memory, params, draw):
    """Know the station; know nothing of a target, and take it for as fast as oneself."""
    memory.station_x, memory.station_y = own_station(me, params.spread)
    memory.contact = _NEVER
    memory.speed = me.max_speed


def influence(me, other, params):
    """Push away from neighbors within the spacing, as steeply as (spacing / r)^2 - 1."""
    dx = me.x - other.x
    dy = me.y - other.y
    square = params.spacing * params.spacing
    push = max(0.0, square / (dx * dx + dy * dy + (_SOFTENING * square + _NOTHING)) - 1.0)
    return push * dx, push * dy


def decide(me, heard, memory, params, draw):
    """Stations, an estimate of the target and a ring around it (ours; the paper's information)."""
    known = me.time - memory.contact <= params.patience
    if known:
        move_on(me, memory, 0.0)
    hear(me, heard, memory, known, params.learn)
    away_x = memory.station_x - memory.x
    away_y = memory.station_y - memory.y
    away = math.sqrt(away_x * away_x + away_y * away_y) + so_near(me)
    fresh = me.time - memory.contact < params.patience
    if not fresh or away >= params.chase * me.max_speed / memory.speed:
        return toward(me, memory.station_x, memory.station_y)
    ahead = params.lead * distance_to(memory, me.x, me.y) / me.max_speed
    out = min(away, params.ring) / away
    return toward(
        me,
        memory.x + ahead * memory.vx + out * away_x + params.push * heard.sum_x,
        memory.y + ahead * memory.vy + out * away_y + params.push * heard.sum_y,
    )


_NEVER = -1e9  # [s]
_SOFTENING = 2.5e-7  # of spacing^2
_NOTHING = 1e-60  # [m^2]: where the spacing is zero

strategy(
    "encircle",
    params=Encircle,
    memory={
        **dict.fromkeys(("station_x", "station_y", "x", "y"), "m"),
        **dict.fromkeys(("vx", "vy", "speed"), "m/s"),
        "contact": "s",
        "was_on": "1",
    },
    begin=begin,
    influence=influence,
    reference="Shoal (docs/explanation/beyond-the-paper.md)",
)(decide)
