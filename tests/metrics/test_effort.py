"""Distance travelled and the cube of the speed."""

import numpy as np
import pytest

from coasting import coasting
from scenarios import scenario
from shoal.metrics.effort import fleet_power
from shoal.metrics.summary import evaluate
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation

SLOW = [(0.5, 0.0), (0.0, 0.3), (0.0, 0.0)]
PLACES = [(-5.0, 0.0), (0.0, -5.0), (5.0, 5.0)]


def metric(name, simulation):
    return evaluate(name, simulation.tally, facts_of(simulation.scenario))[0]


class TestSteady:
    """At a constant speed v the power is v^3."""

    @pytest.fixture
    def simulation(self):
        simulation = coasting(PLACES, SLOW, makes=[(1, 1.0), (2, 1.0)], steps=40)
        simulation.advance(40)
        return simulation

    def test_distance_is_speed_times_time(self, simulation):
        assert simulation.tally.distance.sum(axis=0) == pytest.approx([0.5 * 4.0, 0.3 * 4.0, 0.0])

    def test_speed_and_power_are_means_over_agents(self, simulation):
        assert metric("speed", simulation) == pytest.approx((0.5 + 0.3) / 3)
        assert metric("power", simulation) == pytest.approx((0.5**3 + 0.3**3) / 3)

    def test_of_each_fleet(self, simulation):
        speed, power = fleet_power(simulation.tally, facts_of(simulation.scenario))
        assert speed == pytest.approx([0.5, 0.15])
        assert power == pytest.approx([0.5**3, 0.3**3 / 2])


class TestRuns:
    """Of a real swarm."""

    def test_distance_is_the_length_of_the_tracks(self):
        simulation = Simulation(scenario())
        frames = simulation.advance(301, every=1)
        length = np.hypot(np.diff(frames.x, axis=0), np.diff(frames.y, axis=0)).sum(axis=0)
        simulation = Simulation(scenario())
        simulation.advance(300)
        assert simulation.tally.distance.sum(axis=0) == pytest.approx(length)

    def test_a_steady_swarm_uses_the_least_power_for_its_mean_speed(self):
        simulation = Simulation(scenario())
        simulation.advance(500)
        assert metric("power", simulation) >= metric("speed", simulation) ** 3

    def test_who_is_not_there_makes_no_way(self):
        """Nor is it asked to: time not there does not count."""
        changes = {"joins": [{"step": 50, "count": 20, "fleet": "BoB-0"}], "fleets.1.start": "corner"}
        simulation = Simulation(scenario("oceans2020", changes))
        simulation.advance(50)
        assert simulation.tally.distance[:, 50:].sum() == 0.0
        assert simulation.tally.agent_steps.sum() == 50 * 50
