"""The sea of a run: currents, wind, land; and what water and wind do to whatever floats in it."""

import math
from typing import NamedTuple

from shoal.compiler.kernel import kernel
from shoal.world.sea.field import Field, Moment, moment, still_field, velocities, velocity
from shoal.world.sea.land import Land, no_land

LONG_STEP = 10.0  # [s]: above, the drift at the start of a step says where its middle is, below that of the last


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


class Span(NamedTuple):
    """A time-step: its start, half a step later, and how long it is [s]."""

    now: Instant
    later: Instant
    time_step: float


@kernel
def instant(sea, time):
    """Find a time [s since the start] in both."""
    return Instant(moment(sea.currents, time), moment(sea.wind, time))


@kernel
def span(sea, number, time_step):
    """Step `number` of a run."""
    return Span(instant(sea, number * time_step), instant(sea, (number + 0.5) * time_step), time_step)


@kernel
def carried(sea, x, y, own_x, own_y, span, leeway):
    """How far water and wind carry something in a step, a Span, along x and y [m], by the midpoint rule.

    x, y : where it is [m]; own_x, own_y : its own velocity [m/s]. What counts is the velocity half a step later, where
    it is then.
    """
    drift_x, drift_y = drift_velocity(sea, x, y, span.now, leeway)
    half = 0.5 * span.time_step
    x += half * (own_x + drift_x)
    y += half * (own_y + drift_y)
    drift_x, drift_y = drift_velocity(sea, x, y, span.later, leeway)
    return drift_x * span.time_step, drift_y * span.time_step


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
def carry(sea, swarm, scratch, windy, span, first, last):
    """Set the drift of agents first..last to what water and wind add to their velocities [m/s], by the midpoint rule.

    Where they are half a step later follows from the drift of the last step, which is as good, of second order, and
    free; where steps are long, from that at the start of this one.
    """
    x, y = scratch.a, scratch.b
    if span.time_step > LONG_STEP:
        for i in range(first, last):
            x[i], y[i] = swarm.x[i], swarm.y[i]
        _drift_of_all(sea, swarm, scratch, windy, span.now, first, last)
    half = 0.5 * span.time_step
    for i in range(first, last):
        x[i] = swarm.x[i] + half * (swarm.command_x[i] + swarm.drift_x[i])
        y[i] = swarm.y[i] + half * (swarm.command_y[i] + swarm.drift_y[i])
    _drift_of_all(sea, swarm, scratch, windy, span.later, first, last)


@kernel
def _drift_of_all(sea, swarm, scratch, windy, now, first, last):
    """Drift velocities at the places in scratch.a and b, and an Instant, as `drift_velocity`."""
    x, y = scratch.a[first:last], scratch.b[first:last]
    drift_x, drift_y = swarm.drift_x[first:last], swarm.drift_y[first:last]
    velocities(sea.currents, x, y, now.currents, scratch.c, scratch.d, drift_x, drift_y)
    if windy:
        for i in range(first, last):
            wind = Leeway(swarm.leeway[i, 0], swarm.leeway[i, 1], swarm.leeway[i, 2], swarm.leeway[i, 3])
            more_x, more_y = leeway_velocity(sea, scratch.a[i], scratch.b[i], now, wind)
            swarm.drift_x[i] += more_x
            swarm.drift_y[i] += more_y
