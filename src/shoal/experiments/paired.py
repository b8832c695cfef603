"""Differences of paired runs, and what is left of their significance when there are many of them."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.errors import MissingExtraError
from shoal.record.statistics import estimate

SIGNIFICANT = 0.05  # of all true "no difference" in a table, the chance that any is called a difference


class Difference(NamedTuple):
    """Mean difference of paired runs, its 95 % interval and two-sided p (None: cannot be told), number of pairs."""

    mean: float
    ci95: tuple[float, float] | None
    p: float | None
    pairs: int


def paired_difference(values: npt.ArrayLike, others: npt.ArrayLike) -> Difference:
    """Return values - others, (R,) each, by Student's t over the runs that both have; NaN: a run without a value.

    Raises
    ------
    MissingExtraError : scipy is absent
    """
    differences = np.asarray(values, float) - np.asarray(others, float)
    differences = differences[np.isfinite(differences)]
    pairs = differences.size
    if pairs == 0:
        return Difference(float("nan"), None, None, 0)
    known = estimate(differences)
    if known.ci95 is None:
        return Difference(known.mean, None, None, pairs)
    error = float(differences.std(ddof=1)) / pairs**0.5
    if error == 0.0:  # all pairs differ alike: by nothing, or beyond doubt
        return Difference(known.mean, known.ci95, 0.0 if known.mean else 1.0, pairs)
    return Difference(known.mean, known.ci95, _two_sided(abs(known.mean) / error, pairs - 1), pairs)


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


def need_scipy() -> None:
    """Refuse at once what would fail after all runs.

    Raises
    ------
    MissingExtraError : scipy is absent
    """
    try:
        import scipy.stats  # noqa: F401
    except ImportError:
        raise MissingExtraError.of("scipy", "sweep", "comparing strategies") from None


def _two_sided(t: float, degrees: int) -> float:
    need_scipy()
    from scipy.stats import t as student

    return float(2 * student.sf(t, degrees))
