"""Informed reference: a lattice whose agents meet the known target on its known way.

Breaks the information rule: every agent is told where the target is, how it moves and to which waypoint. An agent goes
to the point of that way nearest in time that it can reach before the target has passed (constant-bearing interception,
Isaacs, "Differential Games", Wiley 1965), if that point is near its station; else home.
"""

import math
from typing import Annotated, NamedTuple

from shoal.core.units import Meters, Says
from shoal.strategies.contract import strategy
from shoal.strategies.parts import station, toward

_POINTS = 16  # of the target's way that are tried


class LatticeIntercept(NamedTuple):
    """Parameters."""

    spread: Annotated[float, Says("the lattice covers this share of the sides that agents may go to")] = 0.82
    reach: Annotated[Meters, Says("a meeting point nearer to the station than this is gone to")] = 3.0


def begin(me, memory, params, draw):
    """The station, known before leaving."""
    half_x = params.spread * me.briefing.half_x
    half_y = params.spread * me.briefing.half_y
    memory.station_x, memory.station_y = station(me.id, me.briefing.agents, half_x, half_y)


def decide(me, heard, memory, params, draw):
    """KNOWS THE TARGET AND ITS WAY: a lattice that intercepts it (a reference, not a strategy for buoys)."""
    truth = me.truth
    speed = math.sqrt(truth.vx * truth.vx + truth.vy * truth.vy)
    way_x = truth.goal_x - truth.x
    way_y = truth.goal_y - truth.y
    way = math.sqrt(way_x * way_x + way_y * way_y)
    for number in range(_POINTS):
        share = number / (_POINTS - 1.0)
        x = truth.x + share * way_x
        y = truth.y + share * way_y
        dx = x - memory.station_x
        dy = y - memory.station_y
        mine = math.sqrt((x - me.x) * (x - me.x) + (y - me.y) * (y - me.y))
        in_time = mine * speed <= (share * way + me.briefing.reach) * me.max_speed
        if truth.present and in_time and dx * dx + dy * dy < params.reach * params.reach:
            return toward(me, x, y)
    return toward(me, memory.station_x, memory.station_y)


strategy(
    "lattice-intercept",
    params=LatticeIntercept,
    memory={"station_x": "m", "station_y": "m"},
    begin=begin,
    informed=True,
    reference="Isaacs, Differential Games, 1965 (interception)",
)(decide)
