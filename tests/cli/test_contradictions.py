"""Two options that set one field are refused, by whatever names; ranges end."""

import json
import resource
import time

import pytest

from commands import shoal
from shoal.cli.main import BAD_INPUT


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


class TestContradictions:
    @pytest.mark.parametrize(
        ("command", "told"),
        [
            (["run", "-k", "5", "--set", "network.neighbors=7"], "--neighbors and --set network.neighbors"),
            (["run", "--seed", "2", "--set", "seed=1"], "--seed and --set seed"),
            (["run", "--set", "seed=1", "--set", "seed=2"], "--set seed: is given twice"),
            (["run", "--fast", "5", "--set", "fleets.BoB-1.count=7"], "--fast and --set fleets.BoB-1.count"),
            (["run", "--agents", "9", "--set", "fleets.1.count=7"], "--agents and --set fleets.1.count"),
            (["run", "--set", "fleets.0.count=5", "--set", "fleets.BoB-1.count=7"], "set fleets.0.count twice"),
            (["run", "--target-speed", "5", "--set", "targets.0.speed=7"], "set targets.0.speed twice"),
            (["run", "--strategy", "lattice", "--set", "strategy.name=encircle"], "set strategy.name twice"),
            (["sweep", "--vary", "neighbors=5", "--vary", "neighbors=6"], "--vary neighbors: is given twice"),
            (["sweep", "--vary", "neighbors=5", "--set", "neighbors=7"], "set network.neighbors twice"),
            (["sweep", "--vary", "neighbors=5", "--vary", "network.neighbors=7"], "set network.neighbors twice"),
            (["sweep", "--vary", "steps=5", "--steps", "7"], "--steps and --vary steps: set steps twice"),
            (["sweep", "--vary", "fast=5", "--vary", "fleets.0.count=7"], "set fleets.0.count twice"),
            (["sweep", "--scheduler", "tcp://x:1"], "add --executor dask"),
            (["sweep", "--until-ci", "nan"], "'nan' is not a number"),
        ],
    )
    def test_are_refused_with_both_names(self, command, told, capsys):
        code, out, err = shoal(capsys, command[0], "oceans2020", *command[1:], "--out", "new")
        assert (code, out) == (BAD_INPUT, "")
        assert told in err

    def test_of_compare_too(self, capsys):
        for command in (["--set", "strategy=lattice"], ["--vary", "neighbors=5", "--set", "network.neighbors=6"]):
            code, _, err = shoal(capsys, "compare", "knn-pso", *command)
            assert code == BAD_INPUT
            assert "twice" in err

    def test_of_a_design_file_and_an_option(self, capsys, tmp_path):
        (tmp_path / "design.toml").write_text('scenario = "oceans2020"\n[vary]\nneighbors = [5, 6]\n')
        code, _, err = shoal(capsys, "sweep", "design.toml", "--set", "network.neighbors=3", "--dry-run")
        assert code == BAD_INPUT
        assert "set network.neighbors twice" in err

    def test_one_output_at_a_time(self, capsys):
        code, _, err = shoal(capsys, "results", "nowhere", "--csv", "--json")
        assert code == BAD_INPUT
        assert "--csv and --json: are different outputs" in err

    def test_agents_and_fast_belong_together(self, capsys):
        assert shoal(capsys, "run", "oceans2020", "--agents", 9, "--fast", 2, "--steps", 3, "--json")[0] == 0


