"""A mean and an interval that holds what it promises."""

import math
from itertools import pairwise

import numpy as np
import pytest

from shoal.metrics.summary import ANYTHING, Bounds
from shoal.record.statistics import Estimate, estimate, inside, t_quantile, two_sided

TABLE = {1: 12.706, 2: 4.303, 5: 2.571, 10: 2.228, 30: 2.042, 40: 2.021, 60: 2.000, 120: 1.980, 10**6: 1.960}
REPEATS = 4000
SHARE = Bounds(0.0, 1.0)


def coverage(samples, truth, over_runs=True, bounds=ANYTHING):
    """Share of the intervals that hold the truth, of those that are told."""
    each = ((sample, None) if over_runs else ([sample.mean()], sample) for sample in samples)
    told = [known.ci95 for values, batches in each if (known := estimate(values, batches, bounds)).ci95]
    return np.mean([low <= truth <= high for low, high in told])


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


class TestTwoSided:
    """Chance beyond t, on either side."""

    @pytest.mark.parametrize(("degrees", "t"), [(1, 12.706), (2, 4.303), (5, 2.571), (30, 2.042), (math.inf, 1.960)])
    def test_is_five_percent_at_the_quantile(self, degrees, t):
        assert two_sided(t, degrees) == two_sided(-t, degrees) == pytest.approx(0.05, abs=6e-5)

    @pytest.mark.parametrize("degrees", [1, 2, 3, 4, 7, 10, 19, 40, 165])
    def test_is_scipys(self, degrees):
        stats = pytest.importorskip("scipy.stats")
        for t in (0.0, 0.1, 1.0, 3.0, 10.0):
            assert two_sided(t, degrees) == pytest.approx(2 * stats.t.sf(t, degrees), abs=1e-14)


class TestEstimate:
    """By hand."""

    def test_of_two_runs(self):
        """Mean 2, deviation sqrt(2), so +- 12.706 sqrt(2) / sqrt(2)."""
        result = estimate([1.0, 3.0])
        assert result.mean == 2.0
        assert result.ci95 == pytest.approx((2.0 - 12.706, 2.0 + 12.706))
        assert result.runs == (1.0, 3.0)

    def test_of_one_run_is_over_its_batches(self):
        """Up to 13 batches none overlap: mean 2, deviation 1.2910 of 4 values, 3 degrees of freedom."""
        half = 3.182 * math.sqrt(5 / 3) / 2
        assert estimate([2.0], [0.5, 3.5, 1.5, 2.5]).ci95 == pytest.approx((2.0 - half, 2.0 + half))

    def test_of_twenty_batches_is_over_means_of_three_that_overlap(self):
        batches = np.random.default_rng(4).normal(size=20)
        threes = np.array([batches[at : at + 3].mean() for at in range(18)])
        variance = 3 * ((threes - batches.mean()) ** 2).sum() / (18 * (1 - 3 / 20)) / 20
        low, high = estimate([0.0], batches).ci95
        assert high == -low == pytest.approx(2.306 * math.sqrt(variance))

    def test_of_many_runs_does_not_look_at_batches(self):
        assert estimate([1.0, 2.0, 3.0], [100.0, -100.0]) == estimate([1.0, 2.0, 3.0])

    @pytest.mark.parametrize("batches", [None, [], [5.0], [4.0, 5.0, 6.0], [math.nan] * 9])
    def test_of_too_little_has_no_interval(self, batches):
        assert estimate([5.0], batches) == Estimate(5.0, None, (5.0,))

    def test_batches_without_a_number_are_left_out(self):
        some = [1.0, math.nan, 3.0, 2.5, 0.5]
        assert estimate([2.0], some).ci95 == estimate([2.0], [1.0, 3.0, 2.5, 0.5]).ci95

    def test_of_runs_without_a_number_is_none(self):
        result = estimate([math.nan, 1.0])
        assert math.isnan(result.mean)
        assert result.ci95 is None

    @pytest.mark.parametrize("value", [0.0, 0.5, 1.0, 200.0])
    def test_equal_runs_do_not_tell_how_rare_others_are(self, value):
        assert estimate([value] * 5).ci95 is None
        assert estimate([value], [value] * 20).ci95 is None
        assert estimate([value, value * (1 + 1e-15)]).ci95 is None

    def test_a_run_that_goes_on_as_it_began_is_too_short(self):
        assert estimate([5.0], np.arange(20.0)).ci95 is None
        slow = np.sin(np.arange(20) / 3)
        assert estimate([0.0], slow).ci95 is None


