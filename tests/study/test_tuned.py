"""Tuning from Python: the command line's search, as an object that a notebook shows."""

import json

import pytest

import shoal
from commands import shoal as command
from shoal.core.errors import ScenarioError

SHORT = {"steps": 60, "trials": 6, "runs": 2, "final_runs": 3}


@pytest.fixture(scope="module")
def found():
    return shoal.tune(
        "oceans2020", {"neighbors": (5, 40), "strategy.delta": "0.002:0.05"}, maximize="time_on_target", **SHORT
    )


def test_it_is_the_search_of_the_command_line(found, capsys):
    words = ("--vary", "neighbors=5:40", "--vary", "strategy.delta=0.002:0.05", "--maximize", "time_on_target")
    _, out, _ = command(capsys, "tune", "oceans2020", *words, "--steps", 60, "--trials", 6, "--runs", 2,
                        "--final-runs", 3, "--json")  # fmt: skip
    assert json.loads(out) == json.loads(json.dumps(found.to_dict()))


def test_what_it_reports_can_be_run_again(found):
    scenario = found.best_scenario
    assert scenario.network.neighbors == found.best["neighbors"]
    fresh = found.result.search.scenario.with_(**found.result.winner.point, seed=seed_of(found))
    assert shoal.simulate(fresh, runs=3).estimate("time_on_target").runs == found.best_value.runs


def seed_of(found):
    from shoal.experiments.tune import fresh_seed

    return fresh_seed(found.result.search.scenario.seed)


def test_it_shows_itself_and_gives_its_trials(found):
    assert "on fresh seeds" in repr(found)
    assert "<table>" in found._repr_html_()
    table = found.to_pandas()
    assert len(table) == 7
    assert table["neighbors"][0] == 20
    gids = {each.get_gid() for axes in found.plot().axes for each in axes.lines}
    assert {"trials", "winner", "fresh-start", "fresh-best"} <= gids


@pytest.mark.parametrize(
    ("vary", "told"),
    [
        ("neighbors", "write vary="),
        ({"neighbors": 5}, "neither a range nor a list"),
        ({"neighbors": (40, 5)}, "the range is empty"),
        ({"neighbors": [5]}, "nothing to choose"),
        ({}, "--vary: is missing"),
    ],
)
def test_what_is_no_search_is_refused(vary, told):
    with pytest.raises(ScenarioError, match=told):
        shoal.tune("oceans2020", vary, maximize="time_on_target", **SHORT)


def test_a_metric_that_the_scenario_does_not_count_is_refused():
    with pytest.raises(ScenarioError, match="leaves out power, which is looked for"):
        shoal.tune("oceans2020", {"neighbors": (5, 40)}, minimize="power", metrics=["xi"], **SHORT)


def test_a_misspelt_word_is_answered_with_the_one_meant():
    with pytest.raises(ScenarioError, match="did you mean 'trials'"):
        shoal.tune("oceans2020", {"neighbors": (5, 40)}, maximize="time_on_target", trails=5)
