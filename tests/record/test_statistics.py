"""A mean and an interval that holds what it promises."""

import math
from itertools import pairwise

import numpy as np
import pytest

from shoal.record.statistics import Estimate, estimate, t_quantile

TABLE = {1: 12.706, 2: 4.303, 5: 2.571, 10: 2.228, 30: 2.042, 40: 2.021, 60: 2.000, 120: 1.980, 10**6: 1.960}
REPEATS = 4000


def coverage(samples, truth, over_runs=True):
    """Share of the intervals that hold the truth."""
    held = 0
    for sample in samples:
        low, high = (estimate(sample) if over_runs else estimate([sample.mean()], sample)).ci95
        held += low <= truth <= high
    return held / len(samples)


class TestQuantile:
    """97.5 % of Student's t."""

    @pytest.mark.parametrize(("degrees", "value"), TABLE.items())
    def test_is_the_printed_table(self, degrees, value):
        assert t_quantile(degrees) == pytest.approx(value, abs=6e-4)

    @pytest.mark.parametrize("degrees", [*range(1, 80), 100, 1000, 10**5])
    def test_is_scipys(self, degrees):
        stats = pytest.importorskip("scipy.stats")
        assert t_quantile(degrees) == pytest.approx(stats.t.ppf(0.975, degrees), rel=4e-4)

    def test_falls_with_every_degree_down_to_the_normal_one(self):
        quantiles = [t_quantile(degrees) for degrees in range(1, 3000)]
        assert all(later <= earlier for earlier, later in pairwise(quantiles))
        assert quantiles[-1] > 1.959964


class TestEstimate:
    """By hand."""

    def test_of_two_runs(self):
        """Mean 2, deviation sqrt(2), so +- 12.706 sqrt(2) / sqrt(2)."""
        result = estimate([1.0, 3.0])
        assert result.mean == 2.0
        assert result.ci95 == pytest.approx((2.0 - 12.706, 2.0 + 12.706))
        assert result.runs == (1.0, 3.0)

    def test_of_one_run_is_over_its_batches(self):
        assert estimate([2.0], [1.0, 3.0]) == Estimate(2.0, pytest.approx((2.0 - 12.706, 2.0 + 12.706)), (2.0,))

    def test_of_many_runs_does_not_look_at_batches(self):
        assert estimate([1.0, 2.0, 3.0], [100.0, -100.0]) == estimate([1.0, 2.0, 3.0])

    @pytest.mark.parametrize("batches", [None, [], [5.0], [math.nan, 5.0], [math.nan, math.nan]])
    def test_of_too_little_has_no_interval(self, batches):
        assert estimate([5.0], batches) == Estimate(5.0, None, (5.0,))

    def test_batches_without_a_number_are_left_out(self):
        assert estimate([2.0], [1.0, math.nan, 3.0]).ci95 == estimate([2.0], [1.0, 3.0]).ci95

    def test_of_runs_without_a_number_is_none(self):
        result = estimate([math.nan, 1.0])
        assert math.isnan(result.mean)
        assert result.ci95 is None

    def test_of_equal_runs_has_no_width(self):
        assert estimate([0.5] * 5).ci95 == (0.5, 0.5)


class TestCoverage:
    """95 of 100 intervals hold the truth."""

    @pytest.mark.parametrize("runs", [2, 3, 5, 20, 40])
    def test_over_replicates(self, runs):
        samples = np.random.default_rng(runs).normal(0.7, 0.1, (REPEATS, runs))
        assert coverage(samples, 0.7) == pytest.approx(0.95, abs=0.012)

    def test_over_independent_batches(self):
        samples = np.random.default_rng(0).normal(0.7, 0.1, (REPEATS, 20))
        assert coverage(samples, 0.7, over_runs=False) == pytest.approx(0.95, abs=0.012)

    def test_over_batches_long_against_the_memory_of_the_process(self):
        """x <- 0.9 x + noise remembers some 10 steps; 20 batches of 500."""
        rng = np.random.default_rng(1)
        noise = rng.normal(size=(10_000, 400))
        x, batches = rng.normal(size=400) / math.sqrt(1 - 0.81), np.zeros((20, 400))
        for t in range(10_000):
            x = 0.9 * x + noise[t]
            batches[t // 500] += x / 500
        assert coverage(batches.T, 0.0, over_runs=False) == pytest.approx(0.95, abs=0.035)

    def test_of_shares_of_steps(self):
        """Time on target is a share: 5 runs of 2000 steps with probability 0.8."""
        samples = np.random.default_rng(2).binomial(2000, 0.8, (REPEATS, 5)) / 2000
        assert coverage(samples, 0.8) == pytest.approx(0.95, abs=0.012)
