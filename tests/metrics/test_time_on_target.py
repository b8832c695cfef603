"""Share of the steps with at least one agent on target."""

import math

import numpy as np
import pytest

from coasting import coasting
from shoal.metrics.summary import evaluate
from shoal.run.facts import facts_of

STAY = [(0, 0), (0, 0), (0, 0)]


def measured(name, simulation, steps=20):
    simulation.advance(steps - simulation.number)
    return evaluate(name, simulation.tally, facts_of(simulation.scenario))


class TestOnTarget:
    """Within the target's radius plus one's own sensor radius."""

    @pytest.mark.parametrize(("distance", "share"), [(0.0, 1.0), (1.0, 1.0), (1.0 + 1e-12, 0.0), (5.0, 0.0)])
    def test_up_to_and_at_the_radius(self, distance, share):
        assert measured("time_on_target", coasting([(distance, 0), (9, 9), (9, -9)], STAY))[0] == share

    @pytest.mark.parametrize(("distance", "share"), [(1.75, 1.0), (1.76, 0.0)])
    def test_the_sensor_radius_adds(self, distance, share):
        simulation = coasting([(0, distance), (9, 9), (9, -9)], STAY, **{"fleets.0.sensor_radius": 0.75})
        assert measured("time_on_target", simulation)[0] == share

    def test_any_of_several_targets(self):
        simulation = coasting([(5, 0), (9, 9), (9, -9)], STAY, targets=[(0, 0), (5.5, 0)])
        assert measured("time_on_target", simulation)[0] == 1.0

    def test_two_on_target_count_once_in_time_and_twice_in_engaged(self):
        simulation = coasting([(0, 0.5), (0.5, 0), (9, -9)], STAY)
        assert measured("time_on_target", simulation)[0] == 1.0
        assert measured("engaged", simulation)[0] == 2.0

    def test_an_agent_on_two_targets_counts_once(self):
        simulation = coasting([(0, 0), (9, 9), (9, -9)], STAY, targets=[(0.5, 0), (-0.5, 0)])
        assert measured("engaged", simulation)[0] == 1.0


class TestTime:
    """The share of steps, seen at their start."""

    def test_of_an_agent_that_crosses_the_target(self):
        """From x = -1.05 at 0.1 m a step: on target at steps 1 to 20 of 1 m radius, so 19 of 20 steps."""
        simulation = coasting([(-1.05, 0), (9, 9), (9, -9)], [(1, 0), (0, 0), (0, 0)])
        mean, batches = measured("time_on_target", simulation)
        assert mean == 19 / 20
        assert batches.tolist() == [0.0] + [1.0] * 19

    def test_steps_without_a_target_do_not_count(self):
        simulation = coasting([(0, 0), (9, 9), (9, -9)], STAY)
        simulation.advance(5)
        with simulation.edit() as now:
            now.targets["present"] = 0
        assert measured("time_on_target", simulation)[0] == 1.0
        assert measured("target_present", simulation)[0] == 0.25
        assert simulation.tally.engaged.sum() == 5

    def test_is_no_number_where_no_target_ever_was(self):
        simulation = coasting([(0, 0), (9, 9), (9, -9)], STAY)
        with simulation.edit() as now:
            now.targets["present"] = 0
        for name in ("time_on_target", "engaged", "stationary"):
            mean, batches = measured(name, simulation)
            assert math.isnan(mean)
            assert np.isnan(batches).all()
        assert measured("target_present", simulation)[0] == 0.0
