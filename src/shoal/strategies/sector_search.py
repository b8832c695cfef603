"""Sector search: each agent crosses its datum again and again, in triangles turned against each other.

IAMSAR Manual, vol. II (IMO/ICAO), chapter 5: sector search (VS): legs of one radius out of the datum, across and back
through it, turns of 120 degrees to the right, so that three triangles meet in the datum; the next pattern is turned by
30 degrees. The disc is as large as the agent's part of the area, which is its share of the summed top speeds; at the
edge of the area it is cut off. By the book: an agent that sees a target carries on.
"""

import math
from typing import Annotated, NamedTuple

from shoal.compiler.kernel import kernel
from shoal.core.units import Doc, Range
from shoal.strategies.contract import strategy
from shoal.strategies.parts import inside, middle_of_part, size_of_part, toward, waypoint_reached


class SectorSearch(NamedTuple):
    """Parameters."""

    size: Annotated[
        float, Range(open=True), Doc("radius, in that of a disc as large as the agent's part of the area")
    ] = 1.0


def begin(me, memory, params, draw):
    """The datum: the middle of the agent's part."""
    memory.datum_x, memory.datum_y = middle_of_part(me)
    memory.leg = 0.0


def decide(me, heard, memory, params, draw):
    """Triangles through a datum of its own."""
    radius = params.size * math.sqrt(size_of_part(me) / math.pi)
    x, y = corner(memory.leg)
    goal_x, goal_y = inside(me, memory.datum_x + radius * x, memory.datum_y + radius * y)
    if waypoint_reached(me, goal_x, goal_y):
        memory.leg = (memory.leg + 1.0) % 108.0  # 12 patterns of 9 legs: 12 x 30 degrees
        x, y = corner(memory.leg)
        goal_x, goal_y = inside(me, memory.datum_x + radius * x, memory.datum_y + radius * y)
    return toward(me, goal_x, goal_y)


@kernel
def corner(leg):
    """Way point number `leg`, in radii from the datum: out, across the sector, back to the datum; three times."""
    at = int(leg)
    turned = math.pi / 6.0 * (at // 9)
    within = at % 9
    if within % 3 == 0:
        return 0.0, 0.0
    # a triangle ends on the course that the next one begins with, 240 degrees from its first
    bearing = turned + 4.0 * math.pi / 3.0 * (within // 3) + (math.pi / 3.0 if within % 3 == 2 else 0.0)
    return math.sin(bearing), math.cos(bearing)


strategy(
    "sector-search",
    params=SectorSearch,
    memory={"datum_x": "m", "datum_y": "m", "leg": "1"},
    begin=begin,
    reference="IAMSAR Manual vol. II, sector search",
)(decide)
