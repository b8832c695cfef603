"""The same scenario, larger and slower: every length and time multiplied, speeds and numbers as they are."""

import copy

import numpy as np
import pytest

import shoal
from commands import shoal as command
from scenarios import scenario
from shoal.core.errors import ScenarioError
from shoal.run.simulation import Simulation
from shoal.strategies import CATALOGUE

BUILTIN = sorted(name for name, known in CATALOGUE.items() if known.builtin)
RICH = {
    "network.range": 6.0,
    "network.adaptive": {"fewest": 5, "most": 20, "patience": 10.0},
    "fleets.0.strategy": {"name": "encircle", "ring": 0.9},
    "fleets.0.mean_lifetime": 300.0,
    "fleets.0.max_acceleration": 2.0,
    "fleets.0.max_turn_rate": 90.0,
    "losses": [{"step": 100, "count": 3}],
    "disturbances": [{"kind": "current", "east": 0.2, "since": 4.0}],
    "targets.0.surface_time": 9.0,
    "targets.0.dive_time": 3.0,
}


class TestScaled:
    """By units: m and s grow, what is per second shrinks, the rest stays."""

    @pytest.mark.parametrize(
        ("path", "times"),
        [
            ("time_step", 8.0),
            ("area.height", 8.0),
            ("area.agent_margin", 8.0),
            ("network.range", 8.0),
            ("network.adaptive.patience", 8.0),
            ("fleets.0.mean_lifetime", 8.0),
            ("fleets.0.max_acceleration", 1 / 8),
            ("fleets.0.max_turn_rate", 1 / 8),
            ("fleets.0.strategy.ring", 8.0),
            ("strategy.delta", 8.0),
            ("targets.0.radius", 8.0),
            ("targets.0.dive_time", 8.0),
            ("disturbances.0.since", 8.0),
            ("steps", 1.0),
            ("strategy.inertia", 1.0),
            ("losses.0.step", 1.0),
            ("fleets.0.max_speed", 1.0),
            ("targets.0.speed", 1.0),
            ("targets.0.max_turn", 1.0),
            ("targets.0.waypoint_patience", 1.0),
            ("disturbances.0.east", 1.0),
        ],
    )
    def test_a_quantity_by_its_unit(self, path, times):
        small = scenario("oceans2020", copy.deepcopy(RICH))
        assert at(small.scaled(8), path) == times * at(small, path)

    def test_what_was_left_open_follows(self):
        large = scenario("oceans2020", copy.deepcopy(RICH)).scaled(8)
        assert "chase" in large.fleets[0].strategy.open
        assert large.fleets[0].strategy.params["chase"] == 72.0

    def test_to_a_size(self):
        assert scenario().scaled(to="3 km") == scenario().scaled(150)
        assert scenario().scaled(to=3000).area.width == 3000.0

    @pytest.mark.parametrize(
        ("asked", "problem"),
        [
            ({}, "a factor or a size"),
            ({"factor": 2, "to": 40}, "a factor or a size"),
            ({"factor": 0}, "factor: is 0"),
            ({"factor": "2"}, "factor: is '2'"),
            ({"factor": True}, "factor: is True"),
            ({"factor": float("nan")}, "factor: is nan"),
            ({"to": "5 kn"}, "is not a quantity in m"),
            ({"to": -3}, "size: is -3"),
            ({"to": [1]}, "size: is"),
            ({"factor": 1e200}, "1e\\+12"),
        ],
    )
    def test_what_is_no_size_is_refused(self, asked, problem):
        with pytest.raises(ScenarioError, match=problem):
            scenario().scaled(**asked)

    def test_a_place_on_earth_has_its_size(self):
        with pytest.raises(ScenarioError, match="has its size"):
            scenario("oceans2020", {"area.origin": [4.0, 52.0]}).scaled(2)

    def test_the_command_prints_it(self, tmp_path, capsys):
        code, out, _ = command(capsys, "scenario", "oceans2020", "--scale-to", "3 km")
        (tmp_path / "sea.toml").write_text(out)
        assert code == 0
        assert shoal.load(tmp_path / "sea.toml") == scenario().scaled(150)
        assert out.startswith("# Preset oceans2020 with all lengths and times 150 times as large")
        assert "# fleets    name, count" in out
        assert command(capsys, "scenario", "oceans2020", "--scale-to", "wide")[0] == 2


@pytest.mark.parametrize("strategy", BUILTIN)
def test_the_run_is_the_same_to_the_bit(strategy):
    """By a power of two, which no rounding sees: no strategy has a length or a time of its own."""
    small = scenario("oceans2020", {"strategy": strategy, "steps": 250})
    one, other = Simulation(small), Simulation(small.scaled(128))
    for each in (one, other):
        each.advance(250)
    agents = small.agents
    assert np.array_equal(other.swarm.x[:agents], 128 * one.swarm.x[:agents])
    assert np.array_equal(other.swarm.vy[:agents], one.swarm.vy[:agents])
    assert other.tally.on_target.sum() == one.tally.on_target.sum() > 0


def test_by_another_factor_it_is_the_same_but_for_rounding():
    small = scenario("oceans2020", {"steps": 20})
    one, other = Simulation(small), Simulation(small.scaled(150))
    for each in (one, other):
        each.advance(20)
    assert other.swarm.x[:50] == pytest.approx(150 * one.swarm.x[:50], rel=1e-9)


def at(part, path):
    """The value at a dotted path, of a strategy's parameter too."""
    for name in path.split("."):
        if name.isdigit():
            part = part[int(name)]
        else:
            part = part.params[name] if hasattr(part, "params") else getattr(part, name)
    return part
