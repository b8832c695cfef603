"""The course of a run: what its metrics were at any step before its end."""

from typing import Any

import numpy as np

from shoal.core.agents import Floats
from shoal.metrics.contract import Facts
from shoal.metrics.summary import METRICS
from shoal.metrics.tally import Tally, new_tally
from shoal.record.record import Record


def value_of(metric: str, tally: Tally, facts: Facts) -> float:
    """A metric of the sums so far; NaN where there are none yet."""
    return METRICS[metric].formula(tally, facts)


class Course:
    """A run's sums up to a step: a record has them at the ends of batches, or of windows in them; they grow evenly."""

    def __init__(self, record: Record, run: int) -> None:
        tally, self._facts = record.tallies[run], record.facts
        windows = tally.timeline_present.shape[1]
        ends = np.cumsum(tally.batch_steps)
        within = -(-np.arange(1, windows + 1) * tally.batch_steps[:, None] // windows)
        self._windows = np.concatenate([[0.0], ((ends - tally.batch_steps)[:, None] + within).ravel()])
        self._present = _running(tally.timeline_present.reshape(-1, 1))
        self._on_target = _running(tally.timeline_on_target.reshape(-1, 1))
        self._batches = np.concatenate([[0.0], ends])
        self._sums = {name: _running(getattr(tally, name)) for name in ("steps", "fluctuation", "agent_steps")}
        self._none = new_tally(1, 1, len(self._facts.fleets), self._facts.agents, tally.watched.shape[1])

    def time_on_target(self, first: int, last: int) -> float:
        """Over the steps from `first` to before `last`."""
        present = _until(last, self._windows, self._present) - _until(first, self._windows, self._present)
        on_target = _until(last, self._windows, self._on_target) - _until(first, self._windows, self._on_target)
        sums = self._none._replace(present=present, on_target=on_target)
        return value_of("time_on_target", sums, self._facts)

    def xi(self, last: int) -> float:
        """Over the steps before `last`."""
        sums: dict[str, Any] = {name: _until(last, self._batches, each)[None] for name, each in self._sums.items()}
        return value_of("xi", self._none._replace(**sums), self._facts)


def _running(sums: Floats) -> Floats:
    """Sums of batches (B,) or (B, F), added up from nothing: (B + 1, F)."""
    columns = sums.reshape(sums.shape[0], -1)
    return np.concatenate([np.zeros((1, columns.shape[1])), np.cumsum(columns, axis=0)])


def _until(step: float, ends: Floats, running: Floats) -> Floats:
    """Running sums at a step, (F,)."""
    return np.array([np.interp(step, ends, column) for column in running.T])
