"""Estimates in words, the same in a terminal and in a notebook."""

import math
from collections.abc import Sequence

from shoal.record.statistics import Estimate


def mean_text(value: Estimate) -> str:
    """Mean: four decimals, one of large numbers; none where there is none."""
    return f"{value.mean:.{decimals_of(value.mean)}f}" if math.isfinite(value.mean) else "none"


def interval_text(value: Estimate) -> str:
    """Ends of the 95 % interval, or a dash."""
    return " .. ".join(f"{end:.{decimals_of(value.mean)}f}" for end in value.ci95) if value.ci95 else "-"


def spread_text(mean: float, low: float | None, high: float | None, decimals: int) -> str:
    """An interval after its mean: half its width, or its ends where a bound makes it lopsided; or nothing.

    Lopsided: one side is longer than the other by more than a tenth of both.
    """
    if low is None or high is None:
        return ""
    if abs(low + high - 2 * mean) > 0.1 * (high - low):
        return f" [{low:.{decimals}f}, {high:.{decimals}f}]"
    return f" ± {(high - low) / 2:.{decimals}f}"


def decimals_of(mean: float) -> int:
    """How many decimals a mean and its interval are told with: four, one of large numbers."""
    return 4 if not abs(mean) >= 100 else 1


def steered_text(steered: Sequence[tuple[int, str]]) -> str:
    """That a run was changed while it was watched: so often, and first when; what else is said of it is its begin."""
    changes = f"{len(steered):,} change{'s' * (len(steered) != 1)}"
    return f"steered: {changes} on the way, the first at step {steered[0][0]:,}"
