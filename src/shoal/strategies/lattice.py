"""Static lattice: every agent goes to its place in an even cover of the area and stays there.

The yardstick of every comparison: what standing still gives (sensor coverage with a fixed grid, as in Cortes,
Martinez, Karatas, Bullo, "Coverage control for mobile sensing networks", IEEE Trans. Robotics and Automation 20, 2004).
"""

from typing import Annotated, NamedTuple

from shoal.core.units import Doc, Range
from shoal.strategies.contract import strategy
from shoal.strategies.parts import own_station, toward


class Lattice(NamedTuple):
    """Parameters."""

    spread: Annotated[
        float, Range(0.0, 1.0), Doc("the lattice covers this share of the sides that agents may go to")
    ] = 0.82


def begin(me, memory, params, draw):
    """The place, known before leaving."""
    memory.station_x, memory.station_y = own_station(me, params.spread)


def decide(me, heard, memory, params, draw):
    """Motionless: everybody goes to a place of an even cover."""
    return toward(me, memory.station_x, memory.station_y)


strategy(
    "lattice",
    params=Lattice,
    memory={"station_x": "m", "station_y": "m"},
    begin=begin,
    reference="Cortes et al., IEEE TRA 20, 2004 (coverage)",
)(decide)
