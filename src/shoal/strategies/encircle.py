"""Stations, a shared estimate of the target, and a ring around it: beyond the paper, with the paper's information.

Ours. Every agent knows before it leaves how many there are and how large the area is; at sea it has a binary sensor and
the reports of its neighbors, which carry six numbers more than the paper's: what the agent takes the target to do.

1. Without contact, agents wait on the stations of an even cover.
2. The estimate (position, velocity, speed, time of the last contact) passes from agent to agent: each takes over the
   latest among those of its leader and its own, moves it on, and corrects it by what one bit says: on target, the
   target is within reach, so an estimate beyond is drawn to the rim; off target, it is not, so an estimate within is
   pushed to the rim; and an agent that has just come on target has it on its rim. Every correction turns the estimated
   velocity and, slowly, changes the estimated speed.
3. While the contact is fresh, agents leave their stations for a ring around the estimate, each on the side of its own
   station and at a distance from the others: together they see the target wherever around the estimate it is, and what
   they see and do not see keeps the estimate narrow. An agent goes if its station is within chase x its top speed / the
   target's speed: fast agents follow a target that is little faster than they are, slow ones fill gaps near them.

It follows one target: several, false alarms and delays mislead it (docs/reference/strategies.md).
"""

import math
from typing import Annotated, NamedTuple

from shoal.core.kernel import kernel
from shoal.core.units import Meters, MetersPerSecond, Says, Seconds
from shoal.strategies.contract import strategy
from shoal.strategies.parts import station


class Encircle(NamedTuple):
    """Parameters; lengths suit targets of 1 m seen in an arena of 20 m."""

    spread: Annotated[float, Says("stations cover this share of the sides that agents may go to")] = 0.82
    chase: Annotated[Meters, Says("how far from its station an agent as fast as the target goes to meet it")] = 9.0
    ring: Annotated[Meters, Says("distance of the ring from the estimate")] = 0.95
    spacing: Annotated[Meters, Says("agents on the ring push each other when nearer than this")] = 2.0
    push: Annotated[float, Says("how strongly, in ways to the neighbor")] = 0.3
    lead: Annotated[float, Says("share of the time to get there by which the ring is ahead of the estimate")] = 0.1
    patience: Annotated[Seconds, Says("after so long without contact agents go back to their stations")] = 1.0
    forget: Annotated[Seconds, Says("after so long the next contact starts a new estimate")] = 3.0
    rim: Annotated[float, Says("where a target is taken to come on, in reaches of the sensor")] = 0.8
    turn: Annotated[float, Says("share of a correction that goes into the estimated velocity")] = 1.0
    learn: Annotated[float, Says("share of a correction along the way that goes into the estimated speed")] = 0.05
    first_speed: Annotated[MetersPerSecond, Says("the target's speed before anything is known of it")] = 4.0


def begin(me, memory, params, draw):
    """Know the station; know nothing of a target."""
    half_x = params.spread * me.briefing.half_x
    half_y = params.spread * me.briefing.half_y
    memory.station_x, memory.station_y = station(me.id, me.briefing.agents, half_x, half_y)
    memory.contact = _NEVER
    memory.speed = params.first_speed


def leads(other, params):
    """Whoever is on target, and whoever ever heard of one."""
    return other.on_target or other.told.contact >= 0.0


def priority(me, other, params):
    """The latest contact first, of equal ones the nearest."""
    dx = me.x - other.x
    dy = me.y - other.y
    return dx * dx + dy * dy - _SECOND * (other.told.contact + (2.0 * me.time_step if other.on_target else 0.0))


def influence(me, other, params):
    """Push away from neighbors within the spacing, as steeply as (spacing / r)^2 - 1."""
    dx = me.x - other.x
    dy = me.y - other.y
    push = max(0.0, params.spacing * params.spacing / (dx * dx + dy * dy + _SOFTENING) - 1.0)
    return push * dx, push * dy


