"""Exchange rates: how many agents of one fleet do what one of another does, in what was tried.

The value of a fleet is taken for a smooth function of s = n_1 + w_2 n_2 + ..., agents weighted by what they are worth,
and of whatever else varies: y = b_0 + b_1 log s + b_2 (log s)^2 + b_3 (log s)^3 + c_1 z + c_2 z^2. The weights are
those of least squares; the interval is that of the jackknife over groups of fleets (Efron, Stein, Ann. Stat. 9, 1981),
by Student's t on their logarithms. It holds the chance of runs and the misfit of the curve, both.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.record.statistics import t_quantile

GROUPS = 20  # of the jackknife
_LEAST, _MOST = 1 / 50, 50.0  # a weight at an end of what is looked at is not known
_COARSE = 41  # weights looked at first
_GOLDEN, _HALVINGS = (math.sqrt(5) - 1) / 2, 18  # of the golden section: to a ten-thousandth
_TELLS = 6.0  # F of the three terms in log s, at least: pure noise is beyond it once in a thousand
_ROUNDS = 3  # over all fleets, where there are three or more
_SPARE = 8  # fleets beyond the coefficients, at least

Floats = npt.NDArray[np.float64]


class ExchangeRate(NamedTuple):
    """One agent of a fleet (its number) is worth `worth` of the reference, 95 % interval from low to high."""

    fleet: int
    worth: float
    low: float
    high: float


def exchange_rates(
    counts: npt.ArrayLike, others: npt.ArrayLike, values: npt.ArrayLike, base: int
) -> list[ExchangeRate]:
    """Return the rate of each fleet that varies against fleet `base`; none where what was tried does not tell it.

    Parameters
    ----------
    counts : (T, F) agents of each fleet in each trial
    others : (T, V) what else varied
    values : (T,) what each trial was worth; NaN: unknown
    """
    agents, rest, worth = (np.asarray(each, float) for each in (counts, others, values))
    known = np.isfinite(worth) & (agents.sum(axis=1) > 0)
    agents, rest, worth = agents[known], rest[known], worth[known]
    if not worth.size or np.ptp(agents[:, base]) == 0 or np.ptp(worth) == 0:
        return []
    scaled = (rest - rest.mean(axis=0)) / np.where(np.ptp(rest, axis=0) > 0, rest.std(axis=0), 1.0)
    free = [fleet for fleet in range(agents.shape[1]) if fleet != base and np.ptp(agents[:, fleet]) > 0]
    if not free or worth.size < 4 + 2 * scaled.shape[1] + len(free) + _SPARE:
        return []
    whole = _logs(agents, scaled, worth, free)
    weights = np.ones(agents.shape[1])
    weights[free] = np.exp(whole)
    if not _tells(agents @ weights, scaled, worth):
        return []
    groups = min(GROUPS, worth.size)
    group = np.arange(worth.size) % groups
    kept = [group != each for each in range(groups)]
    left = np.array([_logs(agents[each], scaled[each], worth[each], free) for each in kept])
    error = np.sqrt((groups - 1) / groups * ((left - left.mean(axis=0)) ** 2).sum(axis=0))
    half = t_quantile(groups - 1) * error
    return [
        ExchangeRate(fleet, math.exp(at), math.exp(at - wide), math.exp(at + wide))
        for fleet, at, wide, all_of in zip(free, whole, half, left.T, strict=True)
        if all(_inside(float(each)) for each in (at, *all_of))
    ]


def _logs(agents: Floats, rest: Floats, worth: Floats, free: list[int]) -> Floats:
    """Logarithms of the weights of the free fleets, by least squares, one after the other."""
    weights = np.ones(agents.shape[1])
    for _ in range(_ROUNDS if len(free) > 1 else 1):
        for fleet in free:
            weights[fleet] = math.exp(_least(_misfit_by(agents, rest, worth, weights, fleet)))
    return np.log(weights[free])


def _misfit_by(agents: Floats, rest: Floats, worth: Floats, weights: Floats, fleet: int) -> Callable[[float], float]:
    """The sum of squares that is left, by the logarithm of one weight."""

    def misfit(log_weight: float) -> float:
        tried = weights.copy()
        tried[fleet] = math.exp(log_weight)
        return _left(_columns(agents @ tried, rest), worth)

    return misfit


def _tells(strength: Floats, rest: Floats, worth: Floats) -> bool:
    """Whether strength explains more of the worth than noise would (F test of its three terms)."""
    columns = _columns(strength, rest)
    left, without = _left(columns, worth), _left(np.delete(columns, [1, 2, 3], axis=1), worth)
    degrees = worth.size - columns.shape[1]
    return bool((without - left) / 3 > _TELLS * left / degrees)


def _columns(strength: Floats, rest: Floats) -> Floats:
    logs = np.log(strength)
    return np.column_stack([np.ones_like(logs), logs, logs**2, logs**3, rest, rest**2])


def _left(columns: Floats, worth: Floats) -> float:
    solved = np.linalg.lstsq(columns, worth, rcond=None)[0]
    return float(((worth - columns @ solved) ** 2).sum())


def _least(misfit: Callable[[float], float]) -> float:
    """Where a function of one variable is least: over a grid, then by the golden section around its best."""
    tried = np.linspace(math.log(_LEAST), math.log(_MOST), _COARSE)
    best = int(np.argmin([misfit(float(each)) for each in tried]))
    low, high = float(tried[max(best - 1, 0)]), float(tried[min(best + 1, _COARSE - 1)])
    one, other = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    at_one, at_other = misfit(one), misfit(other)
    for _ in range(_HALVINGS):
        if at_one < at_other:
            high, other, at_other = other, one, at_one
            one = high - _GOLDEN * (high - low)
            at_one = misfit(one)
        else:
            low, one, at_one = one, other, at_other
            other = low + _GOLDEN * (high - low)
            at_other = misfit(other)
    return (low + high) / 2


def _inside(log_weight: float) -> bool:
    step = math.log(_MOST / _LEAST) / (_COARSE - 1)
    return math.log(_LEAST) + step < log_weight < math.log(_MOST) - step
