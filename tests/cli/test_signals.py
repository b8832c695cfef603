"""SIGTERM and SIGHUP end a command as Ctrl-C does: nothing half-written, what is done is kept."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from shoal.cli import main
from shoal.experiments.results import read_rows
from shoal.record.files import open_record

SIGNALS = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129}


def ended(tmp_path, number, begun, *tokens):
    """Start a command, send it a signal once it has begun; return exit code and what it said."""
    process = subprocess.Popen(
        [sys.executable, "-u", "-m", "shoal", *tokens],
        cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True,
    )  # fmt: skip
    said = ""
    while not begun(said):
        assert process.poll() is None
        if begun is _watched:
            said += process.stderr.readline()
        else:
            time.sleep(0.05)
    time.sleep(1.0)
    os.kill(process.pid, number)
    _, rest = process.communicate(timeout=100)
    assert "Traceback" not in rest, rest
    return process.returncode, said + rest


def _watched(said):
    return "watch at " in said


@pytest.mark.parametrize("number", SIGNALS)
def test_run_leaves_nothing(tmp_path, number):
    code, said = ended(
        tmp_path, number, lambda _: (tmp_path / "r").exists(), "run", "oceans2020", "--steps", "50000000", "--out", "r"
    )
    assert code == SIGNALS[number], said
    assert "interrupted; nothing was left half-written" in said
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_sweep_keeps_what_is_done(tmp_path, number):
    code, said = ended(
        tmp_path, number, lambda _: (tmp_path / "s" / "runs.sqlite").exists(),
        "sweep", "oceans2020", "--vary", "neighbors=5:44:1", "--steps", "20000", "--out", "s",
    )  # fmt: skip
    assert code == SIGNALS[number], said
    assert "the same command continues from there" in said
    assert [each.name for each in (tmp_path / "s").iterdir()] == ["runs.sqlite"]
    assert {row["status"] for row in read_rows(tmp_path / "s")[1]} <= {"done"}


@pytest.mark.parametrize("number", SIGNALS)
def test_watch_keeps_the_record_of_what_was_watched(tmp_path, number):
    pytest.importorskip("uvicorn", reason="shoal watch needs the extra viewer")
    tokens = ("watch", "oceans2020", "--no-browser", "--out", "w")
    code, said = ended(tmp_path, number, _watched, *tokens)
    assert code == 0  # that is how watching ends
    assert "record: w, " in said
    assert open_record(tmp_path / "w").scenario.steps > 0
    assert [each.name for each in tmp_path.iterdir()] == ["w"]


def test_what_nohup_says_is_heeded(tmp_path):
    script = (
        "import signal; signal.signal(signal.SIGHUP, signal.SIG_IGN); from shoal.cli.signals import heed_signals; "
        "heed_signals(); print(signal.getsignal(signal.SIGHUP) == signal.SIG_IGN, signal.getsignal(signal.SIGTERM))"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=Path(tmp_path), capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith("True <function _end")


@pytest.mark.skipif(sys.version_info >= (3, 12), reason="Python hands it on as it is")
def test_an_interrupt_that_an_import_made_another_error_of(monkeypatch, capsys):
    """Before 3.12, an error in `__set_name__`, in the class body of a module being imported, becomes a RuntimeError."""

    class Interrupted:
        def __set_name__(self, owner, name):
            raise KeyboardInterrupt

    def import_it(*_, **__):
        class Imported:
            attribute = Interrupted()

    monkeypatch.setattr(main, "app", import_it)
    assert main.run_command(["presets"]) == 130
    assert "interrupted; nothing was left half-written" in capsys.readouterr().err


def test_other_errors_stay_what_they_are(monkeypatch):
    def fail(*_, **__):
        error = ZeroDivisionError()
        error.__cause__ = ValueError()
        error.__cause__.__cause__ = error
        raise error

    monkeypatch.setattr(main, "app", fail)
    with pytest.raises(ZeroDivisionError):
        main.run_command(["presets"])
