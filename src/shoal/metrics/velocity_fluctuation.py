"""Velocity fluctuation, from which Xi and the response are made."""

import math
from typing import Any

from shoal.compiler.kernel import kernel
from shoal.core.agents import Floats
from shoal.metrics.contract import Facts, Measurement, Metric, Sum
from shoal.metrics.shares import fleet_agents, mean_agents, mean_max_speed, or_nan, share


@kernel
def tally_velocity_fluctuation(tally, step, world, swarm, targets, scratch):
    """Add |u_i| = |v_i - mean v| of every agent, by fleet; v at the start of the step.

    Kwa et al., Heterogeneous Swarms, Eq. 5. Eq. 7 as printed sums vectors that cancel to zero; the norm is meant.
    Absent agents lie still and count for nothing.
    """
    mean_x, mean_y = mean_velocity(swarm, world.agents)
    deviate(scratch.a, swarm, mean_x, mean_y, 0, world.agents)
    add_deviations(tally, step, swarm, scratch.a)


@kernel
def mean_velocity(swarm, agents):
    """Mean velocity of the agents that are there [m/s]."""
    there = 0
    mean_x = 0.0
    mean_y = 0.0
    for i in range(agents):
        mean_x += swarm.vx[i]
        mean_y += swarm.vy[i]
        there += swarm.alive[i] > 0.0
    return mean_x / max(there, 1), mean_y / max(there, 1)  # all may be lost


@kernel
def deviate(size, swarm, mean_x, mean_y, first, last):
    """Set `size` to |u_i| of agents first..last, 0 of those who are not there."""
    for i in range(first, last):
        ux = swarm.vx[i] - mean_x
        uy = swarm.vy[i] - mean_y
        size[i] = swarm.alive[i] * math.sqrt(ux * ux + uy * uy)


@kernel
def add_deviations(tally, step, swarm, size):
    """Add |u_i| of every agent, in order, by fleet."""
    begin = 0
    for fleet in range(swarm.fleet_end.size):
        total = 0.0
        there = 0
        for i in range(begin, swarm.fleet_end[fleet]):
            total += size[i]
            there += swarm.alive[i] > 0.0
        tally.agent_steps[step.batch, fleet] += there
        begin = swarm.fleet_end[fleet]
        tally.fluctuation[step.batch, fleet] += total


def xi(tally: Any, facts: Facts) -> float:
    """Velocity fluctuation of the swarm. Kwa et al., Heterogeneous Swarms, Eq. 7."""
    return share(tally.fluctuation, tally.steps) / mean_agents(tally) / mean_max_speed(tally, facts)


def fleet_fluctuation(tally: Any, facts: Facts) -> Floats:
    """xi_raw of each fleet [m/s], (F,): fluctuation around the mean velocity of the whole swarm."""
    result: Floats = tally.fluctuation.sum(axis=0) / or_nan(tally.steps.sum() * fleet_agents(tally))
    return result


MEASUREMENT = Measurement(
    "velocity_fluctuation",
    sums=(
        Sum("fluctuation", "m/s", "|v_i - mean v|, summed over steps and the agents of each fleet", ("batch", "fleet")),
        Sum("agent_steps", "1", "steps, summed over the agents of each fleet that are present", ("batch", "fleet")),
    ),
    before_move=tally_velocity_fluctuation,
    metrics=(
        Metric(
            "xi",
            "1",
            "velocity fluctuation: mean of |v_i - mean v| over steps and agents / mean top speed (Eqs. 5-7)",
            xi,
            label="velocity fluctuation Ξ",
        ),
        Metric(
            "xi_raw",
            "m/s",
            "velocity fluctuation, not normalized",
            lambda t, f: share(t.fluctuation, t.steps) / mean_agents(t),
            label="Ξ, not normalized",
        ),
        Metric(
            "response",
            "unit/step",
            "mean over steps of the sum over agents of |v_i - mean v|, in arena units per step",
            lambda t, f: share(t.fluctuation, t.steps) * f.time_step / f.unit,
        ),
    ),
    order=2,
)
