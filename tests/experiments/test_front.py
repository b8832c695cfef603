"""The front, its area, and what is beyond doubt."""

import numpy as np
import pytest

from shoal.experiments.front import Spread, dominated_for_sure, front, gains, hypervolume

NAN = float("nan")
LESS, MORE = [1, 2, 3, 4, 2], [1.0, 3.0, 2.0, 4.0, NAN]


def exactly(value):
    return Spread(value, value, value)


class TestFront:
    def test_is_what_nothing_beats_cheapest_first(self):
        assert front(LESS, MORE) == [0, 1, 3]

    def test_has_equal_points_once(self):
        assert front([1, 1, 2], [5, 5, 5]) == [0]


class TestHypervolume:
    def test_is_the_area_below_the_steps(self):
        assert hypervolume(LESS, MORE, (5, 0)) == 1 * 4 + 2 * 3 + 1 * 1  # widths of heights 1, +2, +1

    def test_of_points_beyond_the_reference_is_nothing(self):
        assert hypervolume([6, 1], [9.0, -1.0], (5, 0)) == 0

    def test_grows_by_what_a_point_gains(self):
        rng = np.random.default_rng(3)
        costs, values = rng.uniform(0, 5, 30), rng.uniform(0, 4, 30)
        more_costs, more_values = rng.uniform(0, 5, 20), rng.uniform(0, 5, 20)
        known = hypervolume(costs, values, (5, 0))
        grown = [
            hypervolume([*costs, cost], [*values, value], (5, 0)) - known
            for cost, value in zip(more_costs, more_values, strict=True)
        ]
        assert gains(more_costs, more_values, (costs, values), 5) == pytest.approx(grown)


class TestDominatedForSure:
    def test_needs_intervals_that_do_not_overlap(self):
        low, near, far = Spread(0.5, 0.4, 0.6), Spread(0.65, 0.55, 0.75), Spread(0.8, 0.7, 0.9)
        assert dominated_for_sure([exactly(9)] * 3, [low, near, far]) == [2, None, None]

    def test_needs_a_cost_that_is_no_higher(self):
        values = [Spread(0.5, 0.4, 0.6), Spread(0.8, 0.7, 0.9)]
        assert dominated_for_sure([exactly(1), exactly(2)], values) == [None, None]
        assert dominated_for_sure([exactly(2), exactly(2)], values) == [1, None]
        assert dominated_for_sure([Spread(2, 1, 3), Spread(2, 1, 3)], values) == [None, None]

    def test_is_never_said_of_an_interval_that_is_not_known(self):
        values = [Spread(0.1, NAN, NAN), Spread(0.8, 0.7, 0.9)]
        assert dominated_for_sure([exactly(2), exactly(1)], values) == [None, None]

    def test_is_not_said_of_equals(self):
        assert dominated_for_sure([exactly(1)] * 2, [exactly(0.5)] * 2) == [None, None]
