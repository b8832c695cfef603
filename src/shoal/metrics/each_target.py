"""Every target by itself: how much of its time somebody is on it, and how it is found, lost and found again."""

import numpy as np
import numpy.typing as npt

from shoal.core.agents import Floats
from shoal.metrics.contract import Facts
from shoal.metrics.shares import or_nan
from shoal.metrics.tally import Tally


def each_target(tally: Tally, facts: Facts) -> dict[str, Floats]:
    """Return time_on_target, first_detection [s], losses [1/h] and reacquisition [s] of every target, (T,) each.

    Defined as for the swarm (METRICS), over the steps at which this target is present. NaN: it never was, or was never
    found again.
    """
    there = or_nan(tally.target_steps.sum(axis=0))
    return {
        "time_on_target": tally.watched.sum(axis=0) / there,
        "first_detection": tally.undetected.sum(axis=0) * facts.time_step,
        "losses": tally.losses.sum(axis=0) / there * 3600.0 / facts.time_step,
        "reacquisition": tally.ended_steps.sum(axis=0) / or_nan(tally.ended.sum(axis=0)) * facts.time_step,
    }


def loss_lengths(tally: Tally, facts: Facts) -> tuple[Floats, npt.NDArray[np.int64]]:
    """Distribution of how long targets stay lost: edges of the bins [s], (B + 1,), and ended losses in each, (B,).

    Edges double; the first bin is losses of one step. Empty bins at the end are left out.
    """
    counts = np.nan_to_num(tally.loss_lengths.sum(axis=0)).astype(np.int64)  # NaN: not counted
    used = int(np.flatnonzero(counts)[-1]) + 1 if counts.any() else 0
    edges: Floats = facts.time_step * np.exp2(np.arange(used + 1, dtype=float))
    return edges, counts[:used]
