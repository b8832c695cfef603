"""Defaults that follow the scenario: lengths of a bay in a bay, the paper's in the paper's arena."""

import copy
import pickle

import pytest

import shoal
from scenarios import fleets, scenario
from shoal.core.errors import StrategyError
from shoal.scenario.crew import crew_of
from shoal.scenario.load import scenario_from
from shoal.scenario.recorded import recorded_scenario
from shoal.scenario.scales import PAPER, scales_of
from shoal.scenario.strategy_choice import following
from shoal.strategies import CATALOGUE

BUILTIN = sorted(name for name, known in CATALOGUE.items() if known.builtin)
BAY = {
    "area.width": 3000.0,
    "area.height": 2000.0,
    "time_step": 1.0,
    "fleets": fleets((10, 4.0), (20, 1.0)),
    "network.neighbors": 10,
    "targets.0.radius": 5.0,
    "fleets.0.sensor_radius": 150.0,
    "fleets.1.sensor_radius": 150.0,
}
SPACING = (3000.0 * 2000.0 / 30) ** 0.5


def bay(strategy, **changes):
    return scenario("oceans2020", copy.deepcopy(BAY | {"strategy": strategy} | changes))


class TestScales:
    """Spacing, reach and step of a scenario."""

    def test_the_papers_are_those_that_defaults_are_said_for(self):
        assert scales_of(scenario()) == PAPER

    def test_of_a_bay(self):
        scales = scales_of(bay("knn-pso"))
        assert (scales.spacing, scales.reach, scales.step, scales.speed) == pytest.approx((SPACING, 155.0, 4.0, 4.0))

    def test_agents_that_reach_nothing_have_the_spacing_for_a_reach(self):
        assert scales_of(scenario("oceans2020", {"targets.0.radius": 0.0})).reach == PAPER.spacing

    def test_no_default_follows_what_no_buoy_knows(self):
        fast = bay("encircle", **{"targets.0.speed": 9.0})
        assert fast.strategy.params == bay("encircle").strategy.params


class TestDefaults:
    """What a scenario does not say follows it; what it says stays."""

    @pytest.mark.parametrize("name", BUILTIN)
    def test_in_the_papers_scenario_they_are_as_declared_to_the_bit(self, name):
        assert crew_of(scenario("oceans2020", {"strategy": name})).params == CATALOGUE[name].params()

    @pytest.mark.parametrize(
        ("strategy", "name", "value"),
        [
            ("knn-pso", "repulsion_max", 1.5 * SPACING / PAPER.spacing),
            ("knn-pso", "delta", 0.01 * 4.0 / 0.26),
            ("encircle", "ring", 0.95 * 155.0),
            ("encircle", "patience", 1.0 * (155.0 / 4.0) / (1.0 / 2.6)),
            ("random-walk", "persistence", 5.0 * (SPACING / 4.0) / (PAPER.spacing / 2.6)),
            ("charged-pso", "charge", 0.63 * ((SPACING / PAPER.spacing) ** 2 * (4.0 / 0.26)) ** (1 / 3)),
        ],
    )
    def test_in_a_bay_they_are_those_of_a_bay(self, strategy, name, value):
        assert bay(strategy).strategy.params[name] == pytest.approx(value, rel=1e-12)
        assert getattr(crew_of(bay(strategy)).params, name) == bay(strategy).strategy.params[name]

    def test_a_growth_in_a_step_follows_the_step(self):
        """Half the time-step: the same growth in a second."""
        fine = bay("knn-pso", time_step=0.5)
        assert fine.strategy.params["delta"] == bay("knn-pso").strategy.params["delta"] / 2
        assert fine.strategy.params["repulsion_max"] == bay("knn-pso").strategy.params["repulsion_max"]

    def test_they_follow_every_change_and_what_was_said_stays(self):
        said = bay({"name": "encircle", "chase": 77.0})
        many = said.with_(agents=120, **{"area.width": "6 km"})
        assert many.strategy.params["chase"] == 77.0
        assert many.strategy.params["ring"] == said.strategy.params["ring"]
        back = many.with_(strategy="lattice-pursuit")
        assert back.strategy.params["reach"] == pytest.approx(2.0 * (6000 * 2000 / 120) ** 0.5 / PAPER.spacing)

    def test_one_that_is_set_leaves_the_others_open(self):
        changed = bay("encircle").with_(**{"strategy.ring": "100 m"})
        assert changed.strategy.params["ring"] == 100.0
        assert set(changed.strategy.open) == {"chase", "spacing", "patience"}

    def test_those_of_a_fleets_own_strategy_follow_too(self):
        mixed = bay("knn-pso", **{"fleets.1.strategy": "encircle"})
        assert mixed.fleets[1].strategy.params["ring"] == pytest.approx(0.95 * 155.0)

    def test_they_stay_within_their_range(self):
        huge = scenario("oceans2020", {"area.width": 1e12, "area.height": 1e12, "strategy": "levy-walk"})
        assert huge.strategy.params["longest"] == 1e12


