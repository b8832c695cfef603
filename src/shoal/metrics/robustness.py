"""Robustness: time on target before, during and after agents are lost or join, and how long recovery takes."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.agents import Floats
from shoal.metrics.tally import Tally

DURING = 1000  # steps that count as "during" a change
RECOVERED = 0.95  # of the time on target before


class Robustness(NamedTuple):
    """What one change of the swarm did to time on target, in one run.

    before : share from the change before this one (or the start) to this one
    during : share over the next 1,000 steps; after : from then on, until the next change or the end
    recovery : [s] until the first 1,000 steps over which the share is at least 95 % of `before` begin; 0 where nothing
        drops, NaN where that does not come before the next change
    """

    before: float
    during: float
    after: float
    recovery: float


def robustness(tally: Tally, changes: Sequence[int], time_step: float) -> list[Robustness]:
    """Return what each change did, for `changes` the steps at which agents are lost or join, in order.

    Times are as fine as the tally's timeline: a thousandth of the run or one step. The part of it in which a change
    falls belongs to neither side.
    """
    starts, present, on_target = _timeline(tally)
    ends = np.append(starts[1:], tally.batch_steps.sum())
    limits = [0, *changes, int(tally.batch_steps.sum())]
    found = []
    for previous, change, following in zip(limits, limits[1:], limits[2:], strict=False):
        inside = ends <= following
        before = _share(present, on_target, (starts >= previous) & (ends <= change))
        during = _share(present, on_target, (starts >= change) & (starts < change + DURING) & inside)
        after = _share(present, on_target, (starts >= change + DURING) & inside)
        recovery = np.nan
        for start in starts[(starts >= change) & (starts + DURING <= following)]:
            stretch = (starts >= start) & (ends <= start + DURING)
            if _share(present, on_target, stretch) >= RECOVERED * before:
                recovery = float(start - change) * time_step
                break
        found.append(Robustness(before, during, after, recovery))
    return found


def _timeline(tally: Tally) -> tuple[Floats, Floats, Floats]:
    """First step of every part of the timeline that has steps, steps with a target present, and steps on target."""
    parts = tally.timeline_present.shape[1]
    lengths = tally.batch_steps[:, None]
    begins = (np.cumsum(tally.batch_steps) - tally.batch_steps)[:, None]
    starts = (begins + np.ceil(np.arange(parts) * lengths / parts)).ravel()
    full = np.diff(np.append(starts, tally.batch_steps.sum())) > 0
    return starts[full], tally.timeline_present.ravel()[full], tally.timeline_on_target.ravel()[full]


def _share(present: Floats, on_target: Floats, which: npt.NDArray[np.bool_]) -> float:
    steps = present[which].sum()
    return float(on_target[which].sum() / steps) if steps > 0 else float("nan")
