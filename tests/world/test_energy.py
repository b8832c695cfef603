"""What batteries give, and that an empty one is the end."""

import numpy as np
import pytest

from coasting import coasting
from scenarios import scenario
from shoal.metrics.summary import evaluate
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation
from shoal.world.energy import between, drawn

POINTS, VALUES = np.array([0.0, 1.0, 3.0, 3.0]), np.array([2.0, 4.0, 8.0, 8.0])  # the last one is padding


@pytest.mark.parametrize(
    ("at", "value"), [(-1.0, 2.0), (0.0, 2.0), (0.5, 3.0), (1.0, 4.0), (2.0, 6.0), (3.0, 8.0), (9.0, 8.0)]
)
def test_a_curve_is_straight_between_its_points(at, value):
    assert between(POINTS, VALUES, at) == value


def test_a_curve_of_one_point_is_flat():
    assert between(np.zeros(1), np.zeros(1), 2.0) == 0.0


def test_power_is_hotel_and_drag_and_curve():
    assert drawn(2.0, 5.0, 3.0, np.array([POINTS, VALUES])) == 5.0 + 3.0 * 8.0 + 6.0


def metric(name, simulation):
    return evaluate(name, simulation.tally, facts_of(simulation.scenario))[0]


class TestRun:
    """Three agents that coast at 0.5, 0.3 and 0 m/s, in steps of 0.1 s."""

    def simulation(self, capacity, steps=40):
        battery = {"capacity": capacity, "hotel": 2.0, "drag": 8.0}
        places, speeds = [(-5.0, 0.0), (0.0, -5.0), (5.0, 5.0)], [(0.5, 0.0), (0.0, 0.3), (0.0, 0.0)]
        simulation = coasting(places, speeds, steps=steps, **{"fleets.0.battery": battery})
        simulation.advance(steps)
        return simulation

    def test_what_is_spent_is_power_times_time(self):
        simulation = self.simulation(1000.0)
        power = np.array([2.0 + 8.0 * 0.125, 2.0 + 8.0 * 0.027, 2.0])
        assert simulation.swarm.spent[:3] == pytest.approx(4.0 * power)
        assert metric("energy", simulation) == pytest.approx(4.0 * power.mean() / 3600)
        assert metric("charge", simulation) == pytest.approx(1 - 4.0 * power.mean() / 1000)
        assert metric("least_charge", simulation) == pytest.approx(1 - 4.0 * power.max() / 1000)
        assert metric("first_empty", simulation) == pytest.approx(4.0)  # none is

    def test_an_empty_battery_is_the_end(self):
        """3 W empty 6.05 J within step 20: from the next on the first is gone, and stays where it is."""
        simulation = self.simulation(6.05)
        assert simulation.swarm.leaves[:3].tolist() == [21, 28, 31]
        assert simulation.swarm.x[0] == pytest.approx(-5.0 + 21 * 0.05)
        assert simulation.swarm.spent[0] == 6.05
        assert metric("first_empty", simulation) == pytest.approx(2.1)
        assert metric("least_charge", simulation) == 0.0

    def test_pieces_and_a_saved_state_change_nothing(self, tmp_path):
        changes = {"fleets.0.battery": {"capacity": "0.05 Wh"}, "fleets.0.position_error": 0.5, "network.interval": 0.7}
        whole, parts = (Simulation(scenario("oceans2020", changes)) for _ in range(2))
        whole.advance(60)
        parts.advance(11)
        parts.save(tmp_path / "state.npz")
        resumed = Simulation(scenario("oceans2020", changes))
        resumed.restore(tmp_path / "state.npz")
        resumed.look()
        resumed.advance(49)
        for name, array in whole.state().items():
            assert array.tobytes() == resumed.state()[name].tobytes(), name
        assert 0 < whole.swarm.alive[:50].sum() < 50
