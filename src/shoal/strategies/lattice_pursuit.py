"""Informed reference: a lattice whose agents run to the known target when it is near their station, and home again.

Breaks the information rule: every agent is told where the target is.
"""

from typing import Annotated, NamedTuple

from shoal.core.units import Doc, Follows, Meters, Range
from shoal.strategies.contract import strategy
from shoal.strategies.parts import own_station, toward


class LatticePursuit(NamedTuple):
    """Parameters."""

    spread: Annotated[
        float, Range(0.0, 1.0), Doc("the lattice covers this share of the sides that agents may go to")
    ] = 0.82
    reach: Annotated[
        Meters, Follows("spacing"), Range(), Doc("a target nearer to the station than this is pursued")
    ] = 2.0


def begin(me, memory, params, draw):
    """The station, known before leaving."""
    memory.station_x, memory.station_y = own_station(me, params.spread)


def decide(me, heard, memory, params, draw):
    """KNOWS THE TARGET: a lattice that pursues it nearby."""
    dx = me.truth.x - memory.station_x
    dy = me.truth.y - memory.station_y
    if me.truth.present and dx * dx + dy * dy < params.reach * params.reach:
        return toward(me, me.truth.x, me.truth.y)
    return toward(me, memory.station_x, memory.station_y)


strategy(
    "lattice-pursuit",
    params=LatticePursuit,
    memory={"station_x": "m", "station_y": "m"},
    begin=begin,
    informed=True,
    reference="Shoal (reference)",
)(decide)
