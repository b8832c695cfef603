"""Changes in the words of the command line, from Python: always validated, whoever made the copy."""

import copy
import linecache
import pickle
from pathlib import Path

import numpy as np
import pytest

import shoal
from shoal.core.errors import ScenarioError, StrategyError
from shoal.scenario.load import read_table, scenario_from
from shoal.strategies import CATALOGUE

CELL = """
from typing import NamedTuple
import shoal
class P(NamedTuple):
    share: float = SHARE
@shoal.strategy("of-a-cell", params=P)
def of_a_cell(me, heard, memory, params, draw):
    "Drift."
    return params.share * me.max_speed, 0.0
"""


@pytest.fixture
def paper():
    return shoal.load("oceans2020", steps=20)


@pytest.fixture
def run_cell(request):
    """Execute a cell as a notebook does: its text is known by the name of a file that is not there."""

    def run(number, share):
        text, name = CELL.replace("SHARE", str(share)), f"<cell {request.node.name} {number}>"
        linecache.cache[name] = len(text), None, text.splitlines(keepends=True), name
        scope = {"__name__": "__main__"}
        exec(compile(text, name, "exec"), scope)
        return scope["of_a_cell"]

    before = dict(CATALOGUE)
    yield run
    CATALOGUE.clear()
    CATALOGUE.update(before)


class TestWith:
    """What --set and its friends do."""

    def test_the_words_of_the_command_line(self, paper):
        changed = paper.with_(
            neighbors=10, fast=25, target_speed="6 kn", strategy="encircle", steps=7, **{"network.loss": 0.1}
        )
        assert (changed.network.neighbors, changed.network.loss, changed.steps) == (10, 0.1, 7)
        assert changed.counts == [25, 25]
        assert changed.targets[0].speed == pytest.approx(6 * 1852 / 3600)
        assert changed.strategy.name == "encircle"

    def test_nothing_else_changes(self, paper):
        assert paper.with_(neighbors=10).with_(neighbors=20) == paper
        assert paper.with_() == paper

    def test_load_and_the_command_line_take_the_same(self, paper):
        changes = {"agents": 40, "fast": 10, "network.loss": 0.25}
        assert shoal.load("oceans2020", steps=20, **changes) == paper.with_(**changes)

    @pytest.mark.parametrize(
        "value", [np.int64(7), np.int32(7), np.array(7)], ids=["int64", "int32", "array of no dimension"]
    )
    def test_numbers_of_numpy(self, paper, value):
        assert paper.with_(neighbors=value) == paper.with_(neighbors=7)

    def test_parts_of_a_scenario(self, paper):
        assert paper.with_(fleets=paper.fleets[1:]).counts == [35]
        assert paper.with_(strategy=paper.strategy) == paper

    @pytest.mark.parametrize("order", [1, -1])
    def test_the_order_of_words_does_not_matter(self, paper, order):
        words = {"strategy": "constant-repulsion", "strategy.repulsion": 0.7, "fast": 10, "agents": 20}
        changed = paper.with_(**dict(list(words.items())[::order]))
        assert (changed.strategy.name, changed.strategy.params["repulsion"]) == ("constant-repulsion", 0.7)
        assert changed.counts == [10, 10]

    @pytest.mark.parametrize(
        ("changes", "words"),
        [
            ({"neighbors": 60}, "50 agents can hear at most 49"),
            ({"neighbours": 10}, "did you mean 'neighbors'"),
            ({"target-sped": 3}, "did you mean 'target_speed'"),
            ({"stepss": 9}, "did you mean 'steps'"),
            ({"network.neigbors": 9}, "did you mean 'neighbors'"),
            ({"netwrk.neighbors": 9}, "did you mean 'network'"),
            ({"fleets.BoB-7.count": 9}, "there are: BoB-1, BoB-0"),
            ({"fast": 60}, "from 0 to 50"),
            ({"target_speed": "6 kg"}, "not a quantity in m/s"),
            ({"strategy": "encirle"}, "did you mean 'encircle'"),
            ({"strategy.dleta": 1}, "did you mean 'delta'"),
            ({"strategy": 3}, "a strategy is a table"),
            ({"seed": -1}, "seed: -1"),
            ({"track_id": "a=b"}, "needs target_track"),
        ],
        ids=lambda value: str(value)[:40],
    )
    def test_what_does_not_fit_is_refused(self, paper, changes, words):
        for refuse in (paper.with_, lambda **each: shoal.simulate(paper, **each)):
            with pytest.raises(ScenarioError) as refusal:
                refuse(**changes)
            assert words in str(refusal.value)
            assert "--set" not in str(refusal.value)

    def test_a_recorded_track(self, paper, tmp_path):
        rows = [f"2020-01-01T00:{minute:02}:00Z,{50 + minute / 1000},{minute / 1000}" for minute in range(20)]
        file = tmp_path / "track.csv"
        file.write_text("\n".join(["time,lat,lon", *rows]))
        on_track = paper.with_(target_track=file, steps=30, **{"targets.0.radius": 99})
        assert (on_track.targets[0].kind, on_track.targets[0].radius, on_track.steps) == ("track", 99, 30)

    @pytest.mark.parametrize(("word", "meant"), [("run", "runs"), ("evry", "every"), ("target_trck", "target_track")])
    def test_a_misspelt_keyword_of_a_function_is_answered_too(self, paper, word, meant):
        with pytest.raises(ScenarioError, match=f"did you mean '{meant}'"):
            shoal.simulate(paper, **{word: 3})


