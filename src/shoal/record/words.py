"""Estimates in words, the same in a terminal and in a notebook."""

import math

from shoal.record.statistics import Estimate


def mean_text(value: Estimate) -> str:
    """Mean: four decimals, one of large numbers; none where there is none."""
    return f"{value.mean:.{_decimals(value)}f}" if math.isfinite(value.mean) else "none"


def interval_text(value: Estimate) -> str:
    """Ends of the 95 % interval, or a dash."""
    return " .. ".join(f"{end:.{_decimals(value)}f}" for end in value.ci95) if value.ci95 else "-"


def _decimals(value: Estimate) -> int:
    return 4 if not abs(value.mean) >= 100 else 1