def decide(me, heard, memory, params, draw):
    """Stations, a shared estimate of the target and a ring around it (ours; the paper's information)."""
    _estimate(me, heard, memory, params)
    goal_x = memory.station_x
    goal_y = memory.station_y
    if me.time - memory.contact < params.patience:
        away_x = memory.station_x - memory.x
        away_y = memory.station_y - memory.y
        away = math.sqrt(away_x * away_x + away_y * away_y) + 1e-9
        if away < params.chase * me.max_speed / memory.speed:
            ahead = params.lead * _distance(memory, me.x, me.y) / me.max_speed
            out = min(away, params.ring) / away
            goal_x = memory.x + ahead * memory.vx + out * away_x + params.push * heard.sum_x
            goal_y = memory.y + ahead * memory.vy + out * away_y + params.push * heard.sum_y
    rate = 1.0 / me.time_step
    return rate * (goal_x - me.x), rate * (goal_y - me.y)


@kernel
def _estimate(me, heard, memory, params):
    """Take over the latest estimate, move it on, correct it by what the leader and the agent itself sense."""
    reach = me.briefing.reach
    if heard.found and heard.told.contact > memory.contact:
        memory.x = heard.told.x
        memory.y = heard.told.y
        memory.vx = heard.told.vx
        memory.vy = heard.told.vy
        memory.speed = heard.told.speed
        memory.contact = heard.told.contact
    _move_on(me, memory)
    known = me.time - memory.contact <= params.forget
    if me.on_target:
        if not known:
            _start(memory, me.x, me.y)
        distance = _distance(memory, me.x, me.y)
        wanted = params.rim * reach if memory.was_on == 0.0 else min(distance, reach)
        _correct(memory, me.x, me.y, distance, wanted, me.time_step, params)
        memory.contact = me.time
    else:
        if heard.found and heard.on_target:
            if not known:
                _start(memory, heard.x, heard.y)
            distance = _distance(memory, heard.x, heard.y)
            _correct(memory, heard.x, heard.y, distance, min(distance, reach), me.time_step, params)
            memory.contact = me.time
            known = True
        if known:
            distance = _distance(memory, me.x, me.y)
            _correct(memory, me.x, me.y, distance, max(distance, reach), me.time_step, params)
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
def _correct(memory, x, y, distance, wanted, time_step, params):
    """Move the estimate along the line from (x, y) until it is `wanted` away; turn its velocity, learn its speed."""
    if distance < 1e-9 or wanted == distance:
        return
    change_x = (memory.x - x) * (wanted / distance - 1.0)
    change_y = (memory.y - y) * (wanted / distance - 1.0)
    speed = math.sqrt(memory.vx * memory.vx + memory.vy * memory.vy)
    along = (change_x * memory.vx + change_y * memory.vy) / max(speed, 1e-9)
    memory.speed = max(memory.speed + params.learn * along / time_step, _SLOWEST * params.first_speed)
    memory.x += change_x
    memory.y += change_y
    memory.vx += params.turn * change_x / time_step
    memory.vy += params.turn * change_y / time_step
    speed = math.sqrt(memory.vx * memory.vx + memory.vy * memory.vy)
    if speed > 1e-9:
        memory.vx *= memory.speed / speed
        memory.vy *= memory.speed / speed


_NEVER = -1e9  # [s]
_SECOND = 1e12  # [m^2/s]: no distance outweighs a later contact
_SOFTENING = 1e-6  # [m^2]
_SLOWEST = 0.01

strategy(
    "encircle",
    params=Encircle,
    memory={
        **dict.fromkeys(("x", "y"), "m"),
        **dict.fromkeys(("vx", "vy", "speed"), "m/s"),
        "contact": "s",
        **dict.fromkeys(("station_x", "station_y"), "m"),
        "was_on": "1",
    },
    tells=("x", "y", "vx", "vy", "speed", "contact"),
    begin=begin,
    leads=leads,
    priority=priority,
    influence=influence,
    reference="Shoal (docs/explanation/beyond-the-paper.md)",
)(decide)
