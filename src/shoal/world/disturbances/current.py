"""A uniform current: agents and targets drift with it; their velocities stay those through the water."""

from dataclasses import dataclass
from typing import Annotated

from shoal.compiler.kernel import kernel
from shoal.core.draws import normal, split
from shoal.core.units import Doc, MetersPerSecond, Range, Seconds
from shoal.world.disturbances.contract import Disturbance


@dataclass(frozen=True, kw_only=True)
class Current:
    """A uniform current carries agents and targets, perhaps in gusts."""

    east: Annotated[MetersPerSecond, Doc("how fast it flows to the east [m/s]")] = 0.0
    north: Annotated[MetersPerSecond, Doc("and to the north [m/s]")] = 0.0
    gust: Annotated[MetersPerSecond, Range(), Doc("standard deviation of both in gusts [m/s]")] = 0.0
    gust_time: Annotated[Seconds, Range(open=True), Doc("how long a gust lasts, until the next [s]")] = 10.0


@kernel
def flow(options, around):
    """Velocity of the water, the same everywhere [m/s]."""
    if options.gust == 0.0:
        return options.east, options.north
    draw = split(around.chance, int(around.time / options.gust_time))
    return options.east + options.gust * normal(draw, 0), options.north + options.gust * normal(draw, 1)


@kernel
def advance(me, memory, options, around, draw):
    """Drift."""
    east, north = flow(options, around)
    me.drift_x += east * around.time_step
    me.drift_y += north * around.time_step


@kernel
def carry(target, options, around, draw):
    """Targets drift, too."""
    east, north = flow(options, around)
    target.drift_x += east * around.time_step
    target.drift_y += north * around.time_step


DISTURBANCE = Disturbance(name="current", options=Current, advance=advance, carry=carry)
