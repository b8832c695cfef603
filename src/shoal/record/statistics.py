"""A mean and an honest interval: over replicates, or over the batches of one long run."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

# 97.5 % quantiles of Student's t for 1 to 30 degrees of freedom (standard table); beyond, Cornish-Fisher around z.
_T975 = (
    12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131,
    2.120, 2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042,
)  # fmt: skip


_FEW = 5  # runs listed one by one


class Estimate(NamedTuple):
    """Mean, 95 % confidence interval (None where it cannot be told) and the value of each run."""

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
        interval = f", 95 % interval {self.ci95[0]:.4g} .. {self.ci95[1]:.4g}" if self.ci95 else ""
        runs = len(self.runs)
        return f"<b>{self.mean:.4g}</b>{interval}, {runs} run{'s' * (runs != 1)}"


def estimate(runs: npt.ArrayLike, batches: npt.ArrayLike | None = None) -> Estimate:
    """Estimate a metric from its value in each run, (R,).

    Two or more runs: Student's t over runs, which are independent. One run: Student's t over `batches`, its values in
    consecutive batches of steps (B,), which are nearly independent when a batch is long against the swarm's memory.
    """
    values = np.asarray(runs, float)
    mean = float(values.mean())
    samples = values if values.size > 1 else np.asarray(batches if batches is not None else [], float)
    samples = samples[np.isfinite(samples)]
    each = tuple(float(value) for value in values)
    if samples.size < 2 or not np.isfinite(mean):
        return Estimate(mean, None, each)
    half = t_quantile(samples.size - 1) * float(samples.std(ddof=1)) / float(np.sqrt(samples.size))
    return Estimate(mean, (mean - half, mean + half), each)


def t_quantile(degrees: int) -> float:
    """97.5 % quantile of Student's t."""
    if degrees <= len(_T975):
        return _T975[degrees - 1]
    z = 1.959964
    return float(z + (z**3 + z) / (4 * degrees) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * degrees**2))


def two_sided(t: float, degrees: float) -> float:
    """Chance that Student's t lies further from zero than `t`; infinite `degrees` are the normal distribution.

    Finite series of Abramowitz and Stegun, 26.7.3 and 26.7.4: exact, but no smaller chance than 1e-15 is told apart.
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