class TestSource:
    """What can be read as a scenario, at every public door."""

    def test_a_name_a_file_a_table_and_a_scenario_are_one(self, paper, tmp_path):
        file = tmp_path / "paper.toml"
        file.write_text(shoal.to_toml(paper))
        for source in (paper, file, str(file), paper.model_dump(), read_table("oceans2020") | {"steps": 20}):
            assert shoal.load(source) == paper
            assert shoal.simulate(source).provenance["scenario_hash"] == paper.hash

    @pytest.mark.parametrize("source", [None, 5, b"oceans2020", ["oceans2020"], "", "ocean2020", "a\0b", {}])
    def test_anything_else_is_refused(self, source):
        for door in (shoal.load, shoal.simulate, shoal.Simulation):
            with pytest.raises(ScenarioError):
                door(source)


class TestCopies:
    """A copy that was not validated cannot run."""

    WRONG = (
        {"steps": -5},
        {"steps": "abc"},
        {"seed": -1},
        {"time_step": -1.0},
        {"stepss": 9},
        {"neighbors": 10},
        {"network.neighbors": 10},
        {"network": {"neighbors": 500}},
        {"network": {"neigbors": 10}},
        {"strategy": "no-such"},
        {"strategy": 7},
        {"fleets": ()},
    )

    @pytest.mark.parametrize("update", WRONG, ids=str)
    def test_a_wrong_copy_is_not_made(self, paper, update):
        with pytest.raises(ScenarioError):
            paper.model_copy(update=update)

    @pytest.mark.parametrize("update", WRONG, ids=str)
    def test_one_made_by_force_does_not_run(self, paper, update):
        forced = copy.deepcopy(paper)
        vars(forced).update(update)
        for door in (shoal.simulate, shoal.Simulation, shoal.to_toml, shoal.load):
            with pytest.raises(ScenarioError):
                door(forced)

    def test_nor_does_a_wrong_part_of_one(self, paper):
        wrong = paper.network.model_copy(update={"neighbors": 500})
        with pytest.raises(ScenarioError, match="50 agents can hear at most 49"):
            paper.model_copy(update={"network": wrong})
        with pytest.raises(ScenarioError, match=r"Network.neigbors: unknown field \(value 5\)\n.*'neighbors'"):
            paper.network.model_copy(update={"neigbors": 5})
        with pytest.raises(ScenarioError, match=r"Fleet\.count: -1"):
            paper.fleets[0].model_copy(update={"count": -1})

    def test_nor_one_whose_strategy_was_spoiled(self, paper):
        forced = copy.deepcopy(paper)
        forced.strategy.params["delta"] = "much"
        with pytest.raises(ScenarioError, match=r"strategy\.delta"):
            shoal.simulate(forced)
        assert paper.strategy.params["delta"] == 0.01

    def test_a_right_copy_runs(self, paper):
        copied = paper.model_copy(update={"strategy": "lattice", "network": {"neighbors": 10}})
        assert (copied.strategy.name, copied.network.neighbors) == ("lattice", 10)
        assert shoal.simulate(copied).scenario.strategy.name == "lattice"

    @pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda each: pickle.loads(pickle.dumps(each))])
    def test_copies_without_a_change_are_equal_and_run(self, paper, again):
        assert again(paper) == paper
        assert shoal.simulate(again(paper)).provenance["scenario_hash"] == paper.hash


