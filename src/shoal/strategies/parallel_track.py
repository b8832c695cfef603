"""Parallel-track search: each agent sweeps a part of its own in parallel tracks, again and again.

IAMSAR Manual, vol. II (IMO/ICAO), chapter 5: parallel sweep (PS). The area is cut into rows, and a snake through them
into parts as large as the agents' shares of the summed top speeds, so that all finish together. Tracks run across the
snake, one track spacing apart at most, half of it from the ends of the part in each row; they end a sensor's reach
before the edges of the row. By the book: an agent that sees a target carries on.
"""

from typing import Annotated, NamedTuple

from shoal.compiler.kernel import kernel
from shoal.core.units import Doc, Range
from shoal.strategies.contract import strategy
from shoal.strategies.parts import on_snake, rows_of, toward, waypoint_reached


class ParallelTrack(NamedTuple):
    """Parameters."""

    spacing: Annotated[float, Range(open=True), Doc("largest track spacing, in diameters of what the sensor sees")] = (
        1.0
    )


def begin(me, memory, params, draw):
    """Start at the first corner."""
    memory.leg = 0.0


def decide(me, heard, memory, params, draw):
    """Parallel tracks; the area is divided by speed."""
    spacing = max(2.0 * me.briefing.reach * params.spacing, 1e-3 * me.briefing.half_x)
    x, y = corner(me, memory.leg, spacing)
    if waypoint_reached(me, x, y):
        memory.leg = (memory.leg + 1.0) % (4.0 * tracks_before(me, _ALL, spacing))
        x, y = corner(me, memory.leg, spacing)
    return toward(me, x, y)


@kernel
def corner(me, leg, spacing):
    """Waypoint number `leg`: up one track and down the next to the end of the part, and back on the same tracks [m]."""
    count = 2 * tracks_before(me, _ALL, spacing)
    at = int(leg)
    if at >= count:
        at = 2 * count - 1 - at
    track = at // 2
    rows = rows_of(me.briefing.agents, me.briefing.half_x, me.briefing.half_y)
    row = int(me.briefing.share_begin * rows)
    while row < rows - 1 and tracks_before(me, row + 1, spacing) <= track:
        row += 1
    begin, end = piece(me, row, rows)
    before = tracks_before(me, row, spacing)
    x, y = on_snake(me, begin + (end - begin) * (track - before + 0.5) / max(tracks_in(me, row, rows, spacing), 1))
    half_row = me.briefing.half_y / rows
    out = half_row - min(me.briefing.reach, half_row)
    north = (at % 2 == 1) == (track % 2 == 0)
    return x, y + out if north else y - out


@kernel
def tracks_before(me, row, spacing):
    """Number of tracks of the agent's part in the rows before `row`; of all its tracks for a row beyond the last."""
    rows = rows_of(me.briefing.agents, me.briefing.half_x, me.briefing.half_y)
    count = 0
    for number in range(int(me.briefing.share_begin * rows), min(row, rows)):
        count += tracks_in(me, number, rows, spacing)
    return count if row < rows else max(count, 1)


@kernel
def tracks_in(me, row, rows, spacing):
    """Number of tracks of the agent's part in a row: as many as are needed."""
    begin, end = piece(me, row, rows)
    return int(2.0 * me.briefing.half_x * rows * (end - begin) / spacing + 0.999999)


@kernel
def piece(me, row, rows):
    """Where on the snake the agent's part in a row begins and ends, as shares of the snake; the same if it has none."""
    begin = max(me.briefing.share_begin, row / rows)
    return begin, max(begin, min(me.briefing.share_end, (row + 1) / rows))


_ALL = 1 << 30  # more rows than there are

strategy(
    "parallel-track",
    params=ParallelTrack,
    memory={"leg": "1"},
    begin=begin,
    reference="IAMSAR Manual vol. II, parallel sweep",
)(decide)
