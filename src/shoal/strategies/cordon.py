"""A cordon around an estimate of the target, and a cover that reaches to where the target roams: ours.

As `encircle`, of which it is the heir: agents wait on the stations of an even cover; each keeps an estimate of the
target, which single bits correct (estimate.py); those near enough surround it, each on the side of its own station and
pushed apart by its neighbors. What is new, so that one set of numbers serves slow, fast, fleeing and straying targets:

1. Roaming: the share of recent contacts at the edge of where agents may go. Against a target that keeps off the edge
   the cover is drawn in and agents run home to it; against one that strays there, it reaches out, and agents stay where
   they lost the target, spread by their neighbors like a gas.
2. Haste: a target found to be fast is met by more agents, which keep farther apart. Where agents are many to the area,
   they keep less apart, so that the push of all does not drive them off the ring.
3. Who waits is pushed by neighbors anyway, so that the holes of lost agents close; on a chart, whose stations lie where
   water is, it is not. Where the reach is more than agents need to cover the area, they stay where they are, too.
4. An agent whose body does not obey at once holds to its station, and slows down in time for what acceleration it saw
   itself reach.

How each part pays, and when it fails: docs/explanation/beyond-the-paper.md.
"""

import math
from typing import Annotated, NamedTuple

from shoal.compiler.kernel import kernel
from shoal.core.units import Doc, Follows, Meters, Range, Seconds
from shoal.strategies.contract import strategy
from shoal.strategies.estimate import distance_to, hear, move_on, so_near
from shoal.strategies.parts import own_station


class Cordon(NamedTuple):
    """Parameters; those in _far hold where the target roams, with all between."""

    ring: Annotated[Meters, Follows("reach"), Range(), Doc("distance of the ring from the estimate")] = 0.75
    gap: Annotated[
        Meters, Follows("reach"), Range(), Doc("agents on the ring push each other when nearer than this")
    ] = 2.66
    room: Annotated[
        Meters, Follows("spacing"), Range(), Doc("where less than the gap, the gap is the geometric mean of both")
    ] = 2.7
    push: Annotated[float, Range(), Doc("how strongly, as a share of the distance to the neighbor")] = 0.22
    lead: Annotated[
        float, Range(), Doc("share of the time to get there by which the ring is ahead of the estimate")
    ] = 0.16
    chase: Annotated[
        Meters,
        Follows("spacing"),
        Range(),
        Doc("how far from its station an agent as fast as the target goes to meet it"),
    ] = 11.9
    haste: Annotated[
        Seconds, Follows("reach"), Range(), Doc("a target that goes the reach in less than this is met by more agents")
    ] = 0.395
    patience: Annotated[
        Seconds, Follows("reach"), Range(), Doc("after so long without contact agents forget the estimate")
    ] = 1.0
    learn: Annotated[
        float, Range(0.0, 1.0), Doc("share of a correction along the path that goes into the estimated speed")
    ] = 0.07
    beyond: Annotated[
        Meters, Follows("reach"), Range(), Doc("how far beyond where agents may go the estimate goes")
    ] = 0.2
    edge: Annotated[
        Meters, Follows("reach"), Range(), Doc("a contact nearer to where agents may not go than this is at the edge")
    ] = 0.82
    roaming: Annotated[
        float,
        Range(0.0, 1.0, open=True),
        Doc("from this share of contacts at the edge on a target roams, all the more up to twice of it"),
    ] = 0.024
    survey: Annotated[Seconds, Follows("reach"), Range(open=True), Doc("over how long that share is measured")] = 28.0
    inset: Annotated[
        Meters, Follows("spacing"), Range(), Doc("how far inside where agents may go the cover of stations ends")
    ] = 2.4
    inset_far: Annotated[Meters, Follows("spacing"), Range(), Doc("the same where the target roams")] = 0.1
    home: Annotated[float, Range(), Doc("share of its top speed with which an agent goes home from one span away")] = (
        3.6
    )
    home_far: Annotated[float, Range(), Doc("the same where the target roams")] = 2.0
    full: Annotated[
        Meters, Follows("spacing"), Range(), Doc("with a reach of more, agents cover the area wherever they wait")
    ] = 1.25
    span: Annotated[
        Meters, Follows("spacing"), Range(open=True), Doc("agents that wait push each other when nearer than this")
    ] = 3.7
    spread: Annotated[float, Range(), Doc("how strongly, as a share of the top speed")] = 1.6
    spread_far: Annotated[float, Range(), Doc("the same where the target roams")] = 4.5
    nimble: Annotated[
        Seconds, Follows("reach"), Range(), Doc("so does one that takes longer than this to its top speed")
    ] = 0.48


def begin(me, memory, params, draw):
    """Know the station; know nothing of a target, and take it for as fast as oneself."""
    memory.station_x, memory.station_y = own_station(me, 1.0)
    memory.contact = _NEVER
    memory.speed = me.max_speed
    memory.was_vx = _UNKNOWN


def influence(me, other, params):
    """Push away from a neighbor within the gap, which is less in a crowd, and from one within the span.

    As steeply as (gap / r)^2 - 1.
    """
    dx = me.x - other.x
    dy = me.y - other.y
    square = dx * dx + dy * dy
    near = params.gap * min(params.gap, params.room)
    far = params.span * params.span
    ring = max(0.0, near / (square + (_SOFTENING * near + _NOTHING)) - 1.0)
    cover = max(0.0, far / (square + (_SOFTENING * far + _NOTHING)) - 1.0)
    return ring * dx, ring * dy, cover * dx, cover * dy


