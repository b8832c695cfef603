"""A mean and an honest interval: over replicates, or over the batches of one long run."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.metrics.summary import ANYTHING, Bounds
from shoal.record.words import interval_text, mean_text

# 97.5 % quantiles of Student's t for 1 to 30 degrees of freedom (standard table); beyond, Cornish-Fisher around z.
_T975 = (
    12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131,
    2.120, 2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042,
)  # fmt: skip


FEWEST = 4  # batches of one run that tell an interval
_TOGETHER = 3 / 20  # of all batches: the length of the overlapping ones
_ALIKE = 1e-9  # relative: values that differ by rounding only
_FEW = 5  # runs listed one by one


class Estimate(NamedTuple):
    """Mean, 95 % confidence interval (None where it cannot be determined) and the value of each run."""

    mean: float
    ci95: tuple[float, float] | None
    runs: tuple[float, ...]

    def __repr__(self) -> str:
        """In short: rounded, and the runs only counted where they are many."""
        interval = f"({self.ci95[0]:.4g}, {self.ci95[1]:.4g})" if self.ci95 else "None"
        few = len(self.runs) <= _FEW
        runs = f"({', '.join(f'{each:.4g}' for each in self.runs)})" if few else f"<{len(self.runs)} values>"
        return f"Estimate(mean={self.mean:.4g}, ci95={interval}, runs={runs})"

    def _repr_html_(self) -> str:
        """The same for a notebook."""
        ends, runs = interval_text(self), len(self.runs)
        return f"<b>{mean_text(self)}</b>{f' {ends}' * bool(ends)}, {runs} run{'s' * (runs != 1)}"


def estimate(runs: npt.ArrayLike, batches: npt.ArrayLike | None = None, bounds: Bounds = ANYTHING) -> Estimate:
    """Estimate a metric from its value in each run, (R,).

    Two or more runs: Student's t over runs, which are independent. One run: overlapping batch means of `batches`, its
    values in consecutive batches of steps (B,), see `metrics.summary.batch_values`. No interval: values that are all
    alike do not tell how rare others are, and a run is too short if it has fewer than 4 batches with a value, or if
    each goes on as the one before. An interval stays within `bounds`.
    """
    values = np.asarray(runs, float)
    mean = float(values.mean())
    each = tuple(float(value) for value in values)
    if not np.isfinite(mean):
        return Estimate(mean, None, each)
    half = (
        _over_runs(values) if values.size > 1 else _over_batches(np.asarray([] if batches is None else batches, float))
    )
    return Estimate(mean, None if half is None else inside(mean, half, bounds), each)


def inside(mean: float, half: float, bounds: Bounds) -> tuple[float, float]:
    """Return the interval of a mean, plus and minus `half` where bounds are far, within them where they are not.

    It is symmetric on a scale that has no end at a bound (delta method): the logit between two bounds; the fourth root
    above one, which unlike the logarithm stays finite for two runs.
    """
    low, high = bounds
    if not low < mean < high:  # a mean at a bound, or no bounds
        return max(mean - half, low), min(mean + half, high)
    if math.isinf(low):
        return mean - half, mean + half
    above = mean - low
    if math.isinf(high):
        step = half / (4 * above)
        return low + above * max(1 - step, 0.0) ** 4, low + above * (1 + step) ** 4
    share, width = above / (high - low), high - low
    step = half / (width * share * (1 - share))
    odds, factor = share / (1 - share), math.exp(min(step, 700.0))
    return low + width / (1 + factor / odds), high - width / (1 + factor * odds)


def all_alike(values: npt.NDArray[np.float64]) -> bool:
    """Whether values differ by no more than rounding."""
    return bool(np.ptp(values) <= _ALIKE * np.abs(values).max())


def _over_runs(values: npt.NDArray[np.float64]) -> float | None:
    if all_alike(values):
        return None
    return t_quantile(values.size - 1) * float(values.std(ddof=1)) / math.sqrt(values.size)


def _over_batches(batches: npt.NDArray[np.float64]) -> float | None:
    """Half of the interval by overlapping batch means: they are right where neighboring batches are correlated a bit.

    Meketon, Schmeiser, "Overlapping batch means: something for nothing?", Winter Simulation Conference 1984.
    """
    values = batches[np.isfinite(batches)]
    count = values.size
    if count < FEWEST or all_alike(values) or _goes_on(values):
        return None
    size = max(1, int(count * _TOGETHER))
    sums = np.cumsum(np.concatenate([[0.0], values]))
    means = (sums[size:] - sums[:-size]) / size
    variance = size * float(((means - values.mean()) ** 2).sum()) / (means.size * (1 - size / count))
    degrees = count - 1 if size == 1 else int(1.5 * (count / size - 1))
    return t_quantile(degrees) * math.sqrt(variance / count)


def _goes_on(values: npt.NDArray[np.float64]) -> bool:
    """Whether values are so correlated, each with the next, that chance alone gives it in one case of a hundred."""
    off = values - values.mean()
    return bool((off[1:] * off[:-1]).sum() / (off**2).sum() + 1 / off.size > 2.33 / math.sqrt(off.size))


def t_quantile(degrees: int) -> float:
    """97.5 % quantile of Student's t."""
    if degrees <= len(_T975):
        return _T975[degrees - 1]
    z = 1.959964
    return float(z + (z**3 + z) / (4 * degrees) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * degrees**2))


def two_sided(t: float, degrees: float) -> float:
    """Chance that Student's t lies further from zero than `t`; infinite `degrees` are the normal distribution.

    Finite series of Abramowitz and Stegun, 26.7.3 and 26.7.4: exact, but no smaller chance than 1e-15 is resolved.
    """
    t = abs(t)
    if math.isinf(degrees):
        return math.erfc(t / math.sqrt(2))
    angle = math.atan2(t, math.sqrt(degrees))
    odd = int(degrees) % 2
    cosine, sine = math.cos(angle), math.sin(angle)
    term, total = (cosine if odd else 1.0), 0.0
    for power in range(odd, int(degrees) - 1, 2):
        total += term
        term *= cosine**2 * (power + 1) / (power + 2)
    inside = 2 / math.pi * (angle + sine * total) if odd else sine * total
    return max(0.0, 1.0 - inside)
