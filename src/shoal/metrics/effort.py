"""Effort: the distance travelled, and a proxy of the energy it takes."""

import math
from typing import Any

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.core.agents import Floats
from shoal.metrics.contract import Facts, Measurement, Metric, Sum
from shoal.metrics.shares import or_nan, share


@kernel
def tally_effort(tally, step, world, swarm, targets, scratch):
    """Add the distance that every agent travels in this step [m], and the cube of its speed times the step [m^3/s^2].

    Drag grows like the square of the speed, so the power to overcome it grows like the cube: the proxy compares fleets
    and strategies, it is not joules.
    """
    add_effort(tally, step, world, swarm, 0, world.agents)


@kernel
def add_effort(tally, step, world, swarm, first, last):
    """The same of agents first..last."""
    for i in range(first, last):
        square = swarm.vx[i] * swarm.vx[i] + swarm.vy[i] * swarm.vy[i]
        speed = swarm.alive[i] * math.sqrt(square)
        tally.distance[step.batch, i] += speed * world.time_step
        tally.cubes[step.batch, i] += speed * square * world.time_step


def fleet_power(tally: Any, facts: Facts) -> tuple[Floats, Floats]:
    """Mean speed [m/s] and mean cube of the speed [m^3/s^3] of each fleet's agents, (F,)."""
    steps = or_nan(tally.agent_steps.sum(axis=0)) * facts.time_step
    begins = np.concatenate([[0], np.cumsum(facts.counts)[:-1]])
    distance: Floats = np.add.reduceat(tally.distance.sum(axis=0), begins) / steps
    cubes: Floats = np.add.reduceat(tally.cubes.sum(axis=0), begins) / steps
    return distance, cubes


MEASUREMENT = Measurement(
    "effort",
    sums=(
        Sum("distance", "m", "travelled by each agent", ("batch", "agent")),
        Sum("cubes", "m^3/s^2", "cube of each agent's speed times the step", ("batch", "agent")),
    ),
    after_move=tally_effort,
    metrics=(
        Metric(
            "speed",
            "m/s",
            "mean speed of the agents",
            lambda t, f: share(t.distance, t.agent_steps) / f.time_step,
        ),
        Metric(
            "power",
            "m^3/s^3",
            "mean cube of the agents' speed, a proxy of propulsion power",
            lambda t, f: share(t.cubes, t.agent_steps) / f.time_step,
            better="lower",
        ),
    ),
    order=9,
)
