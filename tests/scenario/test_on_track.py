"""A scenario on another scale: every length grows, nothing else."""

import pytest

from scenarios import scenario
from shoal.run.simulation import Simulation
from shoal.scenario.load import scenario_from
from shoal.scenario.scaled import multiplied

RICH = {
    "steps": 300,
    "network.range": 6.0,
    "fleets.0.strategy": {"name": "encircle", "ring": 0.95, "patience": 1.0},
    "fleets.0.sensor_radius": 0.5,
    "targets.0.radius": 1.5,
}


@pytest.fixture(scope="module")
def scaled():
    return multiplied(scenario("oceans2020", RICH), {"m": 4.0})


class TestLengths:
    """Lengths of the area, the radio, the fleets, the targets and every strategy."""

    @pytest.mark.parametrize(
        ("path", "value"),
        [
            ("area.width", 80.0),
            ("area.agent_margin", 6.0),
            ("network.range", 24.0),
            ("fleets.0.sensor_radius", 2.0),
            ("fleets.0.strategy.ring", 3.8),
            ("strategy.repulsion_max", 6.0),
            ("targets.0.radius", 6.0),
            ("targets.0.waypoint_reach", 6.0),
        ],
    )
    def test_lengths_grow(self, scaled, path, value):
        assert at(scaled, path) == pytest.approx(value)

    @pytest.mark.parametrize(
        "path", ["time_step", "fleets.0.max_speed", "fleets.0.strategy.patience", "targets.0.speed"]
    )
    def test_other_quantities_stay(self, scaled, path):
        assert at(scaled, path) == at(scenario("oceans2020", RICH).model_dump(mode="json"), path)

    def test_what_there_is_none_of_stays_none(self):
        assert multiplied(scenario(), {"m": 4.0})["network"]["range"] is None

    def test_with_speeds_in_step_a_run_is_the_same(self):
        """No length was forgotten; what is left open follows by itself."""
        table = multiplied(scenario("oceans2020", RICH), {"m": 4.0})
        for part in (*table["fleets"], *table["targets"]):
            for name in ("max_speed", "speed"):
                if name in part:
                    part[name] *= 4.0
        small, large = Simulation(scenario("oceans2020", RICH)), Simulation(scenario_from(table))
        small.advance(30)
        large.advance(30)
        assert large.swarm.x[:50] == pytest.approx(4.0 * small.swarm.x[:50], abs=1e-3)
        assert (small.tally.on_target == large.tally.on_target).all()


def at(table, path):
    """The value at a dotted path."""
    for part in path.split("."):
        table = table[int(part)] if isinstance(table, list) else table[part]
    return table
