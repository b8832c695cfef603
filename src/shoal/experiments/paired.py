"""Differences of paired runs, and what is left of their significance when there are many of them."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.metrics.summary import ANYTHING, Bounds
from shoal.record.statistics import all_alike, estimate, two_sided

SIGNIFICANT = 0.05  # of all true "no difference" in a table, the chance that any is called a difference


class Difference(NamedTuple):
    """Mean difference of paired runs, its 95 % interval and two-sided p (None: undetermined), number of pairs."""

    mean: float
    ci95: tuple[float, float] | None
    p: float | None
    pairs: int


def paired_difference(values: npt.ArrayLike, others: npt.ArrayLike, bounds: Bounds = ANYTHING) -> Difference:
    """Return values - others, (R,) each, by Student's t over the runs that both have; NaN: a run without a value.

    Where all pairs differ alike, t knows nothing of how rare others are: no interval, and p is that of the sign test.
    `bounds` are those of the values.
    """
    differences = np.asarray(values, float) - np.asarray(others, float)
    differences = differences[np.isfinite(differences)]
    pairs = differences.size
    if pairs == 0:
        return Difference(float("nan"), None, None, 0)
    known = estimate(differences)
    if pairs == 1:
        return Difference(known.mean, None, None, pairs)
    if known.ci95 is None or all_alike(differences):
        return Difference(known.mean, None, 2.0 ** (1 - pairs) if known.mean else 1.0, pairs)
    error = float(differences.std(ddof=1)) / pairs**0.5
    widest = bounds.high - bounds.low
    interval = (max(known.ci95[0], -widest), min(known.ci95[1], widest))
    return Difference(known.mean, interval, two_sided(known.mean / error, pairs - 1), pairs)


def holm(p_values: Sequence[float | None]) -> list[float | None]:
    """Return adjusted p, in the same order: a level held against each bounds the chance of any false difference.

    Holm, "A simple sequentially rejective multiple test procedure", Scandinavian Journal of Statistics 6 (1979).
    """
    adjusted: list[float | None] = [None] * len(p_values)
    known = sorted((p, at) for at, p in enumerate(p_values) if p is not None)
    highest = 0.0
    for number, (p, at) in enumerate(known):
        highest = max(highest, min(1.0, (len(known) - number) * p))
        adjusted[at] = highest
    return adjusted
