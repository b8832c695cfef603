"""Found: the share of the targets that somebody was on before the run ended."""

from typing import Any

import numpy as np

from shoal.core.agents import Floats
from shoal.metrics.contract import Facts, Measurement, Metric


def times_to_find(tally: Any, facts: Facts) -> Floats:
    """How long each target was there until it was found first [s], (T,); inf if it never was."""
    before, there = tally.undetected.sum(axis=0), tally.target_steps.sum(axis=0)
    times: Floats = before * facts.time_step
    times[~(before < there)] = np.inf
    return times


MEASUREMENT = Measurement(
    "found",
    metrics=(
        Metric(
            "found",
            "1",
            "share of the targets that were detected at all",
            lambda t, f: float(np.isfinite(times_to_find(t, f)).mean()),
            better="higher",
            once=True,
            high=1.0,
        ),
    ),
    order=4,
)
