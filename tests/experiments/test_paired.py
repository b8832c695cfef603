"""Differences of paired runs, and their correction for many comparisons."""

import math

import numpy as np
import pytest

from shoal.experiments.paired import holm, paired_difference
from shoal.metrics.summary import Bounds

stats = pytest.importorskip("scipy.stats", reason="scipy is not installed")


class TestPairedDifference:
    """Student's t over the differences of runs with the same seed."""

    def test_three_pairs_agree_with_the_closed_form_of_two_degrees_of_freedom(self):
        found = paired_difference([2.0, 4.0, 6.0], [1.0, 2.0, 3.0])
        t = 2 * math.sqrt(3)
        assert found.mean == pytest.approx(2.0)
        assert found.p == pytest.approx(1 - t / math.sqrt(t * t + 2))
        assert found.ci95 == pytest.approx((2 - 4.303 / math.sqrt(3), 2 + 4.303 / math.sqrt(3)))
        assert found.pairs == 3

    def test_it_is_the_paired_t_test_of_scipy(self):
        one, other = np.random.default_rng(5).normal(size=(2, 20))
        found, known = paired_difference(one, other), stats.ttest_rel(one, other)
        assert found.p == pytest.approx(known.pvalue)
        assert found.ci95 == pytest.approx(tuple(known.confidence_interval(0.95)), rel=1e-3)

    def test_what_both_share_cancels(self):
        shared = np.random.default_rng(6).normal(size=12)
        other = shared + np.random.default_rng(7).normal(0.5, 0.01, 12)
        low, high = paired_difference(other, shared).ci95
        assert 0.48 < low < 0.5 < high < 0.52

    def test_swapping_flips_signs_and_keeps_p(self):
        one, other = np.random.default_rng(7).normal(size=(2, 9))
        there, back = paired_difference(one, other), paired_difference(other, one)
        assert there.mean == -back.mean
        assert there.ci95 == (-back.ci95[1], -back.ci95[0])
        assert there.p == back.p

    def test_identical_values_differ_by_exactly_nothing(self):
        assert paired_difference([0.1, 0.7, 0.3], [0.1, 0.7, 0.3]) == (0.0, None, 1.0, 3)

    @pytest.mark.parametrize(("pairs", "p"), [(2, 0.5), (5, 0.0625), (6, 0.03125), (20, 2.0**-19)])
    def test_a_constant_difference_is_as_sure_as_so_many_equal_signs(self, pairs, p):
        values = np.arange(float(pairs))
        assert paired_difference(values + 0.1, values) == (pytest.approx(0.1), None, p, pairs)

    def test_a_difference_of_shares_is_between_minus_one_and_one(self):
        assert paired_difference([0.9, 0.1], [0.2, 0.3], Bounds(0.0, 1.0)).ci95 == (-1.0, 1.0)

    def test_a_run_that_one_of_them_lacks_is_left_out_of_both(self):
        lacking = paired_difference([1.0, math.nan, 3.0, 9.0], [0.5, 7.0, 1.0, math.nan])
        assert lacking == paired_difference([1.0, 3.0], [0.5, 1.0])
        assert lacking.pairs == 2

    def test_one_pair_gives_a_difference_without_an_interval(self):
        assert paired_difference([3.0], [1.0]) == (2.0, None, None, 1)

    def test_no_pair_gives_nothing(self):
        found = paired_difference([math.nan], [1.0])
        assert math.isnan(found.mean)
        assert found[1:] == (None, None, 0)


class TestHolm:
    """The smallest p counts all comparisons, the next one fewer, and so on."""

    def test_the_textbook_example_of_four(self):
        assert holm([0.01, 0.04, 0.03, 0.005]) == pytest.approx([0.03, 0.06, 0.06, 0.02])

    def test_one_comparison_needs_no_correction(self):
        assert holm([0.04]) == [0.04]

    def test_no_adjusted_p_is_above_one(self):
        assert holm([0.6, 0.9, 0.7]) == [1.0, 1.0, 1.0]

    def test_order_is_kept_whatever_the_order_is(self):
        values = np.random.default_rng(8).random(30).tolist()
        mixed = np.random.default_rng(9).permutation(30)
        assert holm([values[i] for i in mixed]) == [holm(values)[i] for i in mixed]

    def test_a_p_that_cannot_be_told_stays_so_and_does_not_count(self):
        assert holm([0.02, None, 0.03]) == [0.04, None, 0.04]

    def test_it_never_corrects_more_than_bonferroni_nor_less_than_not_at_all(self):
        values = np.random.default_rng(10).random(12) ** 3
        adjusted = np.array(holm(values.tolist()))
        assert (adjusted <= np.minimum(1.0, 12 * values) + 1e-15).all()
        assert (adjusted >= values).all()
