"""How cases add up to a verdict."""

import math

import numpy as np
import pytest

from shoal.paper.cases import Case, counted, positive, rising, told, verdict_of, within, worst
from shoal.paper.curves import Interval


def cases(*truths):
    return [Case(str(number), Interval(number, number - 1, number + 1), true) for number, true in enumerate(truths)]


@pytest.mark.parametrize(
    ("truths", "verdict"),
    [
        ([True, True], "holds"),
        ([True, False], "holds partly"),
        ([True, None], "holds partly"),
        ([True, None, None], "undecided"),
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


def test_the_worst_case_is_the_lowest_or_the_furthest_from_the_aim():
    assert worst(cases(True, True, True)).name == "0"
    assert worst(cases(True, True, True), aim=0.5).name == "2"
    assert math.isnan(worst([]).number.value)


def test_words():
    assert counted(cases(True, True, None, False)) == "true in 2 of 4 cases, false in 1"
    assert told(Case("k = 2", Interval(1.25, 1.0, 1.5), True), " %") == "1.2 [1.0, 1.5] % (k = 2)"
    assert told(Case("k = 2", Interval(1.25, math.nan, math.nan), None)) == "1.2 (k = 2)"
