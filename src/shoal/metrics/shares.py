"""Sums divided by sums, as formulas of metrics do it: what nobody was there for is NaN."""

from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.core.agents import Floats
from shoal.metrics.contract import Facts


def share(part: npt.NDArray[Any], whole: npt.NDArray[Any]) -> float:
    """All of a sum divided by all of another; NaN if that is zero."""
    return float(part.sum() / whole.sum()) if whole.sum() > 0 else float("nan")


def fleet_agents(tally: Any) -> Floats:
    """Mean number of agents of each fleet that are present, (F,)."""
    steps = tally.steps.sum()
    agents: Floats = tally.agent_steps.sum(axis=0) / (steps if steps > 0 else np.nan)
    return agents


def mean_agents(tally: Any) -> float:
    """N, the mean number of agents present; NaN if never any."""
    return float(fleet_agents(tally).sum()) or float("nan")


def mean_max_speed(tally: Any, facts: Facts) -> float:
    """vbar_max: mean top speed of the agents [m/s]. Kwa et al., Heterogeneous Swarms, Eq. 6."""
    agents = fleet_agents(tally)
    return float(sum(n * v for n, v in zip(agents, facts.max_speeds, strict=True)) / or_nan(agents.sum()))


def or_nan(sums: npt.NDArray[Any]) -> Floats:
    """Sums to divide by, NaN where they are zero: what nobody was there for has no mean."""
    return np.where(sums > 0, sums, np.nan)
