"""The sea of a run: currents, wind, land; and what water and wind do to whatever floats in it."""

import math
from typing import NamedTuple

from shoal.compiler.kernel import kernel
from shoal.world.sea.field import Field, Moment, moment, still_field, velocities, velocity
from shoal.world.sea.land import Land, no_land

LONG_STEP = 10.0  # [s]: from here on the drift is that at the middle of the step


class Sea(NamedTuple):
    """Currents [m/s], wind [m/s], land, which hides, and `shore`: land, and where agents and targets may not go."""

    currents: Field
    wind: Field
    land: Land
    shore: Land


class Leeway(NamedTuple):
    """How the wind moves something: slope x wind speed + offset [m/s], at an angle to it (cosine and sine)."""

    slope: float
    offset: float
    cosine: float
    sine: float


def calm_sea() -> Sea:
    """No current, no wind, no land."""
    return Sea(still_field(), still_field(), no_land(), no_land())


class Instant(NamedTuple):
    """A time, in the currents and in the wind."""

    currents: Moment
    wind: Moment


@kernel
def instant(sea, time):
    """Find a time [s since the start] in both."""
    return Instant(moment(sea.currents, time), moment(sea.wind, time))


@kernel
def carried(sea, x, y, own_x, own_y, now, later, time_step, leeway):
    """How far water and wind carry something in a step, along x and y [m].

    x, y : where it is [m]; own_x, own_y : its own velocity [m/s]; now, later : the start, and half a step later. Where
    the step is long, by the velocity where it is half a step later (the midpoint rule); else by that at the start.
    """
    drift_x, drift_y = drift_velocity(sea, x, y, now, leeway)
    if time_step > LONG_STEP:
        half = 0.5 * time_step
        drift_x, drift_y = drift_velocity(
            sea, x + half * (own_x + drift_x), y + half * (own_y + drift_y), later, leeway
        )
    return drift_x * time_step, drift_y * time_step


@kernel
def drift_velocity(sea, x, y, now, leeway):
    """Velocity of what drifts at a place and an Instant: the current's, and the leeway that the wind makes [m/s]."""
    drift_x, drift_y = velocity(sea.currents, x, y, now.currents)
    more_x, more_y = leeway_velocity(sea, x, y, now, leeway)
    return drift_x + more_x, drift_y + more_y


@kernel
def leeway_velocity(sea, x, y, now, leeway):
    """What the wind adds, downwind and to a side of it [m/s]."""
    if leeway.slope == 0.0 and leeway.offset == 0.0:
        return 0.0, 0.0
    wind_x, wind_y = velocity(sea.wind, x, y, now.wind)
    speed = math.sqrt(wind_x * wind_x + wind_y * wind_y)
    share = leeway.slope + (leeway.offset / speed if speed > 0.0 else 0.0)
    return share * (leeway.cosine * wind_x - leeway.sine * wind_y), share * (
        leeway.sine * wind_x + leeway.cosine * wind_y
    )


@kernel
def carry(sea, swarm, scratch, windy, time, time_step, first, last):
    """Set the drift of agents first..last to what water and wind add to their velocities [m/s]; see `carried`."""
    x, y = scratch.a[first:last], scratch.b[first:last]
    drift_x, drift_y = swarm.drift_x[first:last], swarm.drift_y[first:last]
    own_x, own_y = swarm.command_x[first:last], swarm.command_y[first:last]
    for i in range(x.size):
        x[i], y[i] = swarm.x[first + i], swarm.y[first + i]
    _drift_of_all(sea, x, y, time, windy, swarm.leeway[first:last], scratch, drift_x, drift_y)
    if time_step > LONG_STEP:
        half = 0.5 * time_step
        for i in range(x.size):
            x[i] += half * (own_x[i] + drift_x[i])
            y[i] += half * (own_y[i] + drift_y[i])
        _drift_of_all(sea, x, y, time + half, windy, swarm.leeway[first:last], scratch, drift_x, drift_y)


@kernel
def _drift_of_all(sea, x, y, time, windy, leeway, scratch, drift_x, drift_y):
    """Drift velocities (B,) at places (B,) and a time, as `drift_velocity`."""
    now = instant(sea, time)
    velocities(sea.currents, x, y, now.currents, scratch.c, scratch.d, drift_x, drift_y)
    if windy:
        for i in range(x.size):
            wind = Leeway(leeway[i, 0], leeway[i, 1], leeway[i, 2], leeway[i, 3])
            more_x, more_y = leeway_velocity(sea, x[i], y[i], now, wind)
            drift_x[i] += more_x
            drift_y[i] += more_y
