"""A metric of an installed package is one like ours, and changes nothing else; one that is broken is one sentence."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/how-to/own-metric.md").read_text(encoding="utf-8")
(CROWDING,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
(OFFER,) = re.findall(r'entry-points."shoal.metrics"\]\ncrowding = "(\w+)"', PAGE)
TINY = str(ROOT / "tests/data/tiny.toml")
SWEEP = ("sweep", TINY, "--vary", "neighbors=2,3", "--out", "swept", "--jobs", "1")

LOOK = f"""
import json, shoal
record = shoal.simulate({TINY!r})
shoal.save_record(record, "record")
simulation = shoal.Simulation({TINY!r})
simulation.advance(3)
simulation.save("state.npz")
print(json.dumps({{
    "listed": shoal.list_metrics()["crowding"]._asdict(),
    "mean": record.estimate("crowding").mean,
    "rows": [row["metric"] for row in record.to_pandas().to_dict("records")],
    "by hand": float(record.tallies[0].crowded.sum() / record.tallies[0].agent_steps.sum()),
    "state": "tally.crowded" in simulation.state(),
}}))
"""
RESTORE = f"""
import json, shoal
simulation = shoal.Simulation({TINY!r})
simulation.restore("state.npz")
simulation.advance(3)
print(json.dumps([shoal.open_record("record").estimate("xi").mean, simulation.notes]))
"""


def install(folder, text=CROWDING, name="crowding", offers="crowding"):
    """Put a package of one module into a folder."""
    folder.mkdir(exist_ok=True)
    (folder / f"{name}.py").write_text(text, encoding="utf-8")
    info = folder / f"{name}-1.0.dist-info"
    info.mkdir(exist_ok=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n", encoding="utf-8")
    (info / "entry_points.txt").write_text(f"[shoal.metrics]\n{offers} = {name}\n", encoding="utf-8")
    return folder


def python(where, site, *arguments):
    """Run Python in a folder, with the packages of another installed; return exit code, stdout, stderr."""
    path = os.pathsep.join(filter(None, [site and str(site), os.environ.get("PYTHONPATH")]))
    done = subprocess.run(
        [sys.executable, *arguments],
        cwd=where, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    return done.returncode, done.stdout, done.stderr


def shoal(where, site, *tokens):
    return python(where, site, "-m", "shoal", *tokens)


@pytest.fixture(scope="module")
def crowding(tmp_path_factory):
    """The folder of the how-to's package."""
    assert OFFER == "crowding"
    return install(tmp_path_factory.mktemp("site"))


@pytest.fixture(scope="module")
def seen(crowding, tmp_path_factory):
    """What Python sees of it, and the folder with a record and a saved state."""
    pytest.importorskip("pandas", reason="data frames need pandas: pip install '.[sweep]'")
    where = tmp_path_factory.mktemp("seen")
    code, out, err = python(where, crowding, "-c", LOOK)
    assert code == 0, err
    return json.loads(out), where


class TestTheHowTo:
    def test_has_a_row_more_and_no_other_number_moves(self, crowding, tmp_path):
        code, out, err = shoal(tmp_path, crowding, "run", TINY, "--runs", "2", "--json")
        assert code == 0, err
        more, less = json.loads(out), json.loads(shoal(tmp_path, None, "run", TINY, "--runs", "2", "--json")[1])
        assert 0.0 <= more.pop("crowding")["mean"] <= 1.0
        assert more["units"].pop("crowding") == "1"
        for times in ("seconds", "started"):
            del more[times], less[times]
        assert more == less

    def test_is_in_the_table(self, crowding, tmp_path):
        _, out, _ = shoal(tmp_path, crowding, "run", TINY)
        assert re.search(r"^crowding +[0-9]", out, flags=re.MULTILINE)

    def test_is_listed_estimated_and_in_data_frames(self, seen):
        found, _ = seen
        assert found["listed"] == {
            "name": "crowding",
            "unit": "1",
            "direction": "less is better",
            "sentence": "share of agents with another within a meter",
        }
        assert found["mean"] == pytest.approx(found["by hand"])
        assert "crowding" in found["rows"]
        assert found["state"]

    def test_its_record_and_saved_state_open_without_it(self, seen):
        _, where = seen
        code, out, err = python(where, None, "-c", RESTORE)
        assert code == 0, err
        xi, notes = json.loads(out)
        assert xi > 0.0
        assert notes == ["the saved state has a sum 'crowded', which no installed package knows: it is dropped"]


