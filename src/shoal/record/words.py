"""Numbers in words, by one rule everywhere: in a terminal, a notebook, a figure, a page.

A mean and its 95 % interval are told to two digits of half the interval: 0.823 [0.729, 0.918]. A number without one is
whole, or has three digits. Thousands are set apart.
"""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from shoal.record.statistics import Estimate

MINUS, UNKNOWN = "\u2212", "unknown"
_FINEST = 6  # decimals


def estimate_text(value: "Estimate", apart: str = ",") -> str:
    """0.823 [0.729, 0.918], or the mean alone; `apart` sets thousands apart."""
    return told(value.mean, *(value.ci95 or (None, None)), apart=apart)


def mean_text(value: "Estimate") -> str:
    """0.823, as finely as its interval allows."""
    return number_text(value.mean, decimals_of(value.mean, *(value.ci95 or (None, None))))


def interval_text(value: "Estimate") -> str:
    """[0.729, 0.918], or nothing where it cannot be determined."""
    return ends_text(value.mean, *(value.ci95 or (None, None)))


def told(mean: float, low: float | None = None, high: float | None = None, *, apart: str = ",") -> str:
    """Mean and interval: 0.823 [0.729, 0.918]."""
    ends = ends_text(mean, low, high, apart=apart)
    text = number_text(mean, decimals_of(mean, low, high), apart)
    return f"{text} {ends}" if ends else text


def difference_text(mean: float, low: float | None = None, high: float | None = None) -> str:
    """A difference with its sign: +0.12 [0.08, 0.16], as finely told."""
    text = told(mean, low, high)
    return f"+{text}" if mean > 0 and float(text.split()[0].replace(",", "")) else text


def ends_text(mean: float, low: float | None, high: float | None, *, apart: str = ",") -> str:
    """[0.729, 0.918], or nothing where one of mean and ends is unknown."""
    if low is None or high is None or not math.isfinite(mean + low + high):
        return ""
    decimals = decimals_of(mean, low, high)
    return f"[{number_text(low, decimals, apart)}, {number_text(high, decimals, apart)}]"


def decimals_of(mean: float, low: float | None = None, high: float | None = None) -> int:
    """Decimals that show two digits of half the interval; negative: of tens, hundreds. None: three digits, or whole."""
    if low is None or high is None or not 0 < high - low < math.inf:
        if not math.isfinite(mean) or float(mean).is_integer():
            return 0
        return max(_decimals(abs(mean) / 10), 0)
    return _decimals((high - low) / 2)


def number_text(value: float, decimals: int, apart: str = ",") -> str:
    """A number with so many decimals, thousands set apart and a true minus sign; or that it is unknown."""
    if not math.isfinite(value):
        return UNKNOWN
    rounded = round(value, decimals) + 0.0  # no negative zero
    return f"{rounded:,.{max(decimals, 0)}f}".replace(",", apart).replace("-", MINUS)


def _decimals(half: float) -> int:
    """Decimals that show two digits of it."""
    return min(1 - math.floor(math.log10(half)), _FINEST)


def steered_text(steered: Sequence[tuple[int, str]]) -> str:
    """That a run was changed while it was watched: so often, and first when; what else is said of it is its begin."""
    changes = f"{len(steered):,} change{'s' * (len(steered) != 1)}"
    return f"steered: {changes} on the way, the first at step {steered[0][0]:,}"