class TestBounds:
    """An interval stays inside what is possible, and keeps to the mean where bounds are far."""

    @pytest.mark.parametrize("runs", [[0.02, 0.9], [0.001, 0.4, 0.0], [1.0, 1.0, 0.98], [0.5, 0.500001], [0.0, 1.0]])
    def test_a_share_is_between_zero_and_one(self, runs):
        low, high = estimate(runs, bounds=SHARE).ci95
        assert 0.0 <= low < np.mean(runs) < high <= 1.0

    @pytest.mark.parametrize("runs", [[0.3, 2.6], [0.0, 0.0, 5.0], [1e-9, 1.0], [1e6, 3.0]])
    def test_a_time_is_not_negative_and_finite(self, runs):
        low, high = estimate(runs, bounds=Bounds(0.0)).ci95
        assert 0.0 <= low < np.mean(runs) < high < 400 * np.mean(runs)

    def test_engaged_agents_are_at_most_all(self):
        low, high = estimate([1.0, 49.0], bounds=Bounds(0.0, 50.0)).ci95
        assert 0.0 <= low < 1.0
        assert 49.0 < high <= 50.0

    @pytest.mark.parametrize("bounds", [SHARE, Bounds(0.0), Bounds(-3.0, 8.0)])
    def test_far_from_bounds_it_is_students_t(self, bounds):
        runs = [0.5, 0.5001, 0.4999, 0.5002]
        assert estimate(runs, bounds=bounds).ci95 == pytest.approx(estimate(runs).ci95, abs=1e-7)

    def test_a_share_and_its_complement_have_mirrored_intervals(self):
        low, high = estimate([0.8, 0.9, 0.97], bounds=SHARE).ci95
        assert estimate([0.2, 0.1, 0.03], bounds=SHARE).ci95 == pytest.approx((1 - high, 1 - low))

    def test_a_mean_at_or_beyond_a_bound_is_cut_there(self):
        assert inside(1.0, 0.2, SHARE) == (0.8, 1.0)
        assert inside(0.0, 0.2, Bounds(0.0)) == (0.0, 0.2)


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

    @pytest.mark.parametrize("memory", [-0.2, 0.2])
    def test_over_batches_that_are_correlated(self, memory):
        """Batch b is `memory` times the one before and noise."""
        rng = np.random.default_rng(3)
        values = rng.normal(size=(REPEATS, 1)) / math.sqrt(1 - memory**2)
        for _ in range(19):
            values = np.hstack([values, memory * values[:, -1:] + rng.normal(size=(REPEATS, 1))])
        assert coverage(values, 0.0, over_runs=False) == pytest.approx(0.95, abs=0.04)

    @pytest.mark.parametrize("runs", [3, 5, 20])
    @pytest.mark.parametrize(("a", "b"), [(9, 1), (0.3, 0.3), (50, 1)])
    def test_of_shares_near_a_bound(self, runs, a, b):
        samples = np.random.default_rng(5).beta(a, b, (REPEATS, runs))
        assert coverage(samples, a / (a + b), bounds=SHARE) == pytest.approx(0.95, abs=0.025)

    @pytest.mark.parametrize("runs", [2, 3, 5, 20])
    def test_of_times_that_are_exponential(self, runs):
        """Student's t, which knows no bound, covers 88 % of five."""
        samples = np.random.default_rng(6).exponential(2.0, (REPEATS, runs))
        assert coverage(samples, 2.0, bounds=Bounds(0.0)) == pytest.approx(0.95, abs=0.03)
