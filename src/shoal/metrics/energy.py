"""Energy: what agents took from their batteries, what is left, and when the first battery was empty."""

from typing import Any

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.core.agents import Floats
from shoal.metrics.contract import Facts, Measurement, Metric, Sum

_HOUR = 3600.0  # [J] of a Wh


@kernel
def tally_energy(tally, step, world, swarm, targets, scratch):
    """Keep what was taken from every battery so far [J], and after how many steps the first was empty."""
    if world.powered:
        for i in range(world.agents):
            tally.spent[0, i] = swarm.spent[i]
            if swarm.spent[i] >= swarm.capacity[i] and tally.emptied[0] == 0.0:
                tally.emptied[0] = step.number + 1.0


def capacities(facts: Facts) -> Floats:
    """Capacity of each agent's battery [J], (N,); NaN where it has none."""
    each = np.array(facts.capacities or np.zeros(len(facts.fleets)), float)
    full: Floats = np.repeat(np.where(each > 0, each, np.nan), facts.counts)
    return full


def fleet_energy(tally: Any, facts: Facts) -> tuple[Floats, Floats]:
    """Mean energy that agents of each fleet took [Wh], and mean share that is left, (F,); NaN: no battery."""
    begins = np.concatenate([[0], np.cumsum(facts.counts)[:-1]])
    full = capacities(facts)
    spent = np.add.reduceat(np.where(np.isnan(full), np.nan, tally.spent[0]), begins) / facts.counts
    left = 1 - np.add.reduceat(tally.spent[0] / full, begins) / facts.counts
    return spent / _HOUR, left


def of_batteries(values: Floats, choose: Any = np.mean) -> float:
    """The mean, or another choice, of the agents that have a battery; NaN if none has."""
    known = values[~np.isnan(values)]
    return float(choose(known)) if known.size else float("nan")


def first_empty(tally: Any, facts: Facts) -> float:
    """How long all batteries lasted [s], at most the run; NaN without batteries."""
    if not any(facts.capacities):
        return float("nan")
    steps = tally.emptied[0] if tally.emptied[0] > 0 else tally.steps.sum()
    return float(steps * facts.time_step)


MEASUREMENT = Measurement(
    "energy",
    sums=(
        Sum("spent", "J", "taken from each agent's battery", ("run", "agent")),
        Sum("emptied", "steps", "done when the first battery was empty, 0: none was", ("run",)),
    ),
    after_move=tally_energy,
    metrics=(
        Metric(
            "energy",
            "Wh",
            "taken from a battery in the run, mean over agents",
            lambda t, f: of_batteries(t.spent[0] + 0 * capacities(f)) / _HOUR,
            better="lower",
            once=True,
            asked=True,
        ),
        Metric(
            "charge",
            "1",
            "share of a battery that is left at the end, mean over agents",
            lambda t, f: of_batteries(1 - t.spent[0] / capacities(f)),
            label="charge left",
            better="higher",
            once=True,
            high=1.0,
            asked=True,
        ),
        Metric(
            "least_charge",
            "1",
            "share that is left in the emptiest battery at the end",
            lambda t, f: of_batteries(1 - t.spent[0] / capacities(f), np.min),
            label="least charge left",
            better="higher",
            once=True,
            high=1.0,
            asked=True,
        ),
        Metric(
            "first_empty",
            "s",
            "time until the first battery is empty; all of it if none is",
            first_empty,
            better="higher",
            once=True,
            high="duration",
            asked=True,
        ),
    ),
    order=10,
)