class TestASweep:
    """Begun without a metric, gone on with, and without again."""

    def test_gains_a_column_and_old_rows_have_nothing_in_it(self, crowding, tmp_path):
        assert shoal(tmp_path, None, *SWEEP, "--runs", "1")[0] == 0
        code, _, err = shoal(tmp_path, crowding, *SWEEP, "--runs", "2")
        assert code == 0, err
        rows = json.loads(shoal(tmp_path, crowding, "results", "swept", "--json")[1])
        assert [row["crowding"] is None for row in rows] == [row["run"] == 0 for row in rows]
        for how in ([], ["--csv", "--by", "neighbors"]):
            assert shoal(tmp_path, crowding, "results", "swept", *how)[0] == 0
        code, _, err = shoal(tmp_path, crowding, "plot", "swept", "--y", "crowding")
        assert code == 0, err
        code, _, err = shoal(tmp_path, None, *SWEEP, "--runs", "3")
        assert code == 0, err
        code, out, err = shoal(tmp_path, None, "results", "swept", "--json")
        assert "left out: crowding" in err
        assert {"crowding"}.isdisjoint(json.loads(out)[0])
        again = json.loads(shoal(tmp_path, crowding, "results", "swept", "--json")[1])
        assert [row["crowding"] is None for row in again] == [row["run"] != 1 for row in again]


class TestABrokenPackage:
    """One sentence, exit code 2, no traceback."""

    @pytest.mark.parametrize(
        ("was", "now", "says"),
        [
            ("import shoal\n", "import no_such_module\n", "cannot be imported: ModuleNotFoundError"),
            ('"batch", "agent"', '"batch", "fish"', "its shape goes on with neither 'fleet', 'agent', 'target'"),
            ('"crowding", "1"', '"xi", "1"', "metric 'xi' is there already; give it another name"),
            ('Sum("crowded"', 'Sum("heard"', "sum 'heard' is there already; give it another name"),
            ('Metric(\n            "crowding"', 'Metric(\n            "Crowding!"', "is not called in small letters"),
            ('better="lower"', 'better="less"', "better is 'less', none of 'higher', 'lower', 'neither'"),
            ("crowding, better", "None, better", "its formula is not a function"),
            ("high=1.0", 'high="all"', "its bounds are not numbers"),
            ("tally.crowded.sum()", "tally.crowd.sum()", "the formula of its metric 'crowding' fails: AttributeError"),
            ("MEASUREMENT =", "MEASUREMENTS =", "crowding declares no measurement"),
            ("tally.crowded[step", "no_such_name[step", "a kernel of it cannot be compiled"),
        ],
    )
    def test_is_named_with_what_is_wrong(self, tmp_path, monkeypatch, was, now, says):
        monkeypatch.setenv("NUMBA_OPT", "1")  # what is compiled on the way there is never run
        assert was in CROWDING
        site = install(tmp_path / "site", CROWDING.replace(was, now, 1))
        code, _, err = shoal(tmp_path, site, "run", TINY)
        assert code == 2, err
        assert "package 'crowding'" in err
        assert says in err
        assert "fix: " in err
        assert "Traceback" not in err

    def test_harms_nothing_that_measures_nothing(self, tmp_path):
        site = install(tmp_path / "site", "1 / 0")
        assert shoal(tmp_path, site, "check", TINY, "--quick")[0] == 0
        assert shoal(tmp_path, site, "strategies")[0] == 0

    def test_the_name_of_one_of_ours_is_taken(self, tmp_path):
        site = install(
            tmp_path / "site", CROWDING.replace('"crowding",\n    sums', '"effort",\n    sums'), offers="effort"
        )
        assert "offers a measurement called 'effort', as a built-in one is" in shoal(tmp_path, site, "run", TINY)[2]
