"""From sums to numbers: every metric as one formula over a tally, for all steps or for one batch of them."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.agents import Floats
from shoal.core.messages import REPORT_BYTES
from shoal.metrics.tally import NONE_SEEN, Tally, batch_of


class Facts(NamedTuple):
    """What metrics need to know of a scenario.

    fleets, counts, max_speeds : name, number of agents (those who join later too) and top speed [m/s] of each fleet
    unit [m] : one arena unit; time_step [s]; area [m^2]; report_bytes : size of one report [B]
    """

    fleets: tuple[str, ...]
    counts: tuple[int, ...]
    max_speeds: tuple[float, ...]
    unit: float
    time_step: float
    area: float = float("nan")
    report_bytes: int = REPORT_BYTES

    @property
    def agents(self) -> int:
        """All agents that are ever there."""
        return sum(self.counts)


class Bounds(NamedTuple):
    """Between which values a metric lies, whatever happens."""

    low: float = -math.inf
    high: float = math.inf


ANYTHING = Bounds()

# Bounds that a scenario decides, and what they are where it is not known: number of agents, share of cells where they
# may go, length of a run [s], and how often a target is lost that is found at every other step [1/h].
LIMITS = {"agents": math.inf, "reach": 1.0, "duration": math.inf, "flicker": math.inf}


class Metric(NamedTuple):
    """A number per run: its unit, one sentence, and its formula over a tally whose batches are summed (B = 1).

    once : it happens once in a run, or the scenario decides it, so that batches of steps say nothing about its spread
    low, high : its bounds; those that a scenario decides have a name, see LIMITS
    """

    unit: str
    sentence: str
    formula: Callable[[Tally, Facts], float]
    once: bool = False
    low: float = 0.0
    high: float | str = math.inf


def _share(part: npt.NDArray[Any], whole: npt.NDArray[Any]) -> float:
    return float(part.sum() / whole.sum()) if whole.sum() > 0 else float("nan")


def _fleet_agents(tally: Tally) -> Floats:
    """Mean number of agents of each fleet that are there, (F,)."""
    steps = tally.steps.sum()
    agents: Floats = tally.agent_steps.sum(axis=0) / (steps if steps > 0 else np.nan)
    return agents


def _agents(tally: Tally) -> float:
    """N, the mean number of agents that are there; NaN if nobody ever is."""
    return float(_fleet_agents(tally).sum()) or float("nan")


def mean_max_speed(tally: Tally, facts: Facts) -> float:
    """vbar_max: mean top speed of the agents [m/s]. Kwa et al., Heterogeneous Swarms, Eq. 6."""
    agents = _fleet_agents(tally)
    return float(sum(n * v for n, v in zip(agents, facts.max_speeds, strict=True)) / or_nan(agents.sum()))


def _closest(tally: Tally) -> float:
    """The smallest distance [m], NaN if no two agents were ever there."""
    square = float(tally.closest.min(initial=NONE_SEEN))
    return math.sqrt(square) if square < NONE_SEEN else float("nan")


def _fairness(tally: Tally) -> float:
    """Jain's index of the targets' shares of time watched."""
    there = tally.target_steps.sum(axis=0)
    shares = tally.watched.sum(axis=0)[there > 0] / there[there > 0]
    squares = float((shares**2).sum())
    return float(shares.sum()) ** 2 / (shares.size * squares) if squares > 0 else float("nan")


METRICS: dict[str, Metric] = {
    "time_on_target": Metric(
        "1",
        "share of the steps with a target there at which an agent is on it",
        lambda t, f: _share(t.on_target, t.present),
        high=1.0,
    ),
    "xi": Metric(
        "1",
        "velocity fluctuation: mean of |v_i - mean v| over steps and agents / mean top speed (Eqs. 5-7)",
        lambda t, f: _share(t.fluctuation, t.steps) / _agents(t) / mean_max_speed(t, f),
    ),
    "xi_raw": Metric(
        "m/s", "velocity fluctuation, not normalized", lambda t, f: _share(t.fluctuation, t.steps) / _agents(t)
    ),
    "response": Metric(
        "unit/step",
        "mean over steps of the sum over agents of |v_i - mean v|, in arena units per step",
        lambda t, f: _share(t.fluctuation, t.steps) * f.time_step / f.unit,
    ),
    "engaged": Metric(
        "agents",
        "mean number of agents on target while a target is there",
        lambda t, f: _share(t.engaged, t.present),
        high="agents",
    ),
    "stationary": Metric(
        "1",
        "share of agents slower than a tenth of their top speed while a target is there",
        lambda t, f: _share(t.stationary, t.histogram),
        high=1.0,
    ),
    "target_present": Metric(
        "1",
        "share of the steps with a target there",
        lambda t, f: _share(t.present, t.steps),
        once=True,
        high=1.0,
    ),
    "targets_observed": Metric(
        "targets",
        "mean number of targets that somebody is on (as in CMOMMT: Parker, Autonomous Robots 12, 2002)",
        lambda t, f: _share(t.watched, t.steps),
    ),
    "fairness": Metric(
        "1",
        "Jain's index of the targets' time on target: 1 all alike, 1/T one has it all",
        lambda t, f: _fairness(t),
        high=1.0,
    ),
    "first_detection": Metric(
        "s",
        "time at which a target is there until it is first detected, mean over targets; the whole of it if never",
        lambda t, f: float(t.undetected.sum(axis=0).mean()) * f.time_step,
        once=True,
        high="duration",
    ),
    "losses": Metric(
        "1/h",
        "how often a target is lost, per hour of it being there",
        lambda t, f: _share(t.losses, t.target_steps) * 3600.0 / f.time_step,
        high="flicker",
    ),
    "reacquisition": Metric(
        "s",
        "mean time from the loss of a target to its next detection",
        lambda t, f: _share(t.ended_steps, t.ended) * f.time_step,
        high="duration",
    ),
    "coverage": Metric(
        "1",
        "share of the arena that agents pass through in 1,000 steps (grid of 32 x 32)",
        lambda t, f: _share(t.covered, t.windows),
        high="reach",
    ),
    "coverage_rate": Metric(
        "m^2/s",
        "area that agents newly pass through per second, over 100 steps",
        lambda t, f: _share(t.swept, t.sweeps) * f.area / (100 * f.time_step),
    ),
    "closest": Metric(
        "m",
        "smallest distance between two agents, looked at every 25 steps; of one run, and the longer the smaller",
        lambda t, f: _closest(t),
        once=True,
    ),
    "components": Metric(
        "1",
        "parts that the network falls into (synchronous order)",
        lambda t, f: _share(t.components, t.graphs),
        low=1.0,
        high="agents",
    ),
    "clustering": Metric(
        "1",
        "share of pairs of an agent's neighbors that are linked (synchronous order)",
        lambda t, f: _share(t.clustering, t.graphs),
        high=1.0,
    ),
    "messages": Metric(
        "1/s", "reports that an agent receives per second", lambda t, f: _share(t.heard, t.agent_steps) / f.time_step
    ),
    "bandwidth": Metric(
        "B/s",
        "bytes of reports that an agent receives per second",
        lambda t, f: _share(t.heard, t.agent_steps) / f.time_step * f.report_bytes,
    ),
    "speed": Metric("m/s", "mean speed of the agents", lambda t, f: _share(t.distance, t.agent_steps) / f.time_step),
    "power": Metric(
        "m^3/s^3",
        "mean cube of the agents' speed, a proxy of propulsion power",
        lambda t, f: _share(t.cubes, t.agent_steps) / f.time_step,
    ),
}


def evaluate(name: str, tally: Tally, facts: Facts) -> tuple[float, Floats]:
    """Return a metric over all steps and over each batch of steps, (B,); none of a metric that happens once."""
    formula = METRICS[name].formula
    if METRICS[name].once:
        return formula(tally, facts), np.array([])
    batches = [formula(batch_of(tally, b), facts) for b in range(tally.steps.size)]
    return formula(tally, facts), np.array(batches)


def batch_values(formula: Callable[[Tally], float], tally: Tally) -> Floats:
    """Return a metric in each batch that has one, (<= B,), so that their spread tells that of the whole run's value.

    Those of the jackknife: n times the whole less (n - 1) times the run without the batch. The same as the batch's own
    value where every batch weighs the same; of a ratio such as the time to find a target again, whose batches hold
    more or fewer cases, they have no bias. Batches that the metric does not hear of (a loss that does not end) have
    none.
    """
    batches = tally.steps.size
    whole = Tally._make(_summed(part, batches) for part in tally)
    heard = [batch for batch in range(batches) if math.isfinite(formula(batch_of(tally, batch)))]
    count, value = len(heard), formula(whole)
    if count == 1:
        return np.array([value])
    return np.array([count * value - (count - 1) * formula(_without(whole, tally, batch)) for batch in heard])


def bounds_of(name: str, **limits: float) -> Bounds:
    """Bounds of a metric, with those of LIMITS that are known."""
    metric = METRICS[name]
    return Bounds(metric.low, (LIMITS | limits)[metric.high] if isinstance(metric.high, str) else metric.high)


def phi_histogram(tally: Tally) -> Floats:
    """Mean agents per step in each bin of phi, by fleet: (F, 11); the bins of all fleets sum to N."""
    present = tally.present.sum()
    sums: Floats = tally.histogram.sum(axis=0)
    return sums / present if present > 0 else np.full(sums.shape, np.nan)


def fleet_fluctuation(tally: Tally, facts: Facts) -> Floats:
    """xi_raw of each fleet [m/s], (F,): fluctuation around the mean velocity of the whole swarm."""
    result: Floats = tally.fluctuation.sum(axis=0) / or_nan(tally.steps.sum() * _fleet_agents(tally))
    return result


def fleet_stationary(tally: Tally, facts: Facts) -> Floats:
    """Stationary share of each fleet, (F,)."""
    result: Floats = tally.stationary.sum(axis=0) / or_nan(tally.histogram.sum(axis=(0, 2)))
    return result


def fleet_power(tally: Tally, facts: Facts) -> tuple[Floats, Floats]:
    """Mean speed [m/s] and mean cube of the speed [m^3/s^3] of each fleet's agents, (F,)."""
    steps = or_nan(tally.agent_steps.sum(axis=0)) * facts.time_step
    begins = np.concatenate([[0], np.cumsum(facts.counts)[:-1]])
    distance: Floats = np.add.reduceat(tally.distance.sum(axis=0), begins) / steps
    cubes: Floats = np.add.reduceat(tally.cubes.sum(axis=0), begins) / steps
    return distance, cubes


def or_nan(sums: npt.NDArray[Any]) -> Floats:
    """Sums to divide by, NaN where they are zero: what nobody was there for has no mean."""
    return np.where(sums > 0, sums, np.nan)


def _summed(part: npt.NDArray[Any], batches: int) -> npt.NDArray[Any]:
    """A column of a tally, its batches summed; what is no sum stays."""
    return part.sum(axis=0, keepdims=True) if part.shape[0] == batches else part


def _without(whole: Tally, tally: Tally, batch: int) -> Tally:
    """The sums of all batches but one."""
    return Tally._make(
        total - part[batch : batch + 1] if part.shape[0] == tally.steps.size else total
        for total, part in zip(whole, tally, strict=True)
    )
