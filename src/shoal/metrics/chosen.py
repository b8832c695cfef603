"""What must be counted for some of the metrics: those that nobody asks for cost nothing."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from shoal.core.errors import ScenarioError, did_you_mean
from shoal.core.text import quoted
from shoal.metrics.catalogue import MEASUREMENTS
from shoal.metrics.contract import Facts
from shoal.metrics.summary import METRICS
from shoal.metrics.tally import Tally, new_tally

ALWAYS = "time_on_target"  # steps and times there, which all others are divided by

_FACTS = Facts(("one", "other"), (2, 2), (1.0, 2.0), unit=1.0, time_step=1.0, area=1.0, interval=1.0, airtime=1.0)


class _Watched:
    """A tally that remembers which of its sums a formula asked for."""

    def __init__(self, tally: Tally) -> None:
        self._tally = tally
        self.asked: set[str] = set()

    def __getattr__(self, name: str) -> Any:
        self.asked.add(name)
        return getattr(self._tally, name)


def check_metrics(names: Iterable[str]) -> None:
    """Refuse metrics that there are not.

    Raises
    ------
    ScenarioError : no metric has a name
    """
    for name in names:
        if name not in METRICS:
            fix = did_you_mean(name, METRICS).rstrip() or f"there are: {', '.join(METRICS)}"
            raise ScenarioError("metrics", f"has {quoted(name)}, which is none", fix)


def skipped(metrics: Iterable[str]) -> int:
    """What need not be counted for metrics of these names, as bits: that of each of MEASUREMENTS. All if none is named.

    A metric needs what its own file counts, and what its formula asks for.

    Raises
    ------
    ScenarioError : no metric has a name
    """
    names = set(metrics)
    check_metrics(names)
    if not names:
        return 0
    sums = {name for metric in names for name in _sums_of(metric)}
    bits = 0
    for number, each in enumerate(MEASUREMENTS):
        own = {metric.name for metric in each.metrics} & names
        if each.name != ALWAYS and not own and not sums & {part.name for part in each.sums}:
            bits |= 1 << number
    return bits


def _sums_of(metric: str) -> set[str]:
    """The sums that a formula asks for, of a run in which something happened and of one in which nothing did."""
    asked: set[str] = set()
    empty = new_tally(4, 2, 2, 4, 1)
    for tally in (empty, Tally._make(np.ones_like(part) for part in empty)):
        watched = _Watched(tally)
        with np.errstate(all="ignore"):
            METRICS[metric].formula(watched, _FACTS)
        asked |= watched.asked
    return asked


def counted(tally: Tally, bits: int) -> Tally:
    """A tally with NaN for the sums that were not counted; the others are shared."""
    missing = {part.name for number, each in enumerate(MEASUREMENTS) if bits >> number & 1 for part in each.sums}
    return tally._replace(**{name: np.full(getattr(tally, name).shape, np.nan) for name in missing})
