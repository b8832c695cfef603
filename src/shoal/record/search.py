"""How long a search takes: the chance to have found a target by a time, and the median time."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

_Z = 1.959964  # 97.5 % quantile of the normal distribution

Floats = npt.NDArray[np.float64]


class FoundShares(NamedTuple):
    """The share of `runs` in which a target was found by each time [s], and its 95 % interval, (K,) each.

    NaN after the end of the runs: nobody knows.
    """

    time: Floats
    share: Floats
    low: Floats
    high: Floats
    runs: int


class SearchTime(NamedTuple):
    """Median time until a target is found [s], and its 95 % interval; inf: longer than the runs.

    The interval is None where there are too few runs for one (5 or less). `not_found`: of how many of the `runs`.
    """

    median: float
    ci95: tuple[float, float] | None
    not_found: int
    runs: int


def found_by(times_to_find: npt.ArrayLike, times: npt.ArrayLike, end: float) -> FoundShares:
    """Return the share of runs that found a target by each of `times`, (K,) [s].

    The interval is Wilson's, Journal of the American Statistical Association 22, 1927: it holds near 0 and 1, too.

    times_to_find : (R,) of each run [s], inf where it was never found; end : of the runs [s]
    """
    took = np.asarray(times_to_find, float)
    at = np.atleast_1d(np.asarray(times, float))
    share = (took[None, :] <= at[:, None]).mean(axis=1)
    middle = (share + _Z**2 / (2 * took.size)) / (1 + _Z**2 / took.size)
    half = _Z / (1 + _Z**2 / took.size) * np.sqrt(share * (1 - share) / took.size + (_Z / (2 * took.size)) ** 2)
    known = np.where((at <= end * (1 + 1e-9)), 1.0, np.nan)
    low, high = np.maximum(middle - half, 0.0), np.minimum(middle + half, 1.0)
    return FoundShares(at, share * known, low * known, high * known, took.size)


def time_to_find(times_to_find: npt.ArrayLike) -> SearchTime:
    """Return the median of times, of which those of runs that found nothing are longer than all others.

    All runs are equally long, so that the median of all is where the curve of Kaplan and Meier falls to a half. The
    interval lies between two order statistics, by the binomial distribution: it assumes nothing of how times are
    distributed.

    times_to_find : (R,) of each run [s], inf where it was never found
    """
    took = np.sort(np.asarray(times_to_find, float))
    count = took.size
    lower = took[(count - 1) // 2]
    upper = took[count // 2]
    rank = _rank(count)
    return SearchTime(
        median=float(lower if lower == upper else (lower + upper) / 2),
        ci95=None if rank is None else (float(took[rank]), float(took[count - 1 - rank])),
        not_found=int(np.isinf(took).sum()),
        runs=count,
    )


def _rank(count: int) -> int | None:
    """The largest r such that the r-th smallest (from 0) is above the median with a chance of 2.5 % at most."""
    below, rank = 0.0, None
    for r in range(count):
        below += math.exp(
            math.lgamma(count + 1) - math.lgamma(r + 1) - math.lgamma(count - r + 1) - count * math.log(2)
        )
        if below > 0.025:
            break
        rank = r
    return rank
