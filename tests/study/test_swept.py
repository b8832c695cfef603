"""Sweeps from Python: the command line's runs, as an object that a notebook shows."""

import numpy as np
import pytest

import shoal
from commands import shoal as command
from shoal.core.errors import RecordError, ScenarioError, UnknownNameError
from shoal.experiments.results import read_rows

SHORT = {"steps": 100, "runs": 2}


@pytest.fixture(scope="module")
def found():
    return shoal.sweep("oceans2020", {"neighbors": [10, 30], "fast": "0:15:15"}, **SHORT)


class TestRuns:
    """The same as the command line makes."""

    def test_are_those_of_the_command_line(self, found, capsys, tmp_path):
        out = tmp_path / "k"
        words = ("--vary", "neighbors=10,30", "--vary", "fast=0:15:15", "--steps", 100, "--runs", 2, "--out", out)
        assert command(capsys, "sweep", "oceans2020", *words)[0] == 0
        assert read_rows(out) == (found.fields, found.rows)

    def test_a_store_that_the_command_line_can_go_on_with(self, capsys, tmp_path):
        out = tmp_path / "k"
        shoal.sweep("oceans2020", {"neighbors": [10]}, out=out, **SHORT)
        words = ("--vary", "neighbors=10,30", "--steps", 100, "--runs", 2, "--out", out)
        assert command(capsys, "sweep", "oceans2020", *words)[0] == 0
        assert len(read_rows(out)[1]) == 4
        assert (out / "results.csv").is_file()

    def test_are_those_of_simulate(self, found):
        table = found.to_pandas()
        of_one = table[(table["neighbors"] == 30) & (table["fast"] == 0)]["xi"]
        assert of_one.tolist() == list(shoal.simulate("oceans2020", neighbors=30, fast=0, **SHORT).estimate("xi").runs)

    @pytest.mark.parametrize("values", [range(10, 31, 20), np.arange(10, 31, 20), (10, 30), "10,30", "10:30:20"])
    def test_values_of_every_kind(self, values):
        swept = shoal.sweep("oceans2020", {"neighbors": values}, steps=5, runs=1)
        assert swept.to_pandas()["neighbors"].tolist() == [10, 30]

    def test_one_by_one(self):
        swept = shoal.sweep("oceans2020", {"neighbors": [10, 30], "fast": [0, 15]}, mode="zip", steps=5, runs=1)
        assert swept.to_pandas()[["neighbors", "fast"]].to_numpy().tolist() == [[10, 0], [30, 15]]

    def test_of_a_scenario_in_memory(self, tmp_path):
        scenario = shoal.load("oceans2020", steps=5)
        swept = shoal.sweep(scenario, {"network.loss": [0.0, 0.5]}, runs=1, fleets=scenario.fleets[1:])
        assert len(swept.rows) == 2
        assert swept.rows[0]["scenario_hash"] == scenario.with_(fleets=scenario.fleets[1:]).hash


class TestNumbers:
    """Means with intervals."""

    def test_of_every_combination(self, found):
        means = found.to_pandas("means").set_index(["neighbors", "fast"])
        known = shoal.simulate("oceans2020", neighbors=10, fast=15, **SHORT).estimate("time_on_target")
        row = means.loc[(10, 15)]
        assert (row["runs"], row["time_on_target"]) == (2, known.mean)
        assert (row["time_on_target_low"], row["time_on_target_high"]) == known.ci95

    def test_by_one_field(self, found):
        assert found.to_pandas("means", by=["fast"])["runs"].tolist() == [4, 4]


class TestLooks:
    """A table in a terminal and in a notebook, a figure."""

    def test_a_row_per_combination(self, found):
        lines = repr(found).splitlines()
        assert lines[0] == "oceans2020: 4 combinations, 8 runs"
        assert len(lines) == 1 + 1 + 4 + 1
        assert found._repr_html_().count("<tr>") == 1 + 4

    def test_a_figure_that_a_notebook_shows(self, found):
        pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install '.[plots]'")
        assert found.plot(x="neighbors", hue="fast")._repr_png_().startswith(b"\x89PNG")

    def test_failures_are_told(self, tmp_path):
        file = tmp_path / "broken.py"
        file.write_text(
            "from typing import NamedTuple\nimport shoal\nclass P(NamedTuple):\n    a: float = 1.0\n"
            "@shoal.strategy('broken', params=P)\ndef go(me, heard, memory, params, draw):\n    return me.x / 0.0, 0.0\n"  # noqa: E501
        )
        swept = shoal.sweep("oceans2020", {"strategy": [file]}, steps=5, runs=1)
        assert len(swept.failures) == 1
        assert "1 runs failed" in repr(swept)


@pytest.mark.parametrize(
    ("vary", "options", "words"),
    [
        ({"neighbours": [1]}, {}, "did you mean 'neighbors'"),
        ({"neighbors": [10, 60]}, {}, "at most 49"),
        ({"neighbors": []}, {}, "has no values"),
        pytest.param({"neighbors": [object()]}, {}, "give a number", id="an object"),
        (["neighbors"], {}, 'write vary={"neighbors"'),
        ({5: [1]}, {}, 'write vary={"neighbors"'),
        ({"neighbors": [1]}, {"until": 3}, "did you mean 'until_ci'"),
        ({"neighbors": [1]}, {"stepss": 3}, "did you mean 'steps'"),
        ({"neighbors": [1]}, {"runs": 0}, "ask for 1 or more"),
        ({"neighbors": [1]}, {"jobs": 0}, "ask for 1 or more"),
        ({"neighbors": [1], "fast": [1, 2]}, {"mode": "zip"}, "different numbers of values"),
    ],
    ids=lambda value: str(value)[:40],
)
def test_what_cannot_be_swept_is_refused_before_anything_runs(vary, options, words, tmp_path):
    with pytest.raises(ScenarioError) as refusal:
        shoal.sweep("oceans2020", vary, out=tmp_path / "s", **options)
    assert words in str(refusal.value)


def test_names_that_are_not_there(found, tmp_path):
    with pytest.raises(UnknownNameError, match="did you mean 'means'"):
        found.to_pandas("mean")
    with pytest.raises(UnknownNameError, match="there are: grid, zip"):
        shoal.sweep("oceans2020", {"fast": [1]}, mode="latin")


def test_another_sweeps_store_is_refused(tmp_path):
    shoal.sweep("oceans2020", {"neighbors": [10]}, out=tmp_path / "s", steps=5, runs=1)
    with pytest.raises(RecordError, match="was made by another sweep"):
        shoal.sweep("oceans2020", {"fast": [10]}, out=tmp_path / "s", steps=5, runs=1)
