"""Expanding-square search: each agent spirals outward from the middle of its own part of the area, and starts again.

IAMSAR Manual, vol. II (IMO/ICAO), chapter 5: expanding square (SS): legs of d, d, 2d, 2d, 3d, 3d ... with a right turn
after each, d the track spacing, until the square is as large as the agent's part, which is as large as its share of the
summed top speeds; one round at least. By the book: an agent that sees a target carries on.
"""

import math
from typing import Annotated, NamedTuple

from shoal.compiler.kernel import kernel
from shoal.core.units import Doc, Range
from shoal.strategies.contract import strategy
from shoal.strategies.parts import inside, middle_of_part, size_of_part, toward, waypoint_reached


class ExpandingSquare(NamedTuple):
    """Parameters."""

    spacing: Annotated[float, Range(open=True), Doc("track spacing d, in diameters of what the sensor sees")] = 1.0


def begin(me, memory, params, draw):
    """The datum: the middle of the agent's part."""
    memory.datum_x, memory.datum_y = middle_of_part(me)
    memory.leg = 0.0


def decide(me, heard, memory, params, draw):
    """Square spirals, each around a datum of its own."""
    spacing = max(2.0 * me.briefing.reach * params.spacing, 1e-2 * me.briefing.half_x)
    x, y = corner(memory.leg)
    goal_x, goal_y = inside(me, memory.datum_x + spacing * x, memory.datum_y + spacing * y)
    if waypoint_reached(me, goal_x, goal_y):
        memory.leg = (memory.leg + 1.0) % (4.0 * rounds(math.sqrt(size_of_part(me)), spacing) + 2.0)
        x, y = corner(memory.leg)
        goal_x, goal_y = inside(me, memory.datum_x + spacing * x, memory.datum_y + spacing * y)
    return toward(me, goal_x, goal_y)


@kernel
def rounds(side, spacing):
    """Rounds whose tracks, each seen half a spacing wide to both sides, cover a square of this side; one at least."""
    return max(1.0, math.ceil(0.5 * (side / spacing - 1.0)))


@kernel
def corner(leg):
    """Corner number `leg` of the square spiral, in track spacings from the datum: legs of 1, 1, 2, 2, 3, 3 ...

    Round m ends with corner 4 m + 1, when all four sides of the square of side 2 m have been gone along.
    """
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