class TestFrozen:
    """What cannot be set, or is not there, is answered with what can be done."""

    def test_a_scenario_does_not_change(self, paper):
        with pytest.raises(ScenarioError, match=r"Network\.neighbors: does not change\n.*with_\(neighbors=10"):
            paper.network.neighbors = 10
        with pytest.raises(ScenarioError, match=r"Scenario\.steps: does not change"):
            paper.steps = 10
        assert (paper.network.neighbors, paper.steps) == (20, 20)

    @pytest.mark.parametrize(
        ("wrong", "meant"),
        [("neighbors", "network.neighbors"), ("step", "steps"), ("width", "area.width"), ("has", "hash")],
    )
    def test_what_is_not_there(self, paper, wrong, meant):
        with pytest.raises(AttributeError, match=f"a Scenario has no attribute '{wrong}'; did you mean '{meant}'"):
            getattr(paper, wrong)

    def test_what_is_not_there_in_a_part(self, paper):
        with pytest.raises(AttributeError, match="a Fleet has no attribute 'speed'; did you mean 'max_speed'"):
            paper.fleets[0].speed  # noqa: B018


class TestStrategyOfACell:
    """A strategy that is typed into a notebook."""

    def test_by_name_and_by_function(self, paper, run_cell):
        function = run_cell(1, 0.5)
        assert paper.with_(strategy="of-a-cell") == paper.with_(strategy=function)
        assert paper.with_(strategy=function).strategy.name == "of-a-cell"

    def test_another_text_is_another_scenario(self, paper, run_cell):
        run_cell(1, 0.5)
        one = paper.with_(strategy="of-a-cell")
        run_cell(2, 0.25)
        other = paper.with_(strategy="of-a-cell", **{"strategy.share": 0.5})
        assert one.strategy.params == other.strategy.params
        assert one.hash != other.hash

    def test_a_scenario_of_the_text_before_is_refused_rather_than_run(self, paper, run_cell):
        run_cell(1, 0.5)
        old = paper.with_(strategy="of-a-cell")
        run_cell(2, 0.25)
        for door in (shoal.simulate, lambda each: each.with_(steps=5), lambda each: scenario_from(each.model_dump())):
            with pytest.raises(StrategyError):
                door(old)
        assert old.with_(strategy="of-a-cell").strategy.params == {"share": 0.5}  # its parameters are kept
        assert not old.with_(strategy="of-a-cell").strategy.outdated


def test_a_scenario_in_memory_outlives_the_file_of_its_strategy(tmp_path):
    file = tmp_path / "mine.py"
    file.write_text(CELL.replace("SHARE", "0.5"))
    scenario = shoal.load("oceans2020", strategy=file, steps=5)
    file.write_text(CELL.replace("SHARE", "0.25"))
    assert scenario.with_(steps=6).strategy == scenario.strategy
    assert copy.deepcopy(scenario) == scenario
    with pytest.raises(StrategyError, match="is not the file that this scenario was made with"):
        shoal.load(scenario.model_dump())
    assert shoal.load("oceans2020", strategy=Path(file)).strategy.params == {"share": 0.25}