class TestRanges:
    @pytest.mark.parametrize(
        "values", ["1:1e18:1", "1:5:1e-300", "nan:5:1", "1:inf:1", "1:2:nan", f"{2**63}:{10**26}:1", "0:1e6:1"]
    )
    def test_that_hardly_end_are_refused_at_once(self, values, capsys):
        before, begun = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.process_time()
        code, _, err = shoal(capsys, "sweep", "oceans2020", "--vary", f"neighbors={values}", "--dry-run")
        assert code == BAD_INPUT
        assert f"the range {values} has" in err
        assert time.process_time() - begun < 5
        assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 100_000

    def test_combinations_are_counted_before_they_are_made(self, capsys):
        vary = [f"--vary=fleets.0.{name}=1:1000" for name in ("max_speed", "mass", "sensor_radius")]
        code, _, err = shoal(capsys, "sweep", "oceans2020", *vary, "--dry-run")
        assert code == BAD_INPUT
        assert "have 1,000,000,000 combinations\n  fix: ask for 1,000,000 at most" in err

    @pytest.mark.parametrize(("option", "most"), [("runs", "1,000,000"), ("jobs", "1,024")])
    def test_runs_and_jobs_end_too(self, option, most, capsys):
        code, _, err = shoal(capsys, "run", "oceans2020", f"--{option}", 10**9)
        assert code == BAD_INPUT
        assert f"--{option}: is 1,000,000,000\n  fix: give {most} at most" in err

    @pytest.mark.parametrize(
        "line", ["runs = 'x'", "runs = 0", "samples = 1.5", "seed = -1", "vary = 3", "points = 3", "points = [3]",
                 "scenario = 3", "vary = {neighbors = []}", "mode = 'x'"],
    )  # fmt: skip
    def test_a_design_file_that_says_nonsense_is_refused(self, line, capsys, tmp_path):
        base = "" if line.startswith("scenario") else 'scenario = "oceans2020"\n'
        varied = "" if line.startswith(("vary", "points")) else "[vary]\nneighbors = [3]\n"
        (tmp_path / "design.toml").write_text(f"{base}{line}\n{varied}")
        code, _, err = shoal(capsys, "sweep", "design.toml", "--dry-run")
        assert code == BAD_INPUT
        assert err.startswith("shoal: design.toml " + line.split()[0])


class TestNone:
    """A fleet varied down to none."""

    def test_is_left_out(self, capsys):
        vary = ["--vary", "fleets.BoB-1.count=0,15", "--set", "steps=30", "--runs", "1", "--out", "s"]
        assert shoal(capsys, "sweep", "oceans2020", *vary)[0] == 0
        rows = json.loads(shoal(capsys, "results", "s", "--json")[1])
        assert [(row["fleets.BoB-1.count"], len(row["fleet_xi_raw"])) for row in rows] == [(0, 1), (15, 2)]

    def test_in_a_file_it_is_still_a_mistake(self, capsys):
        _, text, _ = shoal(capsys, "scenario", "oceans2020")
        with open("none.toml", "w") as file:
            file.write(text.replace("count = 15", "count = 0"))
        assert "fleets.0.count: 0: input should be greater than 0" in shoal(capsys, "run", "none.toml")[2]


class TestDurations:
    def test_are_steps(self, capsys):
        for command in (["--steps", "2 min"], ["--set", "steps=2 min"], ["--steps", "0.1 h", "--set", "time_step=0.3"]):
            code, out, _ = shoal(capsys, "run", "oceans2020", *command, "--json")
            assert code == 0
            assert json.loads(out)["steps"] == 1200

    def test_end_with_a_whole_step(self, capsys):
        _, out, _ = shoal(capsys, "run", "oceans2020", "--steps", "10 s", "--set", "time_step=0.7", "--json")
        assert json.loads(out)["steps"] == 15

    @pytest.mark.parametrize("text", ["2 parsecs", "-2 h", "0 s", "2 km", "h"])
    def test_that_are_none_are_refused(self, text, capsys):
        assert shoal(capsys, "run", "oceans2020", f"--set=steps={text}")[0] == BAD_INPUT


class TestFileStrategy:
    """A strategy of one's own has one name."""

    TEXT = """
import shoal
from typing import NamedTuple
class Params(NamedTuple):
    pass
@shoal.strategy("NAME", params=Params)
def decide(me, heard, memory, params, draw):
    return 1.0, SPEED
"""

    def write(self, file, name="mine", speed="0.0"):
        with open(file, "w") as stream:
            stream.write(self.TEXT.replace("NAME", name).replace("SPEED", speed))

    def test_which_results_show(self, capsys):
        self.write("some_file.py")
        vary = ["--vary", "strategy=lattice,some_file.py", "--steps", "9", "--runs", "1", "--out", "s"]
        code, out, _ = shoal(capsys, "sweep", "oceans2020", *vary[:2], "--runs", "1", "--steps", "9", "--dry-run")
        assert (code, out.splitlines()[:2]) == (0, ["strategy=lattice", "strategy=mine"])
        assert shoal(capsys, "sweep", "oceans2020", *vary)[0] == 0
        rows = json.loads(shoal(capsys, "results", "s", "--json")[1])
        assert {row["strategy"] for row in rows} == {"lattice", "mine"}

    def test_which_two_files_do_not_share(self, capsys):
        self.write("one.py")
        self.write("two.py", speed="0.5")
        code, _, err = shoal(capsys, "sweep", "oceans2020", "--vary", "strategy=./one.py,./two.py", "--dry-run")
        assert code == BAD_INPUT
        assert "./one.py and ./two.py: are both called 'mine'" in err
