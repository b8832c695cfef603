"""From sums to numbers: every metric as one formula over a tally, for all steps or for one batch of them."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.agents import Floats
from shoal.metrics.tally import Tally, batch_of


class Facts(NamedTuple):
    """What metrics need to know of a scenario: per fleet name, count and max_speed [m/s]; unit [m]; time_step [s]."""

    fleets: tuple[str, ...]
    counts: tuple[int, ...]
    max_speeds: tuple[float, ...]
    unit: float
    time_step: float

    @property
    def agents(self) -> int:
        """N."""
        return sum(self.counts)

    @property
    def mean_max_speed(self) -> float:
        """vbar_max: mean top speed of the agents [m/s]. Kwa et al., Heterogeneous Swarms, Eq. 6."""
        return sum(n * v for n, v in zip(self.counts, self.max_speeds, strict=True)) / self.agents


class Metric(NamedTuple):
    """A number per run: its unit, one sentence, and its formula over a tally whose batches are summed (B = 1)."""

    unit: str
    sentence: str
    formula: Callable[[Tally, Facts], float]


def _share(part: npt.NDArray[Any], whole: Floats) -> float:
    return float(part.sum() / whole.sum()) if whole.sum() > 0 else float("nan")


METRICS: dict[str, Metric] = {
    "time_on_target": Metric(
        "1",
        "share of the steps with a target there at which an agent is on it",
        lambda t, f: _share(t.on_target, t.present),
    ),
    "xi": Metric(
        "1",
        "velocity fluctuation: mean of |v_i - mean v| over steps and agents / mean top speed (Eqs. 5-7)",
        lambda t, f: _share(t.fluctuation, t.steps) / f.agents / f.mean_max_speed,
    ),
    "xi_raw": Metric(
        "m/s", "velocity fluctuation, not normalised", lambda t, f: _share(t.fluctuation, t.steps) / f.agents
    ),
    "response": Metric(
        "unit/step",
        "mean over steps of the sum over agents of |v_i - mean v|, in arena units per step",
        lambda t, f: _share(t.fluctuation, t.steps) * f.time_step / f.unit,
    ),
    "engaged": Metric(
        "agents", "mean number of agents on target while a target is there", lambda t, f: _share(t.engaged, t.present)
    ),
    "stationary": Metric(
        "1",
        "share of agents slower than a tenth of their top speed while a target is there",
        lambda t, f: _share(t.stationary, t.present) / f.agents,
    ),
    "target_present": Metric("1", "share of the steps with a target there", lambda t, f: _share(t.present, t.steps)),
}


def evaluate(name: str, tally: Tally, facts: Facts) -> tuple[float, Floats]:
    """Return a metric over all steps and over each batch of steps, (B,)."""
    formula = METRICS[name].formula
    batches = [formula(batch_of(tally, b), facts) for b in range(tally.steps.size)]
    return formula(tally, facts), np.array(batches)


def phi_histogram(tally: Tally) -> Floats:
    """Mean agents per step in each bin of phi, by fleet: (F, 11); the bins of all fleets sum to N."""
    present = tally.present.sum()
    sums: Floats = tally.histogram.sum(axis=0)
    return sums / present if present > 0 else np.full(sums.shape, np.nan)


def fleet_fluctuation(tally: Tally, facts: Facts) -> Floats:
    """xi_raw of each fleet [m/s], (F,): fluctuation around the mean velocity of the whole swarm."""
    result: Floats = tally.fluctuation.sum(axis=0) / tally.steps.sum() / np.array(facts.counts)
    return result


def fleet_stationary(tally: Tally, facts: Facts) -> Floats:
    """Stationary share of each fleet, (F,)."""
    present = tally.present.sum()
    result: Floats = tally.stationary.sum(axis=0) / (present if present > 0 else np.nan) / np.array(facts.counts)
    return result
