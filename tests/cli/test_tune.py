"""shoal tune: what it prints, keeps through a kill, and says of bad input."""

import json
import os
import signal
import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest

from commands import shoal, wait_until
from shoal.cli.main import BAD_INPUT
from shoal.experiments.tune import TuneResult

TUNE = ("tune", "oceans2020", "--vary", "neighbors=5:40", "--vary", "strategy.delta=0.002:0.05")
MORE = ("--maximize", "time_on_target")
SHORT = ("--steps", 100, "--trials", 6, "--runs", 2, "--final-runs", 3)


@pytest.fixture(autouse=True)
def _own_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def rows_in(folder):
    try:
        database = sqlite3.connect(f"file:{folder}/runs.sqlite?mode=ro", uri=True)
        return database.execute("SELECT count(*) FROM runs").fetchone()[0]
    except sqlite3.OperationalError:  # not there yet
        return 0


def test_start_and_best_stand_side_by_side_and_nothing_is_left(capsys):
    code, out, err = shoal(capsys, *TUNE, *MORE, *SHORT)
    assert code == 0
    for words in ("start", "best", "neighbors", "in the search", "on fresh seeds", "95 % interval"):
        assert words in out
    assert "no difference shown" in out
    assert "next: shoal run" not in err
    assert not list(Path().iterdir())


def test_the_next_command_has_what_was_said_and_what_was_found(capsys, monkeypatch):
    monkeypatch.setattr(TuneResult, "verdict", "better")
    err = shoal(capsys, *TUNE, *MORE, *SHORT, "--set", "network.loss=0.1")[2]
    assert "next: shoal run oceans2020 --set network.loss=0.1 --set neighbors=" in err


def test_json_and_a_figure(capsys):
    _, out, _ = shoal(capsys, *TUNE, *MORE, *SHORT, "--json", "--figure", "t.png", "--condition", "5 m/s",
                      "--condition", "network.loss=0.3")  # fmt: skip
    found = json.loads(out)
    assert found["conditions"] == ["5 m/s", "network.loss=0.3"]
    assert len(found["best"]["runs"]) == found["difference"]["pairs"] == 3
    assert found["start"]["values"] == {"neighbors": 20, "strategy.delta": 0.01}
    assert Path("t.png").read_bytes()[:4] == b"\x89PNG"


def test_killed_again_and_again_it_ends_as_if_it_had_not_been(capsys):
    command = [*map(str, (*TUNE, *MORE, "--steps", 3000, "--trials", 10, "--runs", 2, "--final-runs", 2, "--json"))]
    _, whole, _ = shoal(capsys, *command)
    left = []
    for least in (1, 11):
        process = subprocess.Popen(
            [sys.executable, "-m", "shoal", *command, "--jobs", "1", "--out", "kept"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
        )  # fmt: skip
        wait_until(process, lambda least=least: rows_in("kept/search") >= least)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        left.append(rows_in("kept/search"))
    assert 1 <= left[0] < 22
    assert left[0] <= left[1]
    _, resumed, _ = shoal(capsys, *command, "--out", "kept")
    assert json.loads(resumed) == json.loads(whole)
    assert rows_in("kept/search") == 22


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ((*TUNE,), "--maximize: is missing"),
        ((*TUNE, *MORE, "--minimize", "power"), "are two objectives"),
        ((*TUNE, "--maximize", "time_on_targt"), "did you mean 'time_on_target'"),
        ((*TUNE, "--minimize", "time_on_target"), "higher is better"),
        (("tune", "oceans2020", *MORE), "--vary: is missing"),
        (("tune", "oceans2020", "--vary", "neighbors=40:5", *MORE), "the range is empty"),
        (("tune", "oceans2020", "--vary", "neighbors=5:400", *MORE), "neighbors=400"),
        ((*TUNE, *MORE, "--condition", "half losst"), "did you mean 'half lost'"),
        ((*TUNE, *MORE, "--condition", "neighbors=5"), "set network.neighbors twice"),
        ((*TUNE, *MORE, "--set", "neighbors=5"), "set network.neighbors twice"),
        ((*TUNE, *MORE, "--trials", 0), "--trials: is 0"),
        (("sweep", "oceans2020", "--vary", "strategy.delta=0.002:0.05", "--out", "s"), "`shoal tune` search"),
    ],
)
def test_bad_input_is_one_message_and_nothing_is_written(words, told, capsys):
    code, out, err = shoal(capsys, *words)
    assert (code, out) == (BAD_INPUT, "")
    assert told in err
    assert err.count("fix:") == 1
    assert not list(Path().iterdir())