def decide(me, heard, memory, params, draw):
    """A cordon around an estimate of the target, and a cover that reaches to where it roams (ours)."""
    _feel(me, memory)
    _believe(me, heard, memory, params)
    quick = min(memory.agility * params.nimble / me.max_speed, 1.0) if memory.agility > 0.0 else 1.0
    far = quick * _roams(me, memory, params)
    home_x, home_y = _home(me, memory, _between(params.inset, params.inset_far, far))
    away_x = home_x - memory.x
    away_y = home_y - memory.y
    away = math.sqrt(away_x * away_x + away_y * away_y) + so_near(me)
    fresh = me.time - memory.contact < params.patience
    swift = min(max(memory.speed * params.haste / max(me.briefing.reach, so_near(me)), 1.0), _SWIFTEST)
    chase = swift * swift * params.chase * quick * me.max_speed / memory.speed
    if not fresh or away >= chase:
        share = me.max_speed * me.time_step / params.span
        pull = share * _between(params.home, params.home_far, far) / max(quick, 0.01)
        push = 0.0 if me.briefing.charted else share * _between(params.spread, params.spread_far, far) * quick
        return _braked(
            me,
            memory,
            pull * (home_x - me.x) + push * heard.sums.cover_x,
            pull * (home_y - me.y) + push * heard.sums.cover_y,
        )
    ahead = params.lead * distance_to(memory, me.x, me.y) / me.max_speed
    out = min(away, params.ring) / away
    push = swift * params.push
    return _braked(
        me,
        memory,
        memory.x + ahead * memory.vx + out * away_x + push * heard.sums.ring_x - me.x,
        memory.y + ahead * memory.vy + out * away_y + push * heard.sums.ring_y - me.y,
    )


@kernel
def _feel(me, memory):
    """Remember the largest change of velocity in a step, as an acceleration; walls and land do not count."""
    if abs(me.x) >= me.briefing.half_x or abs(me.y) >= me.briefing.half_y or me.aground:
        memory.was_vx = _UNKNOWN
        return
    if memory.was_vx > _UNKNOWN:
        dx = me.vx - memory.was_vx
        dy = me.vy - memory.was_vy
        memory.agility = max(memory.agility, math.sqrt(dx * dx + dy * dy) / me.time_step)
    memory.was_vx = me.vx
    memory.was_vy = me.vy


@kernel
def _believe(me, heard, memory, params):
    """Move the estimate on and correct it; take note of how often the target is at the edge."""
    known = me.time - memory.contact <= params.patience
    if known:
        move_on(me, memory, params.beyond)
    if me.on_target or heard.found:
        edge = max(abs(memory.x) - me.briefing.half_x, abs(memory.y) - me.briefing.half_y) > -params.edge
        memory.roam += min(me.time_step / params.survey, 1.0) * ((1.0 if edge else 0.0) - memory.roam)
    hear(me, heard, memory, known, params.learn)


@kernel
def _roams(me, memory, params):
    """How far, from 0 to 1, agents stay where they lost the target: it roams, or they are dense enough anywhere."""
    if me.briefing.reach > params.full:
        return 1.0
    return min(max(memory.roam / params.roaming - 1.0, 0.0), 1.0)


@kernel
def _home(me, memory, inset):
    """The agent's station, the cover drawn in by `inset` [m]; on a chart as it is."""
    if me.briefing.charted:
        return memory.station_x, memory.station_y
    share_x = max(1.0 - inset / me.briefing.half_x, 0.0)
    share_y = max(1.0 - inset / me.briefing.half_y, 0.0)
    return share_x * memory.station_x, share_y * memory.station_y


@kernel
def _between(near, far, share):
    """A share of the way from one value to the other."""
    return near + share * (far - near)


@kernel
def _braked(me, memory, dx, dy):
    """Velocity that makes this way [m] in this step, or that the acceleration known can still stop at its end.

    As long as none is known it is the top speed: so that the first move shows what the body can do.
    """
    way = math.sqrt(dx * dx + dy * dy)
    if way == 0.0:
        return 0.0, 0.0
    speed = min(way / me.time_step, math.sqrt(2.0 * memory.agility * way)) if memory.agility > 0.0 else me.max_speed
    return speed / way * dx, speed / way * dy


_NEVER = -1e9  # [s]
_UNKNOWN = -1e9  # [m/s]
_SWIFTEST = 1e6  # where nothing is reached
_SOFTENING = 2.5e-7  # of gap^2, span^2
_NOTHING = 1e-60  # [m^2]: where they are zero

strategy(
    "cordon",
    params=Cordon,
    memory={
        **dict.fromkeys(("station_x", "station_y", "x", "y"), "m"),
        **dict.fromkeys(("vx", "vy", "speed", "was_vx", "was_vy"), "m/s"),
        "agility": "m/s^2",
        "contact": "s",
        **dict.fromkeys(("was_on", "roam"), "1"),
    },
    sums=("ring_x", "ring_y", "cover_x", "cover_y"),
    begin=begin,
    influence=influence,
    reference="Shoal (docs/explanation/beyond-the-paper.md)",
)(decide)
