"""Curves pair seed by seed; intervals contain the truth; peaks are found where they are."""

import math

import numpy as np
import pytest

from paper_rows import KS, hill, made
from shoal.paper.curves import (
    RunCurve,
    bootstrap,
    cells,
    curve,
    heading_nowhere,
    heading_there,
    intervals,
    peak,
    peak_difference,
    slopes,
)


def noisy(truth, seeds=5, noise=0.003, seed=1, x=KS):
    x = np.array(x, float)
    mean = np.array([truth(k) for k in x])
    return RunCurve(x, mean + noise * np.random.default_rng(seed).normal(size=(seeds, x.size)))


class TestCurve:
    def test_it_holds_the_metric_of_the_rows_that_match_in_order_of_x(self):
        rows = made({"xi": lambda fast, k, speed: k + 100 * fast + speed}, noise=0.0)[::-1]
        found = curve(rows, "xi", fast=15, target_speed=5.0)
        assert found.x.tolist() == list(KS)
        assert np.array_equal(found.runs, np.tile(np.array(KS) + 1505.0, (5, 1)))

    def test_a_metric_can_be_made_of_a_row(self):
        rows = made({}, points=[(0, 10, 3.0)])
        assert curve(rows, heading_there).at(10) == pytest.approx([3.0] * 5, abs=0.003)
        assert curve(rows, heading_nowhere).at(10) == pytest.approx([4.0] * 5)

    def test_failed_runs_take_their_seed_out_so_that_columns_pair(self):
        rows = made({"xi": lambda fast, k, speed: k}, points=[(0, 10, 3.0), (0, 20, 3.0)], noise=0.0)
        rows[1] |= {"status": "failed", "xi": None}  # seed 1 at k = 10
        assert curve(rows, "xi").runs.shape == (4, 2)

    def test_no_rows_are_an_empty_curve(self):
        empty = curve([], "xi")
        assert empty.x.size == 0
        assert empty.minus(empty).x.size == 0

    def test_differences_are_paired_at_the_places_that_both_have(self):
        one = RunCurve(np.array([1.0, 2.0, 3.0]), np.array([[1.0, 2.0, 3.0], [2.0, 3.0, 4.0]]))
        other = RunCurve(np.array([2.0, 3.0, 4.0]), np.array([[1.0, 1.0, 9.0], [1.0, 1.0, 9.0]]))
        difference = one.minus(other)
        assert difference.x.tolist() == [2.0, 3.0]
        assert difference.runs.tolist() == [[1.0, 2.0], [2.0, 3.0]]

    def test_there_is_no_value_at_a_place_it_does_not_have(self):
        with pytest.raises(KeyError):
            noisy(hill(20)).at(21)

    def test_cells_are_the_seeds_of_each_combination(self):
        found = cells(made({"xi": lambda fast, k, speed: k}, noise=0.0), "xi")
        assert len(found) == 4 * len(KS)
        assert all(values.size == 5 and np.ptp(values) == 0 for values in found)


class TestIntervals:
    def test_with_four_seeds_they_are_students_t_of_each_case(self):
        values = np.array([1.0, 2.0, 3.0, 4.0])
        half = 3.182 * np.std(values, ddof=1) / 2
        (known,) = intervals([values])
        assert known == pytest.approx((2.5, 2.5 - half, 2.5 + half))

    def test_with_two_seeds_the_spread_is_pooled_over_cases(self):
        cases = [np.array([0.0, 2.0]), np.array([10.0, 12.0])]  # each s^2 = 2, together 2 degrees of freedom
        assert intervals(cases)[1] == pytest.approx((11.0, 11.0 - 4.303, 11.0 + 4.303))

    def test_one_seed_tells_no_interval(self):
        (known,) = intervals([np.array([3.0])])
        assert known.value == 3.0
        assert math.isnan(known.low)

    @pytest.mark.parametrize("seeds", [2, 5])
    def test_nine_of_ten_or_more_contain_the_truth(self, seeds):
        values = np.random.default_rng(3).normal(size=(200, seeds))
        covered = [known.low <= 0.0 <= known.high for known in intervals(list(values))]
        assert np.mean(covered) > 0.9

    def test_the_slope_of_a_line_is_found_in_every_seed(self):
        x = np.array([0.0, 1.0, 4.0])
        assert slopes(RunCurve(x, np.array([2 * x + 1, 5 - x]))) == pytest.approx([2.0, -1.0])

    def test_a_bootstrap_of_one_value_tells_no_interval(self):
        assert math.isnan(bootstrap([2.0], np.median).low)
        assert math.isnan(bootstrap([], np.median).value)


class TestPeak:
    @pytest.mark.parametrize("top", [14.5, 18.0, 25.3])
    @pytest.mark.parametrize("seeds", [2, 5])
    def test_the_interval_contains_a_known_peak(self, top, seeds):
        found = peak(noisy(hill(top), seeds))
        assert found.place.low <= top <= found.place.high
        assert found.place.high - found.place.low < 6
        assert found.height.low <= 0.8 <= found.height.high
        assert not found.at_edge

    def test_without_noise_it_is_the_peak_itself(self):
        x = np.arange(2.0, 50.0)
        found = peak(RunCurve(x, np.tile(-((x - 20.4) ** 2) + 0.01 * (x - 20.4) ** 3, (3, 1))))
        assert found.place.value == pytest.approx(20.4, abs=0.03)
        assert 20.2 < found.place.low < 20.4 < found.place.high < 20.6
        assert found.height.value == pytest.approx(0.0, abs=1e-3)

    def test_a_flat_curve_can_peak_anywhere(self):
        found = peak(noisy(lambda k: 0.5))
        assert found.place.high - found.place.low > 20

    def test_a_rising_curve_peaks_at_its_edge(self):
        assert peak(noisy(lambda k: 0.01 * k)).at_edge

    def test_it_repeats_bit_by_bit(self):
        one, other = peak(noisy(hill(18))), peak(noisy(hill(18)))
        assert one.place == other.place
        assert np.array_equal(one.draws, other.draws)

    def test_one_seed_has_a_peak_but_no_interval(self):
        found = peak(noisy(hill(18), seeds=1))
        assert 14 < found.place.value < 22
        assert math.isnan(found.place.low)

    def test_three_points_have_no_peak(self):
        assert math.isnan(peak(noisy(hill(18), x=(10, 18, 26))).place.value)

    def test_peaks_of_equal_curves_differ_by_nothing(self):
        assert peak_difference(peak(noisy(hill(18))), peak(noisy(hill(18)))) == (0.0, 0.0, 0.0)

    def test_a_difference_of_peaks_contains_the_truth(self):
        difference = peak_difference(peak(noisy(hill(24), seed=1)), peak(noisy(hill(18), seed=2)))
        assert difference.low <= 6.0 <= difference.high
        assert difference.low > 0
