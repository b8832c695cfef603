"""Estimates in words."""

import pytest

from shoal.record.statistics import Estimate
from shoal.record.words import interval_text, spread_text


@pytest.mark.parametrize(
    ("mean", "low", "high", "text"),
    [
        (0.832, 0.829, 0.835, " ± 0.003"),
        (0.99, 0.955, 0.998, " [0.955, 0.998]"),  # 0.99 ± 0.02 would leave what is possible
        (0.01, 0.0, 0.07, " [0.000, 0.070]"),
        (1.0, None, None, ""),
    ],
)
def test_an_interval_is_told_by_half_or_by_its_ends(mean, low, high, text):
    assert spread_text(mean, low, high, 3) == text


def test_no_interval_is_a_dash():
    assert interval_text(Estimate(1.0, None, (1.0, 1.0))) == "-"
