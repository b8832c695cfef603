"""Sum of |v_i - mean v|, v at the start of the step, from which Xi and the response are made."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from coasting import coasting
from shoal.metrics.summary import evaluate
from shoal.metrics.velocity_fluctuation import fleet_fluctuation
from shoal.run.facts import facts_of

RING = [(5 * math.cos(a), 5 * math.sin(a)) for a in np.arange(8) * math.pi / 4]


def after_one_step(velocities, **options):
    simulation = coasting(RING[: len(velocities)], velocities, **options)
    simulation.advance(1)
    return simulation


class TestFluctuation:
    """Of a known velocity field."""

    def test_of_a_formation_is_nothing(self):
        assert after_one_step([(0.3, -0.4)] * 8).tally.fluctuation.sum() == pytest.approx(0.0, abs=1e-14)

    def test_of_two_head_on(self):
        assert after_one_step([(0.5, 0.0), (-0.5, 0.0)]).tally.fluctuation.sum() == pytest.approx(1.0)

    def test_of_eight_outward(self):
        """The mean is zero, so each adds its speed."""
        outward = 0.1 * np.array(RING)
        assert after_one_step(outward).tally.fluctuation.sum() == pytest.approx(8 * 0.5)

    def test_of_three_by_hand(self):
        velocities = [(0.3, 0.0), (0.0, 0.3), (0.0, 0.0)]
        expected = 0.1 * (2 * math.sqrt(5) + math.sqrt(2))
        assert after_one_step(velocities).tally.fluctuation.sum() == pytest.approx(expected)

    def test_is_taken_before_the_move(self):
        """At its start a step's velocities may exceed the cap; it is they that count."""
        assert after_one_step([(7.0, 0.0), (-7.0, 0.0)]).tally.fluctuation.sum() == pytest.approx(14.0)

    def test_by_fleet_around_the_mean_of_all(self):
        simulation = after_one_step([(0.9, 0.0), (0.0, 0.0), (0.0, 0.0)], makes=[(1, 1.0), (2, 1.0)])
        assert simulation.tally.fluctuation.sum(axis=0) == pytest.approx([0.6, 0.6])
        assert fleet_fluctuation(simulation.tally, facts_of(simulation.scenario)) == pytest.approx([0.6, 0.3])

    @given(velocities=npst.arrays(float, (8, 2), elements=st.floats(-1, 1)))
    @settings(max_examples=30)
    def test_of_any_field(self, velocities):
        expected = np.hypot(*(velocities - velocities.mean(axis=0)).T).sum()
        assert after_one_step(velocities).tally.fluctuation.sum() == pytest.approx(expected, abs=1e-13)

    def test_does_not_mind_whether_a_target_is_there(self):
        simulation = coasting(RING[:2], [(0.5, 0.0), (-0.5, 0.0)])
        with simulation.edit() as now:
            now.targets["present"] = 0
        simulation.advance(1)
        assert simulation.tally.fluctuation.sum() == pytest.approx(1.0)


class TestXi:
    """Eqs. 5-7: the mean over agents, over the mean top speed."""

    def measured(self, name, **options):
        velocities = [(0.5, 0.0), (-0.5, 0.0), (0.5, 0.0), (-0.5, 0.0)]
        simulation = after_one_step(velocities, **options)
        return evaluate(name, simulation.tally, facts_of(simulation.scenario))[0]

    def test_of_four_head_on(self):
        assert self.measured("xi") == pytest.approx(0.5)
        assert self.measured("xi_raw") == pytest.approx(0.5)

    def test_is_over_the_mean_top_speed(self):
        assert self.measured("xi", makes=[(1, 2.6), (3, 1.0)]) == pytest.approx(0.5 / ((2.6 + 3 * 1.0) / 4))
        assert self.measured("xi_raw", makes=[(1, 2.6), (3, 1.0)]) == pytest.approx(0.5)

    def test_the_response_is_the_sum_in_arena_units_per_step(self):
        assert self.measured("response") == pytest.approx(4 * 0.5 * 0.1)
        assert self.measured("response", **{"area.width": 40.0}) == pytest.approx(4 * 0.5 * 0.1 / 2)
