"""Comparisons from Python: the command line's numbers, as an object that a notebook shows."""

import json

import numpy as np
import pytest

import shoal
from commands import shoal as command
from shoal.core.errors import ScenarioError, StrategyError, UnknownNameError
from shoal.strategies import CATALOGUE

pytest.importorskip("scipy.stats", reason="comparisons need scipy: pip install '.[sweep]'")

SHORT = {"steps": 200, "runs": 3}


@pytest.fixture(scope="module")
def found():
    return shoal.compare(["knn-pso", "constant-repulsion"], vary={"target_speed": [3, 5]}, **SHORT)


class TestNumbers:
    """The same as the command line prints."""

    def test_of_every_standing(self, found, capsys):
        words = ("compare", "knn-pso", "constant-repulsion", "--vary", "target-speed=3,5", "--steps", 200, "--runs", 3)
        _, out, _ = command(capsys, *words, "--json")
        table = found.to_pandas()
        printed = [
            (each["condition"]["target_speed"], of["strategy"], of["rank"], of["mean"], of["verdict"])
            for each in json.loads(out)["conditions"]
            for of in each["strategies"]
        ]
        columns = ["target_speed", "strategy", "rank", "mean", "verdict"]
        assert list(table[columns].itertuples(index=False, name=None)) == printed

    def test_of_every_run(self, found):
        runs = found.to_pandas("runs")
        assert len(runs) == 2 * 3 * 3
        mean = runs[(runs["target_speed"] == 5) & (runs["strategy"] == "lattice")]["time_on_target"].mean()
        standings = found.to_pandas().set_index(["target_speed", "strategy"])
        assert standings.loc[(5, "lattice"), "mean"] == pytest.approx(mean, rel=1e-12)

    def test_runs_are_those_of_simulate(self, found):
        record = shoal.simulate("oceans2020", target_speed=5, **SHORT)
        standing = found.conditions[1].of("knn-pso")
        np.testing.assert_array_equal(standing.value.runs, record.estimate("time_on_target").runs)

    def test_of_a_scenario_of_ones_own(self):
        scenario = shoal.load("oceans2020", neighbors=5, name="<b>bay</b>")
        found = shoal.compare("knn-pso", scenario, metric="power", **SHORT)
        assert found.direction == -1
        assert found.conditions[0].of("knn-pso").value.runs == (
            shoal.simulate(scenario, **SHORT).estimate("power").runs
        )
        assert "<b>bay" not in found._repr_html_()


class TestLooks:
    """A table in a terminal and in a notebook, a figure."""

    def test_a_row_per_standing(self, found):
        lines = repr(found).splitlines()
        assert lines[0] == "oceans2020: 3 runs of 200 steps, seed 1; time on target [share], more is better"
        assert lines[1].split() == [
            "condition", "strategy", "time", "on", "target", "minus", "knn-pso", "adj.", "p", "verdict",
        ]  # fmt: skip
        assert sum("lattice" in line for line in lines) == 2
        assert found._repr_html_().count("<tr>") == 1 + 6

    def test_a_figure_that_a_notebook_shows(self, found):
        pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install '.[plots]'")
        assert found.plot()._repr_png_().startswith(b"\x89PNG")


class TestStore:
    """With `out` all runs are kept, and the same call goes on."""

    def test_the_same_call_again_runs_nothing(self, tmp_path):
        told = []
        for _ in range(2):
            shoal.compare("knn-pso", out=tmp_path / "s", progress=lambda *now: told.append(now), **SHORT)
        assert told == [(n, 6) for n in range(1, 7)]
        assert len(shoal.load_results(tmp_path / "s")) == 6


class TestStrategies:
    """Names, files and functions."""

    def test_a_function_and_a_file(self, tmp_path):
        text = (
            "from typing import NamedTuple\nimport shoal\nclass P(NamedTuple):\n    a: float = 1.0\n"
            "@shoal.strategy('{}', params=P)\ndef stay(me, heard, memory, params, draw):\n    return 0.0, 0.0\n"
        )
        file = tmp_path / "stay.py"
        file.write_text(text.format("stay"))
        scope = {"__name__": "__main__"}
        exec(text.format("stay-too"), scope)
        try:
            found = shoal.compare([file, scope["stay"]], metric="speed", steps=50, runs=2)
        finally:
            del CATALOGUE["stay-too"]
        table = found.to_pandas().set_index("strategy")
        assert set(table.index) == {"stay", "stay-too", "lattice"}
        assert table.loc["stay", "mean"] == table.loc["stay-too", "mean"] < table.loc["lattice", "mean"]


@pytest.mark.parametrize(
    ("strategies", "options", "words"),
    [
        (["encirle"], {}, "did you mean 'encircle'"),
        ([], {}, "name a strategy or more"),
        (["knn-pso"], {"metric": "tot"}, "did you mean 'time_on_target'"),
        (["knn-pso"], {"baseline": "latice"}, "did you mean 'lattice'"),
        (["knn-pso"], {"runs": 0}, "ask for 1 or more"),
        (["knn-pso"], {"neighbours": 5}, "did you mean 'neighbors'"),
        (["knn-pso"], {"vary": {"neighbours": [5]}}, "did you mean 'neighbors'"),
        (["knn-pso"], {"vary": {"neighbors": []}}, "has no values"),
        (["knn-pso"], {"vary": {"strategy.delta": [1]}}, "vary a field that all of them share"),
        (["knn-pso"], {"scenario": "ocean2020"}, "did you mean 'oceans2020'"),
        (["no.py"], {}, "cannot be read"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_what_cannot_be_compared_is_refused(strategies, options, words):
    with pytest.raises((ScenarioError, StrategyError)) as refusal:
        shoal.compare(strategies, **options)
    assert words in str(refusal.value)


def test_of_tables(found):
    with pytest.raises(UnknownNameError, match="did you mean 'runs'"):
        found.to_pandas("run")
