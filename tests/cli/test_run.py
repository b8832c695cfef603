"""The command line: what it prints, and what it says of bad input."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from commands import shoal, wait_until
from shoal.metrics.summary import METRICS
from shoal.scenario.load import scenario_from, to_toml

SHARED = Path(__file__).resolve().parents[2] / ".." / "shared" / "data"


class TestRun:
    def test_json_is_one_object_and_nothing_else(self, capsys):
        code, out, _ = shoal(capsys, "run", "oceans2020", "--steps", 400, "--runs", 2, "--seed", 9, "--json")
        summary = json.loads(out)
        assert code == 0
        for metric in ("time_on_target", "xi", "xi_raw", "response"):
            assert set(summary[metric]) == {"mean", "ci95", "runs"}
            assert len(summary[metric]["runs"]) == 2
            assert summary[metric]["ci95"][0] <= summary[metric]["mean"] <= summary[metric]["ci95"][1]
        assert len(summary["phi_histogram"]) == 11
        assert sum(summary["phi_histogram"]) == pytest.approx(50)
        assert (summary["steps"], summary["seed"]) == (400, 9)
        assert len(summary["scenario_hash"]) == 16

    def test_response_is_xi_raw_of_all_agents_in_arena_units_per_step(self, capsys):
        _, out, _ = shoal(capsys, "run", "oceans2020", "--steps", 300, "--json")
        summary = json.loads(out)
        assert summary["response"]["mean"] == pytest.approx(50 * 0.1 * summary["xi_raw"]["mean"])

    def test_options_change_the_scenario(self, capsys):
        _, _out, _ = shoal(
            capsys, "run", "oceans2020", "-k", 7, "--fast", 5, "--agents", 40, "--target-speed", "5 kn", "--steps", 50,
            "--set", "strategy.delta=0.02", "--set", "fleets.BoB-0.start=corner", "--out", "record", "--json",
        )  # fmt: skip
        scenario = json.loads(Path("record/record.json").read_text())["scenario"]
        assert [(fleet["name"], fleet["count"]) for fleet in scenario["fleets"]] == [("BoB-1", 5), ("BoB-0", 35)]
        assert scenario["network"]["neighbors"] == 7
        assert scenario["targets"][0]["speed"] == pytest.approx(5 * 1852 / 3600)
        assert scenario["strategy"]["delta"] == 0.02
        assert scenario["fleets"][1]["start"] == "corner"

    def test_a_saved_record_shows_the_same_numbers(self, capsys):
        _, printed, _ = shoal(capsys, "run", "oceans2020", "--steps", 300, "--out", "r", "--json")
        code, shown, _ = shoal(capsys, "show", "r", "--json")
        assert code == 0
        assert json.loads(shown) == json.loads(printed)

    def test_a_figure_is_drawn(self, capsys):
        pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install '.[plots]'")
        code, _, _ = shoal(capsys, "run", "oceans2020", "--steps", 300, "--figure", "f.png")
        assert code == 0
        assert Path("f.png").read_bytes().startswith(b"\x89PNG")

    def test_all_slow_is_a_fleet_less(self, capsys):
        _, out, _ = shoal(capsys, "run", "oceans2020", "--fast", 0, "--steps", 50, "--json")
        assert list(json.loads(out)["fleets"]) == ["BoB-0"]


class TestTable:
    """Fits a terminal of 80 columns: a row is a line."""

    SCENARIO = ("oceans2020", "--steps", 1200, "--set", "losses=[{step=1000,count=25}]")

    def test_no_row_is_wrapped_or_cut(self, capsys, monkeypatch):
        lines = {}
        for columns in (80, 200):
            monkeypatch.setenv("COLUMNS", str(columns))
            _, out, _ = shoal(capsys, "run", *self.SCENARIO, "--set", "network.loss=0.1", "--all")
            lines[columns] = printed = out.splitlines()
        assert max(map(len, lines[80])) <= 80
        assert lines[80][:-1] == lines[200][:-1]  # but for the seconds that it took
        assert not any(line.endswith(" ") for line in printed)

    def test_fleets_and_changes_have_rows_under_a_heading(self, capsys):
        _, out, _ = shoal(capsys, "run", *self.SCENARIO, "--all")
        headings = ["fleet BoB-1", "fleet BoB-0", "step 1,000: 25 lost", "phi histogram, agents"]
        begins = [out.index(heading) for heading in headings]
        assert begins == sorted(begins)
        assert "  recovery" in out[begins[2] :]

    def test_begins_with_a_sentence_and_shows_eight_metrics(self, capsys):
        _, out, _ = shoal(capsys, "run", *self.SCENARIO, "--out", "r")
        assert out.startswith("The target was watched ")
        words = [each.words for each in METRICS.values()]
        assert sum(any(line.startswith(f"{name}  ") for name in words) for line in out.splitlines()) == 8
        more = "--all shows 12 more metrics, each fleet, each change of the swarm, where agents head"
        assert more in " ".join(out.split())
        assert "docs/reference/metrics.md" in out
        assert shoal(capsys, "show", "r")[1].splitlines()[:-1] == out.splitlines()[:-1]
        everything = shoal(capsys, "show", "r", "--all")[1]
        assert sum(any(line.startswith(f"{name}  ") for name in words) for line in everything.splitlines()) == 20

    def test_what_differs_between_fleets_is_told_of_each(self, capsys):
        _, out, _ = shoal(
            capsys, "run", "oceans2020", "--steps", 50, "--set", "fleets.BoB-1.strategy=lattice",
            "--set", "fleets.BoB-1.neighbors=all", "--set", f"fleets.BoB-1.name={'far ' * 10}",
        )  # fmt: skip
        told = " ".join(out.split())
        assert "strategy lattice (far" in told
        assert "knn-pso (BoB-0)" in told
        assert "20 (BoB-0)" in told
        assert "…" not in "".join(line for line in out.splitlines() if not line.startswith("fleet"))

    def test_those_who_join_later_are_told_apart(self, capsys):
        _, out, _ = shoal(capsys, "run", "aamas2020", "--steps", 50, "--set", 'joins=[{step=20,count=9,fleet="BoB-0"}]')
        assert "9 of them join later" in out


BAD = [
    (["run", "ocean2020"], "did you mean 'oceans2020'"),
    (["run", "missing.toml"], "no preset and no file"),
    (["run", "oceans2020", "-k", "50"], "can hear at most 49"),
    (["run", "oceans2020", "-k", "x"], "integer"),
    (["run", "oceans2020", "-k", "3.5"], "integer"),
    (["run", "oceans2020", "--target-speed=-3"], "targets.0.speed: -3"),
    (["run", "oceans2020", "--target-speed", "fast"], "is not a quantity in m/s"),
    (["run", "oceans2020", "--set", "network.neighbours=3"], "did you mean 'neighbors'"),
    (["run", "oceans2020", "--set", "netwerk.neighbors=3"], "did you mean 'network'"),
    (["run", "oceans2020", "--set", "nothing"], "is not an assignment"),
    (["run", "oceans2020", "--fast", "60"], "from 0 to 50"),
    (["run", "aamas2020", "--fast", "5"], "one make of agents only"),
    (["run", "oceans2020", "--agents", "1"], "2 or more"),
    (["run", "oceans2020", "--steps", "0"], "steps"),
    (["run", "oceans2020", "--runs", "0"], "ask for 1 or more"),
    (["run", "oceans2020", "--strategy", "knn"], "did you mean 'knn-pso'"),
    (["run", "oceans2020", "--strategy", "./none.py"], "cannot be read"),
    (["run", "oceans2020", "--figure", "f.bmp"], "not a format of a figure"),
    (["run", "oceans2020", "--track-id", "a=b"], "needs --target-track"),
    (["run", "oceans2020", "--target-track", "none.csv"], "no such file"),
    (["run", "oceans2020", "--target-track", "empty.csv"], "empty"),
    (["run", "oceans2020", "--target-track", "nan.csv"], "1 usable fix, but a track needs 2 or more (Fixes dropped"),
    (["run", "oceans2020", "--target-track", "backwards.csv"], "backwards.csv:3"),
    (["run", "oceans2020", "--target-track", "noon.csv"], "noon.csv:2: time 'noon' cannot be read"),
    (["run", "oceans2020", "--target-track", "us.csv"], "--set targets.0.day_first=true"),
    (["run", "oceans2020", "--target-track", "us.csv", "--set", "targets.0.day_first=maybe"], "day_first"),
    (["run", "oceans2020", "--target-track", "us.csv", "--set", "targets.0.max_speed=fast"], "max_speed"),
    (["run", "oceans2020", "--target-track", "b\udcfcrg.csv"], "b\\udcfcrg.csv: is not text in the encoding"),
    (["run", "oceans2020", "--steps", "10", "--out", "/proc/none/r"], "cannot be written"),
    (["run", "oceans2020", "--steps", "10", "--out", "full"], "exists already"),
    (["run", "oceans2020", "--frobnicate"], "--frobnicate"),
    (["run"], "SCENARIO"),
    (["show", "full"], "is not a record"),
    (["check", "bad.toml"], "bad.toml:2 stepz: unknown field"),
    (["scenario", "nope"], "no preset"),
    (["sweep", "oceans2020", "--vary", "neighbors=10:60:10", "--out", "s"], "can hear at most 49"),
    (["sweep", "oceans2020", "--vary", "neighbors=3,4"], "--out DIR"),
    (["sweep", "oceans2020", "--vary", "neighbors", "--out", "s"], "field=1,2,3"),
    (["results", "full"], "holds no sweep"),
    (["plot", "full"], "holds no sweep"),
]


class TestBadInput:
    @pytest.fixture(autouse=True)
    def files(self):
        Path("empty.csv").write_text("")
        Path("nan.csv").write_text("time,lat,lon\n2020-01-01T00:00:00Z,50,1\n2020-01-01T00:01:00Z,nan,1\n")
        stamps = ("00:01", "00:00", "00:02", "00:03", "00:04")
        lines = [f"2020-01-01T{stamp}:00Z,50.00{i},1\n" for i, stamp in enumerate(stamps)]
        Path("backwards.csv").write_text("time,lat,lon\n" + "".join(lines))
        Path("noon.csv").write_text("time,lat,lon\nnoon,50,1\n")
        Path("us.csv").write_text("time,lat,lon\n03/10/2024 12:00,50,1\n03/10/2024 12:10,50,1.001\n")
        Path("bad.toml").write_text('name = "x"\nstepz = 3\n')
        Path("full").mkdir()
        Path("full/file").write_text("")

    @pytest.mark.parametrize(("tokens", "says"), BAD, ids=[" ".join(tokens) for tokens, _ in BAD])
    def test_gives_one_clear_error_and_leaves_nothing(self, capsys, tokens, says):
        before = sorted(Path().rglob("*"))
        code, out, err = shoal(capsys, *tokens)
        assert code == 2
        assert out == ""
        assert says in err
        assert err.count("shoal: ") == 1
        assert "fix:" in err
        assert "Traceback" not in err
        assert sorted(Path().rglob("*")) == before


class TestListings:
    def test_presets_strategies_scenario_check_and_schema(self, capsys):
        assert "aamas2020-constant" in shoal(capsys, "presets")[1]
        assert "knn-pso" in shoal(capsys, "strategies")[1]
        assert "reacquisition [s]" in shoal(capsys, "metrics")[1]
        assert [each["name"] for each in json.loads(shoal(capsys, "metrics", "--json")[1])] == list(METRICS)
        listed = json.loads(shoal(capsys, "strategies", "--json")[1])
        assert next(each for each in listed if each["name"] == "knn-pso")["parameters"]["delta"]["unit"] == "m"
        assert [each["name"] for each in listed if each["recommended"]] == ["cordon"]
        Path("mine.toml").write_text(shoal(capsys, "scenario", "oceans2020")[1])
        assert "fine" in shoal(capsys, "check", "mine.toml")[1]
        assert "fleets" in json.loads(shoal(capsys, "schema")[1])["properties"]

    @pytest.mark.parametrize(
        "command", ["run", "show", "sweep", "compare", "results", "plot", "check", "scenario", "strategies"]
    )
    def test_every_command_has_help(self, capsys, command):
        code, out, _ = shoal(capsys, command, "--help")
        assert code == 0
        assert command in out


class TestSweep:
    def test_dry_run_prints_the_design_and_runs_nothing(self, capsys):
        code, out, _ = shoal(capsys, "sweep", "oceans2020", "--vary", "neighbors=10,20", "--steps", 100, "--dry-run")
        assert code == 0
        assert out.splitlines()[:2] == ["neighbors=10", "neighbors=20"]
        assert "2 combinations x 5 runs = 10 runs" in out
        assert not list(Path().iterdir())

    def test_sweep_results_and_plot(self, capsys):
        pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install '.[plots]'")
        vary = ("--vary", "neighbors=10,20", "--vary", "fast=0,15")
        assert shoal(capsys, "sweep", "oceans2020", *vary, "--runs", 2, "--steps", 100, "--out", "s")[0] == 0
        assert "time on target" in shoal(capsys, "results", "s")[1]
        assert "speed [m/s]" in shoal(capsys, "results", "s", "--metric", "cost,speed")[1]
        assert "is not a metric" in shoal(capsys, "results", "s", "--metric", "speed,fun")[2]
        assert len(json.loads(shoal(capsys, "results", "s", "--json")[1])) == 8
        assert len(json.loads(shoal(capsys, "results", "s", "--by", "fast", "--json")[1])) == 2
        assert shoal(capsys, "results", "s", "--csv")[1] == Path("s/results.csv").read_text()
        assert shoal(capsys, "plot", "s")[0] == 0
        assert Path("s/plot.png").exists()
        assert "is not a metric" in shoal(capsys, "plot", "s", "--y", "fun")[2]


TRACK_OPTIONS = [
    ([], 60),
    (["--set", "targets.0.max_speed=70"], 61),
    (["--set", 'targets.0.max_speed="140 kn"'], 61),
    (["--set", "targets.0.max_gap=7200"], 60),
    (["--set", "targets.0.max_speed=70", "--set", "targets.0.max_gap=1h"], 61),
    (["--set", "targets.0.digest=null"], 60),
    (["--set", "targets.0.day_first=true"], 60),
    (["--set", "targets.0.radius=0.5 nmi"], 60),
    (["--set", "area.origin=[10.0, 54.1]"], 60),
    (["--set", "time_step=5", "--target-speed", "3"], None),
    (["--track-id", "boat=A"], 60),
    (["--set", 'targets.0.id="boat=A"'], 60),
    (["--set", "targets.0.max_speed=70", "--track-id", "all"], 61),
]


class TestTrackOptions:
    """What the how-to says of a recorded track works on the command line."""

    @pytest.fixture(autouse=True)
    def track(self):
        """61 fixes, half an hour apart; one is stamped too early, and can be reached at 62 m/s only."""
        seconds = [1800 * i - 1750 * (i == 30) for i in range(61)]
        lines = [f"{1_600_000_000 + s},{54 + 0.027 * i:.4f},10,A\n" for i, s in enumerate(seconds)]
        Path("boat.csv").write_text("time,lat,lon,boat\n" + "".join(lines))

    @pytest.mark.parametrize(("options", "fixes"), TRACK_OPTIONS, ids=[" ".join(each) for each, _ in TRACK_OPTIONS])
    def test_each_runs(self, capsys, options, fixes):
        run = ("run", "oceans2020", "--target-track", "boat.csv", *options, "--steps", 20, "--json", "--out", "r")
        code, _, err = shoal(capsys, *run)
        if fixes is None:
            assert "no target of this scenario has a speed" in err
            return
        assert code == 0, err
        assert ("could reach them: 1," in err) == (fixes == 60)

    def test_its_digest_is_of_the_options_used(self, capsys):
        digests = set()
        for n, options in enumerate(([], ["--set", "targets.0.max_speed=70"], ["--set", "targets.0.max_gap=7200"])):
            run = ("run", "oceans2020", "--target-track", "boat.csv", *options, "--steps", 5, "--out", f"r{n}")
            assert shoal(capsys, *run)[0] == 0
            scenario = json.loads(Path(f"r{n}/record.json").read_text())["scenario"]
            digests.add(scenario["targets"][0]["digest"])
        assert len(digests) == 3

    def test_a_scenario_made_with_it_insists_on_it_until_it_is_read_in_another_way(self, capsys):
        assert shoal(capsys, "run", "oceans2020", "--target-track", "boat.csv", "--steps", 5, "--out", "r")[0] == 0
        scenario = json.loads(Path("r/record.json").read_text())["scenario"]
        Path("mine.toml").write_text(to_toml(scenario_from(scenario)))
        assert shoal(capsys, "run", "mine.toml")[0] == 0
        assert shoal(capsys, "run", "mine.toml", "--set", "targets.0.max_speed=70")[0] == 0
        assert shoal(capsys, "run", "mine.toml", "--set", "targets.0.digest=null")[0] == 0
        text = Path("boat.csv").read_text()
        Path("boat.csv").write_text(text.replace("54.5400", "54.5500"))
        assert "does not hold the track" in shoal(capsys, "run", "mine.toml")[2]


class TestTracks:
    """Real files, beside the repository."""

    def test_a_real_ferry(self, capsys):
        file = SHARED / "solent" / "solent_ais_2016-01-12.csv"
        if not file.is_file():
            pytest.skip("the real AIS data is not beside this repository")
        code, out, _ = shoal(
            capsys, "run", "oceans2020", "--target-track", file, "--track-id", "mmsi=235069877", "--steps", 2000,
            "--set", "time_step=2.5", "--out", "ferry", "--figure", "ferry.png", "--json",
        )  # fmt: skip
        assert code == 0
        scenario = json.loads(Path("ferry/record.json").read_text())["scenario"]
        factor = scenario["area"]["width"] / 20
        assert 5000 < scenario["area"]["width"] < 20000
        assert scenario["targets"][0]["radius"] == pytest.approx(factor)
        assert scenario["strategy"]["repulsion_max"] == pytest.approx(1.5 * factor)
        assert [fleet["max_speed"] for fleet in scenario["fleets"]] == [2.6, 1.0]
        assert json.loads(out)["target_present"]["mean"] > 0.9

    def test_a_real_drifter_with_gaps(self, capsys):
        file = SHARED / "mab" / "mab_drifters_uscg_sldmb.csv"
        if not file.is_file():
            pytest.skip("the real drifter data is not beside this repository")
        code, out, err = shoal(
            capsys, "run", "oceans2020", "--target-track", file, "--track-id", "drifter_id=8213480", "--steps", 3000,
            "--set", "time_step=700", "--json",
        )  # fmt: skip
        assert code == 0
        assert 0.5 < json.loads(out)["target_present"]["mean"] < 0.9
        assert "Silences longer than" in err


class TestProcess:
    def test_ctrl_c_exits_with_130_and_leaves_nothing(self, tmp_path):
        process = subprocess.Popen(
            [sys.executable, "-m", "shoal", "run", "oceans2020", "--steps", "50000000", "--out", str(tmp_path / "r")],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True,
        )  # fmt: skip
        wait_until(process, (tmp_path / "r").exists)
        os.killpg(process.pid, signal.SIGINT)
        try:
            _, said = process.communicate(timeout=100)
        finally:
            process.kill()
        assert process.returncode == 130
        assert "interrupted; nothing was left half-written" in said
        assert "Traceback" not in said
        assert list(tmp_path.iterdir()) == []


@pytest.fixture(autouse=True)
def _own_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
