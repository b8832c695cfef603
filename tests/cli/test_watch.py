"""shoal watch, as a process: it serves, records, and goes quietly."""

import contextlib
import json
import re
import signal
import socket
import subprocess
import sys
import time
import urllib.request

import numpy as np
import pytest

from scenarios import scenario
from shoal.cli.main import BAD_INPUT, run_command
from shoal.record.files import open_record
from shoal.run.change_log import ChangeLog, Entry, Logged
from shoal.run.changes import Change, Drag, Kill
from shoal.run.replay_changes import replay_changes
from shoal.run.simulate import simulate
from shoal.scenario.load import read_table, scenario_from

SOON = 120.0  # [s] a busy machine may take that long, and may compile


@contextlib.contextmanager
def watch(*tokens):
    """A running `shoal watch` and its address."""
    command = [sys.executable, "-m", "shoal", "watch", "--no-browser", *map(str, tokens)]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    try:
        told = ""
        while not (found := re.search(r"http://\S+/", told)):
            line = process.stderr.readline()
            assert line, told
            told += line
        yield process, found.group()
    finally:
        process.kill()
        process.wait()
        process.stdout.close()
        process.stderr.close()


def interrupt(process):
    """Ctrl-C; return exit code and what else it said."""
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=SOON)
    return process.returncode, told


