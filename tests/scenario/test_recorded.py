"""A scenario as a record tells it: typed, of the right shape, and nothing that it names is loaded."""

import copy
import pickle

import pytest
from pydantic import ValidationError

import shoal
from scenarios import changed, scenario
from shoal.core.errors import ScenarioError, StrategyError
from shoal.run.simulation import Simulation
from shoal.scenario.recorded import RecordedScenario, recorded_scenario
from shoal.scenario.schema import Scenario

OWN = '''
from pathlib import Path
from shoal.strategies.contract import strategy
from typing import NamedTuple

Path({mark!r}).touch()

class Params(NamedTuple):
    pull: float = 0.5

@strategy("own-for-records", params=Params)
def decide(me, heard, memory, params, draw):
    """Stays."""
    return 0.0, 0.0
'''


def told(changes=None):
    """A scenario's table as record.json has it, with some fields changed by force."""
    return changed(scenario().model_dump(mode="json"), changes or {})


class TestShape:
    def test_it_is_a_scenario_that_says_the_same(self):
        recorded = recorded_scenario(told())
        assert isinstance(recorded, Scenario)
        assert isinstance(recorded, RecordedScenario)
        assert recorded == scenario()
        assert scenario() == recorded
        assert hash(recorded) == hash(scenario())
        assert recorded.hash == scenario().hash
        assert repr(recorded) == repr(scenario())
        assert recorded.model_dump(mode="json") == told()

    def test_names_may_be_any_text(self):
        name = "\x1b]0;pwn\x07"
        recorded = recorded_scenario(told({"name": name, "fleets.0.name": name, "description": "\x1b"}))
        assert (recorded.name, recorded.fleets[0].name) == (name, name)
        assert "\x1b" not in repr(recorded)
        with pytest.raises(ScenarioError, match="control character"):
            shoal.load(recorded)

    def test_its_hash_is_the_one_that_its_record_tells(self):
        recorded = recorded_scenario(told({"strategy": {"name": "gone", "pull": 1.0}}), hash="0123456789abcdef")
        assert recorded.hash == copy.deepcopy(recorded).hash == "0123456789abcdef"
        assert "0123456789abcdef" in repr(recorded)

    @pytest.mark.parametrize("twin", [copy.copy, copy.deepcopy, lambda each: pickle.loads(pickle.dumps(each))])
    def test_its_copies_say_the_same(self, twin):
        assert twin(recorded_scenario(told())) == scenario()

    @pytest.mark.parametrize(
        "changes",
        [
            {"area.width": "wide"},
            {"fleets": []},
            {"fleets.0.count": -1},
            {"strategy": {"delta": 1.0}},
            {"strategy": "knn-pso"},
            {"targets": [7]},
            {"targets": [{"kind": "waypoint"}]},
            {"network.neighbors": 50},
        ],
    )
    def test_what_has_not_the_shape_of_a_scenario_is_refused(self, changes):
        with pytest.raises(ValidationError):
            recorded_scenario(told(changes))


class TestWhatThisShoalDoesNotKnow:
    def test_a_field_is_left_out(self):
        later = {"weather": {"rain": 3}, "network.fog": 0.5, "fleets.1.hull": "steel", "targets.0.mood": "calm"}
        assert recorded_scenario(told(later)) == scenario()

    def test_a_target_keeps_its_words(self):
        serpent = {"kind": "serpent", "radius": 2.0, "speed": 3.0, "coils": 7}
        recorded = recorded_scenario(told({"targets": [serpent]}))
        assert (recorded.targets[0].kind, recorded.targets[0].radius) == ("serpent", 2.0)
        assert recorded.model_dump(mode="json")["targets"] == [serpent]
        assert "serpent target at 3 m/s" in repr(recorded)
        with pytest.raises(ScenarioError, match="no target is of kind 'serpent'"):
            Simulation(recorded)

    def test_a_strategy_keeps_its_words(self):
        recorded = recorded_scenario(told({"strategy": {"name": "murmuration", "source": "0" * 16, "birds": 5}}))
        assert recorded.strategy.name == "murmuration"
        assert recorded.strategy.params == {"birds": 5}
        assert recorded.strategy.known is None
        with pytest.raises(StrategyError, match="only known by the words of a record"):
            _ = recorded.strategy.owner
        with pytest.raises(ScenarioError, match="no strategy is called 'murmuration'"):
            Simulation(recorded)

    def test_parameters_are_not_judged_by_the_ranges_of_today(self):
        recorded = recorded_scenario(told({"strategy": {"name": "knn-pso", "delta": -7.0}}))
        assert recorded.strategy.params["delta"] == -7.0
        with pytest.raises(ScenarioError, match="delta"):
            shoal.load(recorded)


class TestFilesItNames:
    def test_a_track_that_is_gone_is_missed_when_it_is_needed(self):
        recorded = recorded_scenario(told({"targets": [{"kind": "track", "file": "/gone.csv", "radius": 1.0}]}))
        assert recorded.targets[0].file == "/gone.csv"
        with pytest.raises(shoal.ShoalError, match=r"gone\.csv"):
            Simulation(recorded)

    def test_a_strategy_is_neither_read_nor_run_until_it_is(self, tmp_path):
        mark, file = tmp_path / "ran", tmp_path / "own.py"
        file.write_text(OWN.format(mark=str(mark)))
        table = told({"strategy": {"name": "own-for-records", "file": str(file), "pull": 0.25}})
        recorded = recorded_scenario(table)
        assert not mark.exists()
        loaded = shoal.load(recorded)
        assert mark.exists()
        assert loaded.strategy.params == {"pull": 0.25}
        file.unlink()
        assert recorded_scenario(table).strategy.file == str(file)
        with pytest.raises(StrategyError, match="cannot be read"):
            shoal.load(recorded_scenario(table))

    def test_changes_validate_it_in_full(self, tmp_path):
        recorded = recorded_scenario(told({"fleets.0.strategy": {"name": "lattice"}}))
        changed_one = recorded.with_(neighbors=5)
        assert type(changed_one) is Scenario
        assert changed_one.network.neighbors == 5
        assert recorded.model_copy(update={"steps": 7}).steps == 7
        assert Simulation(recorded.with_(steps=5)).scenario.steps == 5
