"""How cases add up to a verdict."""

import math

import numpy as np
import pytest

from shoal.paper.cases import (
    ABOUT,
    WHOLE,
    Case,
    about,
    case_text,
    count,
    judge,
    judged,
    percent,
    positive,
    rising,
    verdict_of,
    within,
    worst,
)
from shoal.paper.curves import Interval


def cases(*truths):
    return [Case(str(number), Interval(number, number - 1, number + 1), true) for number, true in enumerate(truths)]


@pytest.mark.parametrize(
    ("truths", "verdict"),
    [
        ([True, True], "holds"),
        ([True, False], "holds partly"),
        ([True, None], "holds"),
        ([True] * 79 + [None] * 3, "holds"),
        ([True, None, None], "undecided"),
        ([True, False, None], "holds partly"),
        ([True, False, None, None, None], "undecided"),
        ([True, False, False], "does not hold"),
        ([False, None], "does not hold"),
        ([None, None], "undecided"),
        ([], "undecided"),
    ],
)
def test_verdict(truths, verdict):
    assert verdict_of(cases(*truths)) == verdict


def test_a_case_is_true_false_or_open_by_its_interval():
    assert positive(Interval(2, 1, 3)) is True
    assert positive(Interval(0, -1, 1)) is None
    assert positive(Interval(-2, -3, -1)) is False
    assert positive(Interval(2, math.nan, math.nan)) is None
    assert within(Interval(2, 1, 3), 0, 4) is True
    assert within(Interval(2, 1, 3), 2, 4) is None
    assert within(Interval(2, 1, 3), 4, 5) is False


def test_a_difference_is_judged_over_its_seeds():
    seeds = {"up": np.array([1.0, 1.1, 0.9, 1.0]), "no runs": np.zeros(0), "flat": np.array([1.0, -1.0, 1.0, -1.0])}
    assert [(case.name, case.true) for case in rising(seeds)] == [("up", True), ("flat", None)]


class TestPrecisionOfThePaper:
    """No verdict hangs on a digit that the paper does not tell."""

    def test_about_18_is_two_and_a_half_to_either_side_and_half_a_k(self):
        assert about(Interval(20.2, 19.9, 20.6), 18) is True
        assert about(Interval(21.0, 20.6, 21.4), 18) is None
        assert about(Interval(21.4, 21.1, 21.7), 18) is False
        assert ABOUT + WHOLE < 5  # tells 25 from 30

    def test_at_most_0_3_as_told_with_one_digit(self):
        assert within(Interval(0.29, 0.26, 0.34), 0.0, 0.3, slack=0.05) is True
        assert within(Interval(0.40, 0.36, 0.44), 0.0, 0.3, slack=0.05) is False


class TestManyCases:
    """Of many true cases some look false by chance: they count only if they are after Holm's correction."""

    def test_p_of_a_false_case_is_that_of_the_t_test(self):
        stats = pytest.importorskip("scipy.stats", reason="scipy is not installed")
        values = np.array([-1.0, -1.3, -0.7, -1.1, -0.6])
        (case,) = rising({"down": values})
        assert case.p == pytest.approx(stats.ttest_1samp(values, 0.0).pvalue, rel=5e-3)

    def test_p_is_1_where_a_case_is_not_false(self):
        assert judged("up", Interval(2, 1, 3), positive).p == 1.0
        assert judged("open", Interval(0, -1, 1), positive).p == 1.0

    def test_one_barely_false_among_82_leaves_the_claim_standing(self):
        barely = judged("barely", Interval(-1.0, -1.9, -0.1), positive, 4)
        alone, many = [barely], [barely, *cases(*[True] * 81)]
        assert (count(alone), verdict_of(alone)) == ((0, 0, 1), "does not hold")
        assert (count(many), verdict_of(many)) == ((81, 1, 0), "holds")

    def test_one_clearly_false_among_82_does_not(self):
        clearly = judged("clearly", Interval(-1.0, -1.05, -0.95), positive, 4)
        assert verdict_of([clearly, *cases(*[True] * 81)]) == "holds partly"

    def test_of_82_cases_without_any_effect_hardly_ever_one_is_false(self):
        rng, found = np.random.default_rng(5), []
        for _ in range(200):
            found.append(count(rising({str(k): rng.normal(size=5) for k in range(82)})).false > 0)
        assert np.mean(found) <= 0.05

    def test_percent_keeps_p(self):
        (case,) = percent(judge({"down": np.array([-1.0, -1.1, -0.9, -1.2])}, positive))
        assert (case.true, case.number.value) == (False, pytest.approx(-105.0))
        assert 0.0 < case.p < 0.001


def test_the_worst_case_is_the_lowest_or_the_furthest_from_the_aim():
    assert worst(cases(True, True, True)).name == "0"
    assert worst(cases(True, True, True), aim=0.5).name == "2"
    assert math.isnan(worst([]).number.value)


def test_words():
    assert str(count(cases(True, True, None, False))) == "2 true, 1 open, 1 false"
    assert case_text(Case("k = 2", Interval(1.25, 1.0, 1.5), True), " %") == "1.25 [1.00, 1.50] % (k = 2)"
    assert case_text(Case("k = 2", Interval(1.25, math.nan, math.nan), None)) == "1.25 (k = 2)"
