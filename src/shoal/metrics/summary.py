"""From sums to numbers: every metric as one formula over a tally, for all steps or for one batch of them."""

import math
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.agents import Floats
from shoal.core.declared import Declared
from shoal.core.errors import PluginError
from shoal.metrics.catalogue import DECLARED
from shoal.metrics.contract import LIMITS, Facts, Measurement, Metric
from shoal.metrics.tally import Tally, batch_of, new_tally, of_batches


class Bounds(NamedTuple):
    """Between which values a metric lies, whatever happens."""

    low: float = -math.inf
    high: float = math.inf


ANYTHING = Bounds()


_ONE_FLEET = Facts(("fleet",), (2,), (1.0,), unit=1.0, time_step=1.0, area=1.0)


def _named(each: Declared[Measurement]) -> Iterator[tuple[str, Metric]]:
    """The metrics of a measurement by name.

    Raises
    ------
    PluginError : a formula that a package brings fails for an empty tally
    """
    for metric in each.value.metrics:
        if each.package is not None:
            metric = metric._replace(formula=_careful(metric, each.package), package=each.package)
            metric.formula(new_tally(1, 1, 1, 2, 1), _ONE_FLEET)  # fails now rather than after a night
        yield metric.name, metric


def _careful(metric: Metric, package: str) -> Callable[[Any, Facts], float]:
    """The formula of an installed package's metric; where it fails, it says whose it is."""

    def formula(tally: Any, facts: Facts) -> float:
        try:
            with np.errstate(all="ignore"):
                return float(metric.formula(tally, facts))
        except Exception as error:
            problem = f"the formula of its metric {metric.name!r} fails: {type(error).__name__}: {error}"
            raise PluginError(package, problem, "fix or uninstall it") from error

    return formula


METRICS: dict[str, Metric] = dict(named for each in DECLARED for named in _named(each))


def evaluate(name: str, tally: Tally, facts: Facts) -> tuple[float, Floats]:
    """Return a metric over all steps and over each batch of steps, (B,); none of a metric that happens once."""
    formula = METRICS[name].formula
    if METRICS[name].once:
        return formula(tally, facts), np.array([])
    batches = [formula(batch_of(tally, b), facts) for b in range(tally.steps.size)]
    return formula(tally, facts), np.array(batches)


def batch_values(formula: Callable[[Tally], float], tally: Tally) -> Floats:
    """Return a metric in each batch that has one, (<= B,), so that their spread tells that of the whole run's value.

    Those of the jackknife: n times the value of all less (n - 1) times the run without the batch. The same as that
    of the batch where every batch weighs the same; of a ratio such as the time to find a target again, whose batches
    hold more or fewer cases, they have no bias. Batches without a case (a loss that does not end) have none.
    """
    batches = tally.steps.size
    whole = Tally._make(_summed(name, part) for name, part in zip(Tally._fields, tally, strict=True))
    heard = [batch for batch in range(batches) if math.isfinite(formula(batch_of(tally, batch)))]
    count, value = len(heard), formula(whole)
    if count == 1:
        return np.array([value])
    return np.array([count * value - (count - 1) * formula(_without(whole, tally, batch)) for batch in heard])


def bounds_of(name: str, **limits: float) -> Bounds:
    """Bounds of a metric, with those of LIMITS that are known."""
    metric = METRICS[name]
    return Bounds(metric.low, (LIMITS | limits)[metric.high] if isinstance(metric.high, str) else metric.high)


def _summed(name: str, part: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """A column of a tally, its batches summed; what is kept for the run stays."""
    return part.sum(axis=0, keepdims=True) if of_batches(name) else part


def _without(whole: Tally, tally: Tally, batch: int) -> Tally:
    """The sums of all batches but one."""
    return Tally._make(
        total - part[batch : batch + 1] if of_batches(name) else total
        for name, total, part in zip(Tally._fields, whole, tally, strict=True)
    )
