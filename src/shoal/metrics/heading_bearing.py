"""Heading-bearing correlation phi: whether agents move toward the target (+1), away from it (-1), or not at all (0)."""

import math
from typing import Any

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.core.agents import Floats
from shoal.metrics.contract import Facts, Measurement, Metric, Sum
from shoal.metrics.shares import or_nan, share

BINS = 11  # of phi
STATIONARY = 0.1  # share of the top speed below which an agent counts as stationary
CENTERS = np.linspace(-1.0, 1.0, BINS)


@kernel
def tally_heading_bearing(tally, step, world, swarm, targets, scratch):
    """Add phi_i = cos(angle between heading and bearing to the nearest target) to the histogram of i's fleet.

    Kwa et al., Heterogeneous Swarms, Eq. 8. Positions after the move, targets before theirs. The heading is that of the
    speed-limited velocity before the wall; stationary is judged by the displacement really made, so that an agent which
    presses against the wall is. Stationary agents count as phi = 0, as does an agent exactly on a target.
    """
    if not any_present(targets):
        return
    phi = scratch.c
    correlate(swarm, targets, scratch, 0, world.agents)
    begin = 0
    for fleet in range(swarm.fleet_end.size):
        end = swarm.fleet_end[fleet]
        stationary = 0
        for i in range(begin, end):
            stops = is_stationary(swarm.vx[i], swarm.vy[i], swarm.max_speed[i])
            stationary += stops & (swarm.alive[i] > 0.0)
        for i in range(begin, end):
            tally.histogram[step.batch, fleet, bin_of(phi[i])] += swarm.alive[i] > 0.0
        tally.stationary[step.batch, fleet] += stationary
        begin = end


@kernel
def correlate(swarm, targets, scratch, first, last):
    """Set scratch.c to phi of agents first..last."""
    bearing_x, bearing_y, phi = scratch.a, scratch.b, scratch.c
    _nearest_bearing(swarm, targets, bearing_x, bearing_y, first, last)
    for i in range(first, last):
        vx = swarm.command_x[i]
        vy = swarm.command_y[i]
        along = vx * bearing_x[i] + vy * bearing_y[i]
        length2 = (vx * vx + vy * vy) * (bearing_x[i] * bearing_x[i] + bearing_y[i] * bearing_y[i])
        moves = not is_stationary(swarm.vx[i], swarm.vy[i], swarm.max_speed[i]) and length2 > 0.0
        phi[i] = along / math.sqrt(length2) if moves else 0.0


@kernel
def any_present(targets):
    """Whether there is a target to head for."""
    present = False
    for target in targets:
        present |= target.present != 0
    return present


@kernel
def is_stationary(vx, vy, max_speed):
    """Whether an agent is slower than a tenth of its top speed.

    vx, vy : displacement really made in the step, after the wall, divided by the time-step [m/s]
    """
    limit = STATIONARY * max_speed
    return vx * vx + vy * vy < limit * limit


def which_stationary(vx: Any, vy: Any, max_speed: Any) -> Any:
    """The same of arrays that broadcast, such as the velocities (K, N) of frames and the top speeds (N,) [m/s]."""
    return getattr(is_stationary, "py_func", is_stationary)(vx, vy, max_speed)


@kernel
def bin_of(phi):
    """Index of the bin of phi: 11 bins centered at -1, -0.8, ..., 1, the outer two half as wide."""
    return min(max(int((phi + 1.0) * 5.0 + 0.5), 0), BINS - 1)


@kernel
def _nearest_bearing(swarm, targets, bearing_x, bearing_y, first, last):
    """Vector from each of agents first..last to its nearest target present."""
    for i in range(first, last):
        bearing_x[i] = np.inf
        bearing_y[i] = 0.0
    for target in targets:
        if target.present:
            for i in range(first, last):
                dx = target.x - swarm.x[i]
                dy = target.y - swarm.y[i]
                known = bearing_x[i] * bearing_x[i] + bearing_y[i] * bearing_y[i]
                nearer = dx * dx + dy * dy < known
                bearing_x[i] = dx if nearer else bearing_x[i]
                bearing_y[i] = dy if nearer else bearing_y[i]


def phi_histogram(tally: Any) -> Floats:
    """Mean agents per step in each bin of phi, by fleet: (F, 11); the bins of all fleets sum to N."""
    present = tally.present.sum()
    sums: Floats = tally.histogram.sum(axis=0)
    return sums / present if present > 0 else np.full(sums.shape, np.nan)


def fleet_stationary(tally: Any, facts: Facts) -> Floats:
    """Stationary share of each fleet, (F,)."""
    result: Floats = tally.stationary.sum(axis=0) / or_nan(tally.histogram.sum(axis=(0, 2)))
    return result


MEASUREMENT = Measurement(
    "heading_bearing",
    sums=(
        Sum(
            "histogram",
            "agents",
            "of each fleet per bin of phi, over steps with a target present",
            ("batch", "fleet", BINS),
            True,
        ),
        Sum(
            "stationary",
            "agents",
            "of each fleet slower than a tenth of their top speed, over the same steps",
            ("batch", "fleet"),
            True,
        ),
    ),
    after_move=tally_heading_bearing,
    metrics=(
        Metric(
            "stationary",
            "1",
            "share of agents slower than a tenth of their top speed while a target is present",
            lambda t, f: share(t.stationary, t.histogram),
            label="stationary agents",
            high=1.0,
        ),
    ),
    order=3,
)
