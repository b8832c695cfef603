"""shoal compare: what it prints, keeps, draws, and says of bad input."""

import json
import sqlite3
import uuid
from pathlib import Path

import pytest

from commands import shoal

SHORT = ("--steps", 200, "--runs", 3)
MINE = """
from typing import NamedTuple
import shoal
class Params(NamedTuple):
    spare: float = 0.0
@shoal.strategy("mine", params=Params)
def decide(me, heard, memory, params, draw):
    return {velocity}
"""


def started(folder):
    """When every run of a store was started."""
    database = sqlite3.connect(Path(folder) / "runs.sqlite")
    try:
        return dict(database.execute("SELECT run_id, started FROM timing"))
    finally:
        database.close()


@pytest.fixture(autouse=True)
def _own_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


class TestTable:
    def test_strategies_are_ranked_beside_the_lattice_and_nothing_is_left(self, capsys):
        code, out, err = shoal(capsys, "compare", "knn-pso", "pursuit", *SHORT)
        assert code == 0
        lines = [line.split() for line in out.splitlines()]
        assert sorted(line[1] for line in lines if line and line[0] in ("1", "2")) == ["knn-pso", "lattice"]
        assert ["know", "the", "target:"] in lines
        assert next(line for line in lines if "pursuit" in line)[0] == "–"
        assert "standing still (lattice) ranks" in out
        assert "Traceback" not in err
        assert not list(Path().iterdir())

    def test_json_is_one_object(self, capsys):
        _, out, _ = shoal(capsys, "compare", "knn-pso", *SHORT, "--vary", "target-speed=3,5", "--seed", 7, "--json")
        found = json.loads(out)
        assert (found["metric"], found["better"], found["baseline"]) == ("time_on_target", "higher", "knn-pso")
        assert (found["runs"], found["steps"], found["seed"], found["tests"]) == (3, 200, 7, 2)
        assert [each["condition"] for each in found["conditions"]] == [{"target_speed": 3}, {"target_speed": 5}]
        for condition in found["conditions"]:
            by_name = {each["strategy"]: each for each in condition["strategies"]}
            mine, still = by_name["knn-pso"], by_name["lattice"]
            assert mine["difference"] is None
            assert set(still["difference"]) == {"mean", "ci95", "p", "adjusted_p", "pairs"}
            each_run = [one - other for one, other in zip(still["runs"], mine["runs"], strict=True)]
            assert still["difference"]["mean"] == pytest.approx(sum(each_run) / 3)
            assert (still["rank"], still["missing"], still["informed"]) == (still["rank"], 0, False)

    def test_less_is_better_where_it_is(self, capsys):
        _, out, _ = shoal(capsys, "compare", "knn-pso", *SHORT, "--metric", "power", "--json")
        found = json.loads(out)
        (condition,) = found["conditions"]
        assert found["better"] == "lower"
        assert [each["strategy"] for each in condition["strategies"]] == ["lattice", "knn-pso"]

    def test_a_strategy_from_a_file(self, capsys):
        never_compiled = f"# {uuid.uuid4()}\n"  # kernels of an earlier run of the tests may be kept
        Path("mine.py").write_text(MINE.format(velocity="0.0, 0.0") + never_compiled)
        _, out, err = shoal(capsys, "compare", "mine.py", *SHORT, "--metric", "speed", "--json")
        found = {each["strategy"]: each for each in json.loads(out)["conditions"][0]["strategies"]}
        assert found["mine"]["mean"] < 0.1 < found["lattice"]["mean"]
        assert "compiling mine" in err


class TestStore:
    def test_the_same_command_computes_nothing_again_and_more_runs_and_strategies_are_added(self, capsys):
        command = ("compare", "knn-pso", "--steps", 200, "--out", "s", "--json")
        first = shoal(capsys, *command, "--runs", 2)[1]
        before = started("s")
        assert shoal(capsys, *command, "--runs", 2)[1] == first
        assert started("s") == before
        shoal(capsys, *command, "pursuit", "--runs", 3)
        after = started("s")
        assert len(after) == 9
        assert after.items() >= before.items()
        assert shoal(capsys, *command, "--runs", 2)[1] == first
        assert "knn-pso" in shoal(capsys, "results", "s")[1]

    def test_an_interrupt_says_how_to_go_on(self, capsys, monkeypatch):
        def interrupted(*arguments, **options):
            raise KeyboardInterrupt

        monkeypatch.setattr("shoal.experiments.run_comparison.sweep", interrupted)
        code, out, err = shoal(capsys, "compare", "knn-pso", *SHORT, "--out", "s")
        assert (code, out) == (130, "")
        assert "the same command continues from there" in err

    def test_failed_runs_are_told_and_left_out(self, capsys):
        Path("mine.py").write_text(MINE.format(velocity="0.0 / max(0.0, 19.85 - me.time), 0.0"))  # at the last step
        code, out, err = shoal(capsys, "compare", "knn-pso", "mine.py", *SHORT, "--json")
        found = {each["strategy"]: each for each in json.loads(out)["conditions"][0]["strategies"]}
        assert code == 0
        assert found["mine"]["missing"] == 3
        assert (found["mine"]["rank"], found["mine"]["mean"], found["mine"]["verdict"]) == (None, None, "too few runs")
        assert "3 runs failed" in err
        assert "not finite" in err


