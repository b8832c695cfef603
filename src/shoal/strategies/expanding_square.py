"""Expanding-square search: each agent spirals outward from the middle of its own part of the area, and starts again.

IAMSAR Manual, vol. II (IMO/ICAO), chapter 5: expanding square (SS): legs of d, d, 2d, 2d, 3d, 3d ... with a right turn
after each, d the track spacing. The parts are strips as in parallel-track, cut in pieces that are nearly square where a
strip is narrow: the datum of an agent is its station. By the book: who sees a target carries on.
"""

from typing import Annotated, NamedTuple

from shoal.core.kernel import kernel
from shoal.core.units import Says
from shoal.strategies.contract import strategy
from shoal.strategies.parts import inside, station, toward, way_point_reached


class ExpandingSquare(NamedTuple):
    """Parameters."""

    spacing: Annotated[float, Says("track spacing d, in diameters of what the sensor sees")] = 1.0


def begin(me, memory, params, draw):
    """The datum: the middle of the agent's part."""
    memory.datum_x, memory.datum_y = station(me.id, me.briefing.agents, me.briefing.half_x, me.briefing.half_y)
    memory.leg = 0.0


def decide(me, heard, memory, params, draw):
    """Expanding squares around a datum of its own (IAMSAR Manual, vol. II)."""
    step = 2.0 * me.briefing.reach * params.spacing
    x, y = corner(memory.leg)
    side = 2.0 * (me.briefing.half_x * me.briefing.half_y * part(me)) ** 0.5
    goal_x, goal_y = inside(me, memory.datum_x + step * x, memory.datum_y + step * y)
    if way_point_reached(me, goal_x, goal_y):
        far = max(abs(x), abs(y)) * step > 0.5 * side
        memory.leg = 0.0 if far else memory.leg + 1.0
        x, y = corner(memory.leg)
        goal_x, goal_y = inside(me, memory.datum_x + step * x, memory.datum_y + step * y)
    return toward(me, goal_x, goal_y)


@kernel
def part(me):
    """Share of the area that is the agent's, by speed."""
    return me.briefing.share_end - me.briefing.share_begin


@kernel
def corner(leg):
    """Corner number `leg` of the square spiral, in track spacings from the datum: legs of 1, 1, 2, 2, 3, 3 ..."""
    x = 0.0
    y = 0.0
    for number in range(int(leg)):
        length = number // 2 + 1.0
        side = number % 4
        if side == 0:
            y += length
        elif side == 1:
            x += length
        elif side == 2:
            y -= length
        else:
            x -= length
    return x, y


strategy(
    "expanding-square",
    params=ExpandingSquare,
    memory={"datum_x": "m", "datum_y": "m", "leg": "1"},
    begin=begin,
    reference="IAMSAR Manual vol. II, expanding square",
)(decide)
