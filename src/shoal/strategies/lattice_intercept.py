"""Informed reference: a lattice whose agents meet the known target on its known path.

Breaks the information rule: every agent is told where the target is, how fast, and to which waypoint it moves. An agent
goes to the first point of that path where it can be within its sensor's reach in time (constant-bearing interception:
Isaacs, "Differential Games", Wiley 1965), if that point is near its station; else home.
"""

import math
from typing import Annotated, NamedTuple

from shoal.compiler.kernel import kernel
from shoal.core.units import Doc, Follows, Meters, Range
from shoal.strategies.contract import strategy
from shoal.strategies.parts import own_station, toward


class LatticeIntercept(NamedTuple):
    """Parameters."""

    spread: Annotated[
        float, Range(0.0, 1.0), Doc("the lattice covers this share of the sides that agents may go to")
    ] = 0.82
    reach: Annotated[
        Meters, Follows("spacing"), Range(), Doc("a meeting point nearer to the station than this is gone to")
    ] = 2.4


def begin(me, memory, params, draw):
    """The station, known before leaving."""
    memory.station_x, memory.station_y = own_station(me, params.spread)


def decide(me, heard, memory, params, draw):
    """KNOWS THE TARGET'S PATH: a lattice that intercepts it.

    meets at target + u t, with the first t >= 0 for which |target + u t - x| <= v t + sensor reach
    """
    truth = me.truth
    speed = math.sqrt(truth.vx * truth.vx + truth.vy * truth.vy)
    leg_x = truth.goal_x - truth.x
    leg_y = truth.goal_y - truth.y
    leg = math.sqrt(leg_x * leg_x + leg_y * leg_y)
    bound = leg > 0.0  # else it has no waypoint: straight on, as far as anybody knows
    vx = speed * leg_x / leg if bound else truth.vx
    vy = speed * leg_y / leg if bound else truth.vy
    time = meeting_time(truth.x - me.x, truth.y - me.y, vx, vy, me.max_speed, me.briefing.reach)
    if truth.present and (not bound or time * speed <= leg):
        x = truth.x + time * vx
        y = truth.y + time * vy
        dx = x - memory.station_x
        dy = y - memory.station_y
        if dx * dx + dy * dy < params.reach * params.reach:
            return toward(me, x, y)
    return toward(me, memory.station_x, memory.station_y)


@kernel
def meeting_time(dx, dy, vx, vy, speed, reach):
    """First time [s] at which an agent of this speed can be within reach of a target dx, dy away with velocity vx, vy.

    The smaller positive root of (u^2 - v^2) t^2 + 2 (d.u - v reach) t + d^2 - reach^2 = 0; 1e9 if there is none.
    """
    constant = dx * dx + dy * dy - reach * reach
    if constant <= 0.0:
        return 0.0
    half = dx * vx + dy * vy - speed * reach
    discriminant = half * half - (vx * vx + vy * vy - speed * speed) * constant
    if discriminant < 0.0:
        return _NEVER
    below = math.sqrt(discriminant) - half
    return constant / below if below > 0.0 else _NEVER


_NEVER = 1e9  # [s]

strategy(
    "lattice-intercept",
    params=LatticeIntercept,
    memory={"station_x": "m", "station_y": "m"},
    begin=begin,
    informed=True,
    reference="Isaacs, Differential Games, 1965 (interception)",
)(decide)
