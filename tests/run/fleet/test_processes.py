"""Buoys in processes of their own, on a mesh between them; they decide in plain Python, which starts at once."""

import os
import random
import signal

import pytest

from fleets import differences
from scenarios import small
from shoal.buoy.serve import serve
from shoal.core.errors import FleetError
from shoal.core.messages import Report
from shoal.run.fleet.processes import Processes
from shoal.run.fleet.run_fleet import Terms, run_fleet

pytest.importorskip("zenoh", reason="the extra fleet is not installed")
TWO = Terms(processes=2, lockstep=True, plain=True)


@pytest.fixture
def crowds(monkeypatch):
    """The crowds that were started, of which each has the processes of a fleet."""
    found = []
    enter = Processes.__enter__

    def spied(self):
        found.append(self)
        return enter(self)

    monkeypatch.setattr(Processes, "__enter__", spied)
    return found


def test_two_processes_are_the_simulator():
    record = run_fleet(small(12, 5, {"steps": 60, "strategy": "shared-sighting"}), TWO)
    assert differences(record) == []
    assert any("of the reports that arrived 1,440 were new; 0 late" in note for note in record.provenance["notes"])


def test_noise_and_a_process_that_is_killed_from_outside(crowds):
    chance = random.Random(1)

    def progress(done, total):
        for _ in range(20):
            crowds[0].mesh.publish(chance.randbytes(chance.randrange(100)))
        if done == 20:
            os.kill(crowds[0].pids[6, 7, 8, 9, 10, 11], signal.SIGKILL)
        if done == 30:  # a buoy that is there already, and one whose place is free: the fleet is together
            for ids in ([0], range(6, 12)):
                with pytest.raises(FleetError, match="has all its buoys"):
                    serve(scenario, ids, crowds[0]._listener.address, bytes.fromhex(crowds[0]._key))

    scenario = small(12, 5, {"steps": 40})
    record = run_fleet(scenario, TWO, progress=progress)
    (loss,) = record.scenario.losses
    assert loss.agents == (6, 7, 8, 9, 10, 11)
    assert loss.step in (20, 21)  # the sea may be a step further when the news comes
    assert f"lost at step {loss.step}: buoys 6-11" in record.provenance["notes"]
    assert any("late" in note and " 0 damaged" not in note for note in record.provenance["notes"])
    assert differences(record) == []


def test_one_that_is_frozen_by_the_clock_rejoins(crowds):
    def progress(done, total):
        frozen = crowds[0].pids[6, 7, 8, 9, 10, 11]
        if done == 10:
            os.kill(frozen, signal.SIGSTOP)
        if done == 40:
            os.kill(frozen, signal.SIGCONT)
        if done > 50:  # somebody speaks as buoy 3
            crowds[0].mesh.publish(Report(3, 0.0, 0.0, 0.0, 0.0, False, (), 0.1 * (done - 1)).to_bytes())

    terms = Terms(processes=2, plain=True, speed=1.0)
    record = run_fleet(small(12, 5, {"steps": 60}), terms, progress=progress)
    silent = [note for note in record.provenance["notes"] if "was silent from" in note]
    assert len(silent) == 6
    (strange,) = [note for note in record.provenance["notes"] if "by somebody else under the number of" in note]
    assert 1 <= int(strange.split()[0]) <= 10
    assert not any(note.endswith("on") for note in silent)
    frames = record.trajectories[0]
    assert frames.alive.all()
    assert not frames.command_x[38:40, 6:].any()  # their bodies stopped
    assert frames.command_x[50:, 6:].any()
    assert frames.command_x[38:40, :6].any()


def test_a_process_that_cannot_start_says_why(tmp_path):
    file = tmp_path / "mine.py"
    file.write_text(
        "from typing import NamedTuple\nimport os, shoal\n"
        "if 'SHOAL_FLEET_KEY' in os.environ:\n    raise RuntimeError('no such board')\n"
        "class P(NamedTuple):\n    a: float = 1.0\n"
        "@shoal.strategy('mine', params=P)\ndef mine(me, heard, memory, params, draw):\n    return 0.0, 0.0\n"
    )
    with (
        pytest.raises(FleetError, match="no such board"),
        Processes(small(4, 2, {"strategy": {"file": str(file)}}), [[0, 1], [2, 3]], plain=True),
    ):
        pass


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--id", "x", "--connect", "127.0.0.1:1"], "--id: is 'x'"),
        (["--id", "1,1", "--connect", "127.0.0.1:1"], "names a buoy twice"),
        (["--id", "1", "--connect", "127.0.0.1"], "give HOST:PORT"),
        (["--id", "1", "--connect", "127.0.0.1:99999"], "give HOST:PORT"),
        (["--id", "1", "--connect", "127.0.0.1:1"], "cannot be reached"),
    ],
)
def test_a_buoy_says_in_one_sentence_what_is_wrong(capsys, monkeypatch, options, words):
    from commands import shoal

    monkeypatch.setenv("SHOAL_FLEET_KEY", "00" * 32)
    code, out, err = shoal(capsys, "buoy", "oceans2020", *options)
    assert (code, out, err.count("\n")) == (2, "", 2)
    assert words in err


def test_a_buoy_without_a_key(capsys, monkeypatch):
    from commands import shoal

    monkeypatch.delenv("SHOAL_FLEET_KEY", raising=False)
    code, _, err = shoal(capsys, "buoy", "oceans2020", "--id", "1", "--connect", "127.0.0.1:1")
    assert code == 2
    assert "$SHOAL_FLEET_KEY: holds no key" in err
