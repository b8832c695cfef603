"""The front: what no other beats, by a metric of which less is better and one of which more is."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


class Spread(NamedTuple):
    """A mean and the ends of its interval; NaN ends: they are not known."""

    mean: float
    low: float
    high: float


def front(less: npt.ArrayLike, more: npt.ArrayLike) -> list[int]:
    """Return which of N points no other dominates, cheapest first; of equal ones the first. NaN is never among them.

    Parameters
    ----------
    less, more : (N,) of which less, and of which more is better
    """
    costs, values = np.asarray(less, float), np.asarray(more, float)
    known = [at for at in range(costs.size) if np.isfinite(costs[at]) and np.isfinite(values[at])]
    found: list[int] = []
    for at in sorted(known, key=lambda at: (costs[at], -values[at])):
        if not found or values[at] > values[found[-1]]:
            found.append(at)
    return found


def hypervolume(less: npt.ArrayLike, more: npt.ArrayLike, reference: tuple[float, float]) -> float:
    """Return the area that the front of N points dominates, up to a reference point (most cost, least value).

    Zitzler, Thiele, PPSN V (1998). Points beyond the reference add nothing.
    """
    costs, values = np.asarray(less, float), np.asarray(more, float)
    area, best = 0.0, reference[1]
    for at in front(costs, values):
        area += max(reference[0] - costs[at], 0.0) * max(values[at] - best, 0.0)
        best = max(best, values[at])
    return float(area)


def dominated_for_sure(less: Sequence[Spread], more: Sequence[Spread]) -> list[int | None]:
    """Return, for each of N points, one that dominates it beyond its interval and theirs; None where none does.

    The other costs no more at the high end of its interval than this one at the low end, and is worth no less at the
    low end than this one at the high end; one of the two is a difference. An interval that is not known overlaps all.
    """
    return [
        next((other for other in range(len(less)) if _beats(less[other], more[other], less[at], more[at])), None)
        for at in range(len(less))
    ]


def _beats(less: Spread, more: Spread, than_less: Spread, than_more: Spread) -> bool:
    no_worse = less.high <= than_less.low and more.low >= than_more.high  # False with NaN
    return no_worse and (less.high < than_less.low or more.low > than_more.high)


def gains(less: npt.ArrayLike, more: npt.ArrayLike, known: tuple[npt.ArrayLike, npt.ArrayLike], worst: float) -> Floats:
    """Return the hypervolume that each of M points alone adds to the front of `known` ones, (M,).

    Parameters
    ----------
    less, more : (M,) of the points
    known : the same of N points
    worst : the most of `less` that counts
    """
    costs, values = np.asarray(known[0], float), np.asarray(known[1], float)
    order = front(costs, values)
    steps = np.concatenate([[-np.inf], costs[order]])
    ends = np.concatenate([costs[order], [worst]])
    heights = np.concatenate([[min(0.0, float(np.nanmin(values)))], values[order]])
    at, height = np.asarray(less, float)[:, None], np.asarray(more, float)[:, None]
    added = np.maximum(ends - np.maximum(steps, at), 0.0) * np.maximum(height - heights, 0.0)
    total: Floats = added.sum(axis=1)
    return total
