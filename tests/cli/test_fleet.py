"""shoal fleet, as a user gives it."""

import importlib.util
import json
import sys

import pytest

from commands import shoal
from scenarios import scenario
from shoal.run.fleet.run_fleet import Terms, check_terms

SMALL = ("oceans2020", "--steps", 20, "--mesh", "memory")


def test_its_record_has_the_simulator_s_trajectory(capsys, tmp_path):
    code, out, err = shoal(capsys, "fleet", *SMALL, "--kill", "7@10", "--out", tmp_path / "fleet")
    assert (code, "time on target" in out, "lost at step 10: buoy 7" in err) == (0, True, True)
    losses = "losses=[{step=10,agents=[7]}]"
    assert shoal(capsys, "run", *SMALL[:3], "--set", losses, "--every", 1, "--out", tmp_path / "run")[0] == 0
    shown = [json.loads(shoal(capsys, "show", tmp_path / name, "--json")[1]) for name in ("fleet", "run")]
    assert len(shown[0]["trajectory_sha256"]) == 64
    assert shown[0]["trajectory_sha256"] == shown[1]["trajectory_sha256"]
    assert shown[0]["scenario_hash"] == shown[1]["scenario_hash"]


def test_a_record_that_lacks_steps_has_no_sum(capsys, tmp_path):
    shoal(capsys, "run", *SMALL[:3], "--every", 2, "--out", tmp_path / "run")
    assert json.loads(shoal(capsys, "show", tmp_path / "run", "--json")[1])["trajectory_sha256"] is None


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--kill", "7"], "write BUOY@STEP"),
        (["--kill", "50@3"], "a buoy from 0 to 49"),
        (["--processes", "2"], "leave out --processes"),
        (["--speed", "0"], "give 0.001 to 1000"),
        (["--strategy", "pursuit"], "no buoy can know"),
        (["--steps", "5", "--for", "1 min"], ""),
        (["--for", "tomorrow"], ""),
    ],
)
def test_what_cannot_be_is_one_sentence(capsys, tmp_path, options, words):
    code, out, err = shoal(capsys, "fleet", "oceans2020", "--mesh", "memory", *options, "--out", tmp_path / "fleet")
    assert (code, out) == (2, "")
    assert words in err
    assert "Traceback" not in err
    assert not (tmp_path / "fleet").exists()


def test_without_zenoh_it_says_what_to_install(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "zenoh", None)
    code, out, err = shoal(capsys, "fleet", "oceans2020", "--steps", 5)
    assert (code, out) == (2, "")
    assert "zenoh: is not installed, and a mesh between processes needs it" in err
    assert "[fleet]" in err


@pytest.mark.parametrize(
    "loss", ["{step=5}", "{step=5,count=1,agents=[3]}", "{step=5,agents=[3,3]}", "{step=5,agents=[50]}"]
)
def test_a_loss_that_cannot_be(capsys, loss):
    code, _, err = shoal(capsys, "fleet", *SMALL, "--set", f"losses=[{loss}]")
    assert code == 2
    assert "losses.0" in err or "loss" in err
    assert "Traceback" not in err


def test_without_the_viewer_it_says_so_before_anything_else(capsys, monkeypatch):
    real = importlib.util.find_spec
    monkeypatch.setattr("shoal.viewer.server.find_spec", lambda name: None if name == "starlette" else real(name))
    code, out, err = shoal(capsys, "fleet", *SMALL, "--watch", "--no-browser")
    assert (code, out, err.count("\n")) == (2, "", 2)
    assert err.startswith("shoal: starlette: is not installed, and watching a run in a browser needs it")


def test_a_kill_that_takes_others_with_it_says_whom():
    chosen = scenario("oceans2020")
    assert check_terms(chosen, Terms(processes=2, kill=("3@100",))) == [
        "--kill 3@100 ends buoys 0-24, which are in one process; --processes 50 gives each its own"
    ]
    assert check_terms(chosen, Terms(processes=50, kill=("3@100",))) == []
    assert check_terms(chosen, Terms(mesh="memory", kill=("3@100",))) == []
