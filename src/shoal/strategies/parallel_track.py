"""Parallel-track search: each agent sweeps a part of its own in parallel tracks, again and again.

IAMSAR Manual, vol. II (IMO/ICAO), chapter 5: parallel sweep (PS). The area is cut into rows, and a snake through them
into parts as large as the agents' shares of the summed top speeds, so that all finish together. Tracks run across the
snake, one track spacing apart at most, half of it from the ends of the part; they end a sensor's reach before the edges
of the row. By the book: who sees a target carries on.
"""

from typing import Annotated, NamedTuple

from shoal.core.kernel import kernel
from shoal.core.units import Says
from shoal.strategies.contract import strategy
from shoal.strategies.parts import on_snake, rows_of, toward, way_point_reached


class ParallelTrack(NamedTuple):
    """Parameters."""

    spacing: Annotated[float, Says("largest track spacing, in diameters of what the sensor sees")] = 1.0


def begin(me, memory, params, draw):
    """Start at the first corner."""
    memory.leg = 0.0


def decide(me, heard, memory, params, draw):
    """Parallel tracks; the area is divided by speed."""
    tracks = tracks_of(me, params.spacing)
    x, y = corner(me, memory.leg, tracks)
    if way_point_reached(me, x, y):
        memory.leg = (memory.leg + 1.0) % (4.0 * tracks)
        x, y = corner(me, memory.leg, tracks)
    return toward(me, x, y)


@kernel
def tracks_of(me, spacing):
    """Number of tracks in the agent's part: as many as are needed, one at least."""
    rows = rows_of(me.briefing.agents, me.briefing.half_x, me.briefing.half_y)
    length = 2.0 * me.briefing.half_x * rows * (me.briefing.share_end - me.briefing.share_begin)
    tracks = int(length / max(2.0 * me.briefing.reach * spacing, 1e-3 * me.briefing.half_x) + 0.999999)
    return max(tracks, 1)


@kernel
def corner(me, leg, tracks):
    """Way point number `leg`: up one track and down the next to the end of the part, and back on the same way [m]."""
    count = 2 * tracks
    at = int(leg)
    if at >= count:
        at = 2 * count - 1 - at
    track = at // 2
    part = me.briefing.share_end - me.briefing.share_begin
    x, y = on_snake(me, me.briefing.share_begin + part * (track + 0.5) / tracks)
    half_row = me.briefing.half_y / rows_of(me.briefing.agents, me.briefing.half_x, me.briefing.half_y)
    out = half_row - min(me.briefing.reach, half_row)
    north = (at % 2 == 1) == (track % 2 == 0)
    return x, y + out if north else y - out


strategy(
    "parallel-track",
    params=ParallelTrack,
    memory={"leg": "1"},
    begin=begin,
    reference="IAMSAR Manual vol. II, parallel sweep",
)(decide)