class TestFigure:
    @pytest.mark.parametrize(
        "vary", [[], ["--vary", "target-speed=3,5"], ["--vary", "fleets.BoB-1.start=corner,center"]]
    )
    def test_bars_curves_and_panels_are_drawn(self, capsys, vary):
        pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install '.[plots]'")
        code, _, _ = shoal(capsys, "compare", "knn-pso", *SHORT, *vary, "--figure", "f.png")
        assert code == 0
        assert Path("f.png").read_bytes().startswith(b"\x89PNG")


class TestSuite:
    def test_a_small_arena_prints_a_leaderboard_and_writes_its_page(self, capsys):
        small = ("compare", "knn-pso", "--suite", "arena", "--steps", 60, "--runs", 2, "--out", "a")
        code, out, err = shoal(capsys, *small, "--markdown", "arena.md", "--figure", "arena.svg")
        assert code == 0
        assert "arena: 2 runs of 60 steps under each of 7 conditions, seed 4242" in out
        assert "200 agents (7 of 7)" in err
        page = Path("arena.md").read_text()
        assert "`shoal compare knn-pso --suite arena --runs 2 --steps 60`" in page
        assert "half-lost" in [each.name for each in Path("a").iterdir()]
        assert "knn-pso" in shoal(capsys, "results", "a/half-lost")[1]

        found = json.loads(shoal(capsys, *small, "--json", "--markdown", "arena.md")[1])
        assert Path("arena.md").read_text() == page
        assert found["hash"] in page
        assert found["conditions"][0]["name"] == "3 m/s"
        assert {each["strategy"] for each in found["score"]} == {"knn-pso", "lattice"}
        for condition in found["conditions"]:
            assert all(0.0 <= each["mean"] <= 1.0 for each in condition["strategies"])


BAD = [
    (["knn"], "did you mean 'knn-pso'"),
    ([], "there is only the lattice"),
    (["lattice"], "there is only the lattice"),
    (["./none.py"], "cannot be read"),
    (["broken.py", "--steps", "50"], "cannot be compiled"),
    (["knn-pso", "--suite", "areno"], "did you mean 'arena'"),
    (["knn-pso", "--suite", "arena", "--scenario", "aamas2020"], "--scenario: does not go with --suite"),
    (["knn-pso", "--suite", "arena", "--vary", "fast=0,15"], "--vary: does not go with --suite"),
    (["knn-pso", "--suite", "arena", "--markdown", "broken.py"], "has no place for the leaderboard"),
    (["knn-pso", "--markdown", "page.md"], "needs --suite"),
    (["knn-pso", "--metric", "tot"], "is not a metric"),
    (["knn-pso", "--baseline", "levy-walk"], "is not compared"),
    (["knn-pso", "--scenario", "ocean2020"], "did you mean 'oceans2020'"),
    (["knn-pso", "--vary", "strategy.delta=0.1,0.2"], "strategies are what is compared"),
    (["knn-pso", "--vary", "neighbors=3,60"], "can hear at most 49"),
    (["knn-pso", "--set", "netwerk.neighbors=3"], "did you mean 'network'"),
    (["knn-pso", "--runs", "0"], "give a number above 0"),
    (["knn-pso", "--figure", "f.bmp"], "not a format of a figure"),
]


class TestBadInput:
    @pytest.mark.parametrize(("tokens", "says"), BAD, ids=[" ".join(tokens) or "nothing" for tokens, _ in BAD])
    def test_gives_one_clear_error_and_leaves_nothing(self, capsys, tokens, says):
        Path("broken.py").write_text(MINE.format(velocity="heard.no_such_field, 0.0"))
        code, out, err = shoal(capsys, "compare", *tokens)
        assert code == 2
        assert out == ""
        assert says in err
        assert err.count("fix:") == 1
        assert "Traceback" not in err
        assert [each.name for each in Path().iterdir() if each.name != "__pycache__"] == ["broken.py"]