def refused(capsys, *tokens):
    """The one message of a command that cannot be."""
    assert run_command([str(token) for token in tokens]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    return told.err


class TestWatch:
    def test_it_serves_the_page_and_ends_quietly(self):
        with watch("oceans2020") as (process, address):
            assert address.startswith("http://127.0.0.1:")
            with urllib.request.urlopen(address, timeout=SOON) as answer:
                assert b"app.js" in answer.read()
            assert interrupt(process) == (0, "")
        with pytest.raises(OSError, match="refused"):
            urllib.request.urlopen(address, timeout=5)

    def test_a_second_run_beside_it(self):
        with watch("oceans2020", "--against", "neighbors=5") as (process, address):
            from websockets.sync.client import connect

            with connect(address.replace("http", "ws") + "live") as page:
                assert json.loads(page.recv(timeout=SOON))["runs"] == 2
                told = [json.loads(page.recv(timeout=SOON)) for _ in range(4)]  # two histories, two scenes
            scenes = [each for each in told if each["type"] == "scene"]
            assert [told["scene"]["neighbors"] for told in scenes] == [20, 5]
            assert interrupt(process) == (0, "")

    def test_a_record_is_played(self, tmp_path):
        simulate(scenario(changes={"steps": 50, "name": "played"}), out=tmp_path / "r")
        with watch(tmp_path / "r") as (process, address):
            with urllib.request.urlopen(address, timeout=SOON) as answer:
                assert b'"name":"played"' in answer.read()
            assert interrupt(process) == (0, "")


class TestRecording:
    def test_the_whole_run_is_the_record_that_run_makes(self, tmp_path):
        with watch("oceans2020", "--steps", 300, "--speed", 1000, "--out", tmp_path / "r") as (process, _):
            begun = time.monotonic()
            while not (tmp_path / "r").exists():
                assert time.monotonic() - begun < SOON
                time.sleep(0.05)
            assert interrupt(process)[0] == 0
        watched, plain = open_record(tmp_path / "r"), simulate(scenario(changes={"steps": 300}))
        assert watched.scenario == plain.scenario
        assert watched.provenance["scenario_hash"] == plain.provenance["scenario_hash"]
        for one, other in zip(watched.tallies[0], plain.tallies[0], strict=True):
            assert one.tobytes() == other.tobytes()
        for name, values in watched.trajectories[0].arrays().items():
            assert np.array_equal(values, plain.trajectories[0].arrays()[name])

    def test_interrupted_it_says_how_many_steps_it_is_of(self, tmp_path):
        with watch("oceans2020", "--out", tmp_path / "r") as (process, _):
            time.sleep(1.5)
            code, told = interrupt(process)
        record = open_record(tmp_path / "r")
        steps = record.provenance["steps"]
        assert code == 0
        assert f"{steps:,} of 100,000 steps" in told
        assert 0 < steps < 1000
        assert record.scenario.steps == steps == record.tallies[0].steps.sum()

    def test_a_folder_that_exists_is_refused_at_once(self, capsys, tmp_path):
        (tmp_path / "r").mkdir()
        (tmp_path / "r" / "mine").touch()
        assert "exists already" in refused(capsys, "watch", "oceans2020", "--no-browser", "--out", tmp_path / "r")
        assert [each.name for each in tmp_path.iterdir()] == ["r"]


class TestReplayingChanges:
    @pytest.fixture
    def log(self, tmp_path):
        entries = (
            Entry(20, Change(do="change", changes={"neighbors": 5})),
            Entry(50, Kill(do="kill", agent=3)),
            Entry(50, Drag(do="drag", x=2.0, y=2.0)),
        )
        table = read_table("oceans2020")
        known = ChangeLog((Logged("oceans2020", table, scenario_from(table).hash),), entries, 80)
        (tmp_path / "log.jsonl").write_text(known.text(), encoding="utf-8")
        return tmp_path / "log.jsonl"

    def test_the_record_is_the_steered_run(self, log, tmp_path):
        with watch("--replay-changes", log, "--speed", 1000, "--out", tmp_path / "r") as (process, _):
            begun = time.monotonic()
            while not (tmp_path / "r").exists():
                assert time.monotonic() - begun < SOON
                time.sleep(0.05)
            assert interrupt(process)[0] == 0
        watched, again = open_record(tmp_path / "r"), replay_changes(log)
        assert watched.steered == again.steered == (
            (20, "neighbors = 5"), (50, "buoy 3 removed"), (50, "target 0 put at (2, 2) m"),
        )  # fmt: skip
        for name, values in watched.trajectories[0].arrays().items():
            assert np.array_equal(values, again.trajectories[0].arrays()[name])

    def test_nothing_else_may_be_asked_for(self, capsys, log):
        assert "says what is run" in refused(capsys, "watch", "oceans2020", "--replay-changes", log)
        assert "says what is run" in refused(capsys, "watch", "--replay-changes", log, "-k", 4)

    def test_what_one_record_cannot_hold_is_refused_at_once(self, capsys, log, tmp_path):
        text = log.read_text() + '{"step": 60, "do": "add", "x": 0.0, "y": 0.0}\n'
        log.write_text(text)
        assert "changes fleets" in refused(capsys, "watch", "--replay-changes", log, "--out", tmp_path / "r")
        assert [each.name for each in tmp_path.iterdir()] == ["log.jsonl"]

    def test_a_file_that_is_no_log(self, capsys, tmp_path):
        (tmp_path / "mine.toml").write_text("name = 1")
        assert "not a line of a log" in refused(capsys, "watch", "--replay-changes", tmp_path / "mine.toml")


class TestBadInput:
    def test_a_port_in_use(self, capsys):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            told = refused(capsys, "watch", "oceans2020", "--no-browser", "--port", port)
        assert told == f"shoal: --port {port}: is in use\n  fix: name another, or 0 for a free one\n"

    @pytest.mark.parametrize(
        ("tokens", "words"),
        [
            (["nothere"], "no preset and no file"),
            (["oceans2020", "--against", "nothere"], "no preset and no file"),
            (["oceans2020", "--against", "neighbors=99"], "at most 49"),
            (["oceans2020", "--against", "time_step=0.2"], "time_step"),
            (["oceans2020", "--neighbors", "99"], "at most 49"),
            (["oceans2020", "--speed", "5000"], "times real time"),
            (["oceans2020", "--host", "192.0.2.1"], "not an address of this machine"),
            (["oceans2020", "--track-id", "a=b"], "needs --target-track"),
        ],
    )
    def test_is_one_message(self, capsys, tokens, words):
        told = refused(capsys, "watch", *tokens, "--no-browser")
        assert words in told
        assert "fix: " in told

    def test_a_record_cannot_be_changed(self, capsys, tmp_path):
        simulate(scenario(changes={"steps": 5}), out=tmp_path / "r")
        assert "plays as it is" in refused(capsys, "watch", tmp_path / "r", "-k", 4)

    def test_a_folder_that_is_no_record(self, capsys, tmp_path):
        assert "is not a record" in refused(capsys, "watch", tmp_path)

    def test_recording_is_of_one_run(self, capsys, tmp_path):
        told = refused(capsys, "watch", "oceans2020", "--against", "neighbors=5", "--out", tmp_path / "r")
        assert "--against shows two" in told
        assert not list(tmp_path.iterdir())


def test_a_missing_library_is_named_before_anything_is_compiled(monkeypatch, capsys):
    monkeypatch.setattr("shoal.viewer.server.find_spec", lambda name: None)
    monkeypatch.setattr("shoal.viewer.session.Session.__init__", lambda *_, **__: pytest.fail("it was compiled"))
    assert run_command(["watch", "oceans2020", "--no-browser"]) == BAD_INPUT
    assert "starlette: is not installed" in capsys.readouterr().err
