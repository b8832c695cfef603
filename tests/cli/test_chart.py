"""shoal chart: a run on chart plotters."""

import signal
import socket
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from commands import shoal
from plotters import Plotter, free_port

pytest.importorskip("pyais")
pytest.importorskip("pyproj")

RECORD = Path(__file__).parents[1] / "data" / "results-v2" / "every"
WHERE = ("--origin", "-1.3,50.8")


class TestChart:
    def test_a_record_is_played_to_the_plotter_that_connects(self, capsys):
        plotter = Plotter(port := free_port())
        code, out, err = shoal(capsys, "chart", RECORD, *WHERE, "--tcp", port, "--every", 0.1, "--speed", 10)
        assert (code, out) == (0, "")
        assert f"AIS over TCP at 127.0.0.1:{port}" in err
        assert "chart: 8 moments for 1 plotter" in err
        reports = [each for each in plotter.messages() if each.msg_type in (1, 18)]
        assert len(reports) == 8 * 7
        x = np.load(RECORD / "run-0000" / "x.npy")[:, 0]
        metres = [(each.lon + 1.3) * 70_430 for each in reports[::7]]  # of a degree of longitude at 50.8 N
        assert metres == pytest.approx(x, abs=0.19)

    def test_ctrl_c_ends_a_loop_cleanly(self, tmp_path):
        command = [sys.executable, "-m", "shoal", "chart", RECORD, *WHERE, "--tcp", str(port := free_port()), "--loop"]
        plotter = Plotter(port)
        process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        while plotter.heard.count(b",A,1") < 5:  # class A: a target
            assert process.poll() is None
            plotter.join(0.05)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=30)
        assert process.returncode == 0
        assert "Traceback" not in err
        assert plotter.lines()[-1].startswith(b"!AIVDM")

    @pytest.mark.parametrize(
        ("tokens", "words"),
        [
            ([RECORD], "has no place on Earth"),
            (["oceans2020"], "has no place on Earth"),
            ([RECORD, *WHERE, "--run", 1], "run 1: keeps no frames"),
            ([RECORD, *WHERE, "--speed", 0], "--speed: is 0"),
            ([RECORD, *WHERE, "--every", "-1"], "--every: is -1"),
            ([RECORD, *WHERE, "--run", "-1"], "--run: is -1"),
            ([RECORD, *WHERE, "--tcp", 70000], "--tcp: is 70000"),
            (["nothere", *WHERE], "no preset and no file"),
        ],
    )
    def test_bad_input_is_one_message(self, capsys, tokens, words):
        code, _, err = shoal(capsys, "chart", *tokens)
        assert code == 2
        assert words in err
        assert err.count("fix:") == 1

    def test_a_port_in_use_is_one_message(self, capsys):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            code, _, err = shoal(capsys, "chart", RECORD, *WHERE, "--tcp", port)
        assert code == 2
        assert f"--tcp {port}: is in use" in err
