"""Parallel-track search: each agent sweeps a strip of its own in parallel tracks, again and again.

IAMSAR Manual, vol. II (IMO/ICAO), chapter 5: parallel sweep (PS). The area is cut into strips from west to east, as
wide as the agents' shares of the summed top speeds, so that all finish together; tracks run north and south, one track
spacing apart, half of it from the strip's edges. By the book: who sees a target carries on.
"""

from typing import Annotated, NamedTuple

from shoal.core.kernel import kernel
from shoal.core.units import Says
from shoal.strategies.contract import strategy
from shoal.strategies.parts import toward, way_point_reached


class ParallelTrack(NamedTuple):
    """Parameters."""

    spacing: Annotated[float, Says("track spacing, in diameters of what the sensor sees")] = 1.0


def begin(me, memory, params, draw):
    """Start at the first corner."""
    memory.leg = 0.0


def decide(me, heard, memory, params, draw):
    """Parallel-track sweeps; the area is divided by speed (IAMSAR Manual, vol. II)."""
    tracks = tracks_of(me, params.spacing)
    x, y = corner(me, memory.leg, tracks)
    if way_point_reached(me, x, y):
        memory.leg = (memory.leg + 1.0) % (4.0 * tracks)
        x, y = corner(me, memory.leg, tracks)
    return toward(me, x, y)


@kernel
def tracks_of(me, spacing):
    """Number of tracks in the agent's strip: as many as are needed, one at least."""
    width = 2.0 * me.briefing.half_x * (me.briefing.share_end - me.briefing.share_begin)
    tracks = int(width / max(2.0 * me.briefing.reach * spacing, 1e-3 * me.briefing.half_x) + 0.999999)
    return max(tracks, 1)


@kernel
def corner(me, leg, tracks):
    """Way point number `leg`: up and down the tracks from west to east, and back on the same way."""
    count = 2 * tracks
    at = int(leg)
    if at >= count:
        at = 2 * count - 1 - at
    track = at // 2
    west = me.briefing.half_x * (2.0 * me.briefing.share_begin - 1.0)
    width = 2.0 * me.briefing.half_x * (me.briefing.share_end - me.briefing.share_begin)
    margin = min(me.briefing.reach, me.briefing.half_y)
    north = (at % 2 == 1) == (track % 2 == 0)
    y = me.briefing.half_y - margin
    return west + width * (track + 0.5) / tracks, y if north else -y


strategy(
    "parallel-track",
    params=ParallelTrack,
    memory={"leg": "1"},
    begin=begin,
    reference="IAMSAR Manual vol. II, parallel sweep",
)(decide)
