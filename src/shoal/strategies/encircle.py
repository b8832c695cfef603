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

from shoal.compiler.kernel import kernel
from shoal.core.units import Doc, Follows, Meters, Range, Seconds
from shoal.strategies.contract import strategy
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
    _estimate(me, heard, memory, params)
    away_x = memory.station_x - memory.x
    away_y = memory.station_y - memory.y
    away = math.sqrt(away_x * away_x + away_y * away_y) + _near(me)
    fresh = me.time - memory.contact < params.patience
    if not fresh or away >= params.chase * me.max_speed / memory.speed:
        return toward(me, memory.station_x, memory.station_y)
    ahead = params.lead * _distance(memory, me.x, me.y) / me.max_speed
    out = min(away, params.ring) / away
    return toward(
        me,
        memory.x + ahead * memory.vx + out * away_x + params.push * heard.sum_x,
        memory.y + ahead * memory.vy + out * away_y + params.push * heard.sum_y,
    )


@kernel
def _estimate(me, heard, memory, params):
    """Move the estimate on, then correct it by what the leader and the agent itself sense."""
    reach = me.briefing.reach
    known = me.time - memory.contact <= params.patience
    if known:
        _move_on(me, memory)
    if me.on_target:
        if not known:
            _start(memory, me.x, me.y)
        distance = _distance(memory, me.x, me.y)
        _correct(me, memory, me.x, me.y, reach if memory.was_on == 0.0 else min(distance, reach), params)
        memory.contact = me.time
    elif known or heard.found:
        if heard.found:
            if not known:
                _start(memory, heard.x, heard.y)
            within = min(_distance(memory, heard.x, heard.y), reach)
            _correct(me, memory, heard.x, heard.y, within, params)
            memory.contact = me.time
        _correct(me, memory, me.x, me.y, max(_distance(memory, me.x, me.y), reach), params)
    memory.was_on = 1.0 if me.on_target else 0.0


@kernel
def _move_on(me, memory):
    """Move the estimate by a step; at the edge of the area it stays."""
    memory.x += memory.vx * me.time_step
    memory.y += memory.vy * me.time_step
    if abs(memory.x) > me.briefing.half_x:
        memory.x = math.copysign(me.briefing.half_x, memory.x)
        memory.vx = 0.0
    if abs(memory.y) > me.briefing.half_y:
        memory.y = math.copysign(me.briefing.half_y, memory.y)
        memory.vy = 0.0


@kernel
def _start(memory, x, y):
    """Begin an estimate at a place, with no heading."""
    memory.x = x
    memory.y = y
    memory.vx = 0.0
    memory.vy = 0.0


@kernel
def _distance(memory, x, y):
    """From the estimate to a place [m]."""
    dx = memory.x - x
    dy = memory.y - y
    return math.sqrt(dx * dx + dy * dy)


@kernel
def _near(me):
    """So near that there is no direction [m], above zero where nothing is reached, too."""
    return 1e-9 * me.briefing.reach + 1e-30


@kernel
def _correct(me, memory, x, y, wanted, params):
    """Move the estimate along the line from (x, y) until it is `wanted` away; turn its velocity, learn its speed."""
    distance = _distance(memory, x, y)
    if distance < _near(me) or wanted == distance:
        return
    change_x = (memory.x - x) * (wanted / distance - 1.0)
    change_y = (memory.y - y) * (wanted / distance - 1.0)
    speed = math.sqrt(memory.vx * memory.vx + memory.vy * memory.vy)
    along = (change_x * memory.vx + change_y * memory.vy) / max(speed, 1e-9)
    memory.speed = max(memory.speed + params.learn * along / me.time_step, _SLOWEST)
    memory.x += change_x
    memory.y += change_y
    memory.vx += change_x / me.time_step
    memory.vy += change_y / me.time_step
    speed = math.sqrt(memory.vx * memory.vx + memory.vy * memory.vy)
    if speed > 1e-9:
        memory.vx *= memory.speed / speed
        memory.vy *= memory.speed / speed


_NEVER = -1e9  # [s]
_SOFTENING = 2.5e-7  # of spacing^2
_NOTHING = 1e-60  # [m^2]: where the spacing is zero
_SLOWEST = 0.01  # [m/s]

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
