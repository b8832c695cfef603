"""Tuning finds what is best, says what it is really worth, and starts again where it was."""

import pytest

from searches import chance, failing, runs_of
from shoal.core.errors import RecordError, ScenarioError
from shoal.experiments.conditions import conditions_of
from shoal.experiments.executors import in_threads
from shoal.experiments.objective import objective
from shoal.experiments.results import read_rows
from shoal.experiments.tune import Search, fresh_seed, tune
from shoal.experiments.variable import parse_variable
from shoal.scenario.load import load


def search(*vary, trials=24, runs=3, final_runs=8, conditions=(), goal=None, changes=None):
    changes = changes or {"steps": 50}
    scenario, chosen = load("oceans2020", **changes), goal or objective("time_on_target", 1)
    return Search(
        source="oceans2020", changes=changes, scenario=scenario, variables=[parse_variable(each) for each in vary],
        objective=chosen, conditions=conditions_of(conditions, chosen.metric, scenario),
        trials=trials, runs=runs, final_runs=final_runs,
    )  # fmt: skip


def hill(scenario, run):
    """Best at k = 12; every run has its luck, which is another for every k, seed and run."""
    k = scenario.network.neighbors
    return 0.8 - 0.001 * (k - 12) ** 2 + 0.05 * chance(k, scenario.seed, run)


def noise(scenario, run):
    """Nothing matters, but luck."""
    return 0.5 + 0.1 * chance(scenario.network.neighbors, scenario.seed, run)


class TestSearch:
    def test_finds_the_best_and_shows_it_beside_the_start(self, tmp_path):
        found = tune(search("neighbors=5:45"), tmp_path, executor=runs_of(hill))
        assert abs(found.winner.point["neighbors"] - 12) <= 5
        assert found.start.point == {}
        assert found.verdict == "better"
        assert found.difference.pairs == 8

    def test_less_may_be_what_is_looked_for(self, tmp_path):
        def power(tasks):
            for cell, run, row in runs_of(hill)(tasks):
                yield cell, run, row | {"power": (cell.scenario.network.neighbors - 30) ** 2 + 0.1 * run}

        found = tune(search("neighbors=5:45", goal=objective("power", -1)), tmp_path, executor=power)
        assert abs(found.winner.point["neighbors"] - 30) <= 3
        assert found.verdict == "better"

    def test_the_winner_of_pure_noise_is_flattered_and_no_better(self, tmp_path):
        found = tune(search("neighbors=5:45", trials=40), tmp_path, executor=runs_of(noise))
        assert found.flattered > 0.02
        assert found.verdict == "no difference shown"
        assert abs(found.winner_value.mean - 0.5) < 0.05

    def test_all_trials_share_their_seeds_and_the_end_has_fresh_ones(self, tmp_path):
        tune(search("neighbors=5:45", trials=6), tmp_path, executor=runs_of(hill))
        assert {row["seed"] for row in read_rows(tmp_path / "search")[1]} == {1}
        assert {row["seed"] for row in read_rows(tmp_path / "final")[1]} == {fresh_seed(1)}

    def test_the_score_is_the_mean_over_conditions(self, tmp_path):
        def value(scenario, run):
            return 0.2 if scenario.network.loss else 0.8

        found = tune(
            search("neighbors=5:45", trials=2, conditions=["as-it-is", "network.loss=0.5"]),
            tmp_path,
            executor=runs_of(value),
        )
        assert found.start.mean == pytest.approx(0.5)
        assert sorted(each.name for each in (tmp_path / "search").iterdir()) == ["as-it-is", "network-loss-0-5"]

    def test_trials_that_cannot_run_are_told_and_left_out(self, tmp_path):
        found = tune(
            search("strategy.repulsion_min=0.1:1.4", "strategy.repulsion_max=0.5:2.0", trials=30),
            tmp_path,
            executor=runs_of(lambda scenario, run: scenario.strategy.params["repulsion_min"]),
        )
        assert found.winner.values
        assert all(each.reason for each in found.trials if not each.values)

    def test_where_every_run_fails_that_is_the_error(self, tmp_path):
        with pytest.raises(ScenarioError, match="no trial has a value: it broke"):
            tune(search("neighbors=5:45", trials=3), tmp_path, executor=failing)


class TestResume:
    """The stores are all there is: the same call asks for the same points, and runs what they lack."""

    def test_a_second_call_runs_nothing_and_says_the_same(self, tmp_path):
        first, asked = tune(search("neighbors=5:45"), tmp_path, executor=runs_of(hill)), []
        assert tune(search("neighbors=5:45"), tmp_path, executor=runs_of(hill, asked)) == first
        assert asked == []

    def test_cut_off_at_any_run_it_ends_as_if_it_had_not_been(self, tmp_path):
        whole = tune(search("neighbors=5:45"), tmp_path / "whole", executor=runs_of(hill))

        def cut(after):
            def execute(tasks):
                for number, done in enumerate(runs_of(hill)(tasks)):
                    if number == after:
                        raise KeyboardInterrupt
                    yield done

            return execute

        for after in (0, 1, 7, 5):
            with pytest.raises(KeyboardInterrupt):
                tune(search("neighbors=5:45"), tmp_path / "cut", executor=cut(after))
        assert tune(search("neighbors=5:45"), tmp_path / "cut", executor=runs_of(hill)) == whole

    def test_more_trials_go_on_from_those_that_there_are(self, tmp_path):
        few, asked = tune(search("neighbors=5:45", trials=10), tmp_path, executor=runs_of(hill)), []
        more = tune(search("neighbors=5:45", trials=14), tmp_path, executor=runs_of(hill, asked))
        assert more.trials[:11] == few.trials
        assert len(asked) <= 4 * 3 + 8

    def test_another_seed_is_another_search_and_another_folder(self, tmp_path):
        tune(search("neighbors=5:45", trials=4), tmp_path, executor=runs_of(hill))
        other = search("neighbors=5:45", trials=4, changes={"steps": 50, "seed": 2})
        with pytest.raises(RecordError, match=r"scenario\.seed: 1 then, 2 now"):
            tune(other, tmp_path, executor=runs_of(hill))

    def test_a_folder_of_other_things_is_left_alone(self, tmp_path):
        (tmp_path / "mine").write_text("mine")
        with pytest.raises(RecordError, match="is not empty"):
            tune(search("neighbors=5:45"), tmp_path, executor=runs_of(hill))
        assert [each.name for each in tmp_path.iterdir()] == ["mine"]

    def test_threads_change_nothing(self, tmp_path):
        small = search("neighbors=5:45", trials=5, runs=2, final_runs=2)
        one, three = (tune(small, tmp_path / str(jobs), executor=in_threads(jobs)) for jobs in (1, 3))
        assert one == three


class TestRefusals:
    """Before anything is run, and nothing is left."""

    @pytest.mark.parametrize(
        ("vary", "conditions", "told"),
        [
            (["neighbors=5:50"], [], "neighbors=50"),
            (["strategy.dleta=0.1:0.2"], [], "strategy.dleta"),
            (["neighbors=5:40", "network.neighbors=5:40"], [], "set network.neighbors twice"),
            (["neighbors=5:40"], ["neighbors=3"], "set network.neighbors twice"),
            (["neighbors=5:40", "steps=10:20"], [], "set steps twice"),
        ],
    )
    def test_of_ends_that_cannot_run_and_of_fields_set_twice(self, vary, conditions, told, tmp_path):
        with pytest.raises(ScenarioError, match=told):
            tune(search(*vary, conditions=conditions), tmp_path / "new", executor=failing)
        assert not (tmp_path / "new").exists()