class TestWhatIsSaid:
    """Files, hashes, records and other processes know what was left open."""

    def test_a_file_leaves_it_open_and_says_what_it_is(self):
        text = shoal.to_toml(bay("encircle"))
        assert "\nring" not in text
        assert "#     ring = 147.25  # reach" in text
        assert "\nlearn = 0.05" in text

    def test_a_file_loads_back(self, tmp_path):
        file = tmp_path / "bay.toml"
        file.write_text(shoal.to_toml(bay("encircle")))
        assert shoal.load(file) == bay("encircle")
        assert shoal.load(file).strategy.open == bay("encircle").strategy.open

    def test_the_hash_is_that_of_saying_the_same(self):
        known = bay("encircle")
        assert bay({"name": "encircle", **known.strategy.params}).hash == known.hash
        assert bay({"name": "encircle", "ring": 147.0}).hash != known.hash

    @pytest.mark.parametrize("again", [copy.deepcopy, lambda each: pickle.loads(pickle.dumps(each)), shoal.load])
    def test_copies_are_the_same(self, again):
        known = bay("encircle", **{"fleets.1.strategy": {"name": "knn-pso", "delta": 0.1}})
        other = again(known)
        assert other == known
        assert other.strategy.params == known.strategy.params
        assert other.fleets[1].strategy.open == known.fleets[1].strategy.open

    def test_a_fleet_in_two_scenarios_is_in_each_what_it_is_there(self):
        small = scenario("oceans2020", {"fleets.0.strategy": "encircle"})
        large = small.model_copy(update={"area": {"width": 200.0, "height": 200.0}})
        assert large.fleets[0].strategy.params["chase"] == pytest.approx(90.0)
        assert small.fleets[0].strategy.params["chase"] == 9.0

    def test_a_record_says_what_it_was(self):
        known = bay("encircle")
        recorded = recorded_scenario(known.model_dump(mode="json"), known.hash)
        assert recorded.strategy.params == known.strategy.params
        assert shoal.load(recorded) == known

    def test_a_strategy_changed_by_force_is_seen(self):
        forced = bay("encircle")
        forced.strategy.params["ring"] = 3.0
        assert shoal.load(forced).strategy.params["ring"] == 3.0
        assert set(shoal.load(forced).strategy.open) == {"chase", "spacing", "patience"}


MINE = """
from typing import Annotated, NamedTuple

import shoal


class {name}(NamedTuple):
    gap: Annotated[{gap}


@shoal.strategy("{name}", params={name})
def decide(me, heard, memory, params, draw):
    return params.gap, 0.0
"""


class TestStrategiesOfOnesOwn:
    """They mark what follows, too."""

    def test_a_marked_one_follows(self, tmp_path):
        file = tmp_path / "mine.py"
        file.write_text(MINE.format(name="marked", gap='shoal.Meters, shoal.Follows("spacing")] = 2.0'))
        assert bay("lattice").with_(strategy=file).strategy.params["gap"] == 2.0 * SPACING / PAPER.spacing

    def test_a_plain_one_is_in_meters(self, tmp_path):
        file = tmp_path / "mine.py"
        file.write_text(MINE.format(name="plain", gap='shoal.Meters, shoal.Doc("plain")] = 2.0'))
        assert bay("lattice").with_(strategy=file).strategy.params["gap"] == 2.0

    @pytest.mark.parametrize(
        ("gap", "problem"),
        [
            ('shoal.Meters, shoal.Follows("sea")] = 2.0', "there are spacing, reach, step"),
            ("shoal.Meters, shoal.Follows()] = 2.0", "there are spacing, reach, step"),
            ('shoal.Meters, shoal.Follows("reach")] = 2', "neither a length nor a time"),
            ('float, shoal.Follows("reach")] = 2.0', "neither a length nor a time"),
            ('shoal.Degrees, shoal.Follows("reach")] = 2.0', "neither a length nor a time"),
        ],
    )
    def test_a_mark_that_means_nothing_is_refused(self, tmp_path, gap, problem):
        file = tmp_path / "mine.py"
        file.write_text(MINE.format(name="wrong", gap=gap))
        with pytest.raises(StrategyError, match=problem):
            bay("lattice").with_(strategy=file)


@pytest.mark.parametrize("name", BUILTIN)
def test_every_length_and_time_of_ours_follows(name):
    """No strategy that comes with Shoal is made for one arena only."""
    known = CATALOGUE[name]
    hints = {field: str(hint) for field, hint in vars(known.params).get("__annotations__", {}).items()}
    lengths = {field for field, hint in hints.items() if "Unit(symbol='m')" in hint or "Unit(symbol='s')" in hint}
    assert set(following(known)) == lengths


def test_a_table_may_say_any_of_them():
    table = bay("lattice").model_dump(mode="json") | {"strategy": {"name": "encircle", "patience": "2 min"}}
    assert scenario_from(table).strategy.params["patience"] == 120.0
