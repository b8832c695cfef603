"""One rule for output: a result that cannot be printed is an error, whatever else cannot be told is none."""

import io
import os
import signal
import subprocess
import sys

import pytest

from shoal.cli.output import guarded_stdout

COMMAND = [sys.executable, "-m", "shoal"]
RUN = [*COMMAND, "run", "oceans2020", "--steps", "40"]
FULL = "/dev/full"


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(os.path.abspath(each) for each in sys.path if each))
    monkeypatch.chdir(tmp_path)


def shell(line):
    """Run a line of bash in which shoal is the command."""
    text = line.replace("shoal ", f"{sys.executable} -m shoal ")
    return subprocess.run(["bash", "-c", text], capture_output=True, text=True, check=False)


@pytest.mark.skipif(not os.path.exists(FULL), reason="there is no /dev/full here")
class TestFull:
    """A full disk."""

    @pytest.mark.parametrize(
        "command", ["run oceans2020 --steps 40", "run oceans2020 --steps 40 --json", "strategies", "--help", "schema"]
    )
    def test_of_stdout_is_one_sentence(self, command):
        done = shell(f"shoal {command} > {FULL}")
        assert done.returncode == 1
        assert done.stderr.endswith(
            "shoal: the result cannot be printed: No space left on device\n  fix: send it where there is room, or to "
            "/dev/null\n"
        )
        assert "Traceback" not in done.stderr

    @pytest.mark.parametrize("where", [f"2> {FULL}", "2>&-"])
    def test_or_closed_stderr_costs_no_result(self, where):
        done = shell(f"shoal run oceans2020 --steps 40 --out r --json {where}; echo $?")
        assert done.stdout.startswith("{")
        assert done.stdout.endswith("}\n0\n")


class TestPipe:
    @pytest.mark.parametrize("command", ["run oceans2020 --steps 40", "run oceans2020 --steps 40 --json", "schema"])
    def test_a_reader_that_leaves_is_no_error(self, command):
        done = shell(f"set -o pipefail; shoal {command} | true; echo ${{PIPESTATUS[0]}}")
        assert done.stdout == "0\n"
        assert "Traceback" not in done.stderr

    def test_a_closed_stdout_is_told_before_anything_runs(self):
        done = shell("shoal run oceans2020 --steps 1000000000 >&-")
        assert done.returncode == 1
        assert done.stderr.startswith("shoal: the result cannot be printed: standard output is closed\n  fix: ")


class TestWidth:
    @pytest.mark.parametrize("columns", ["0", "1", "x", "1000000"])
    def test_a_table_is_printed_whatever_columns_says(self, columns):
        done = subprocess.run(
            RUN, capture_output=True, text=True, check=True, env={**os.environ, "COLUMNS": columns}
        )  # fmt: skip
        assert "time on target" in done.stdout


class TestInterrupt:
    @pytest.mark.parametrize("module", ["cyclopts.", "pydantic.", "numba.core."])
    def test_while_libraries_are_imported_is_one_line(self, module):
        process = subprocess.Popen(
            [sys.executable, "-X", "importtime", *COMMAND[1:], "run", "oceans2020", "--steps", "1000000000"],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        next(line for line in process.stderr if module in line)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=120)
        assert (process.returncode, out) == (130, "")
        assert "shoal: interrupted" in err
        assert "Traceback" not in err


class TestEncodings:
    """A terminal or a pipe that knows few letters."""

    @pytest.mark.parametrize(
        ("encoding", "text"),
        [
            ("utf-8", "Ξ [−0.1, 0.2] m²/s – 浮"),
            ("latin-1", "Xi [-0.1, 0.2] m^2/s - ?"),
            ("ascii", "Xi [-0.1, 0.2] m^2/s - ?"),
        ],
    )
    def test_signs_that_it_lacks_are_spelled(self, encoding, text, monkeypatch):
        stream = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
        monkeypatch.setattr(sys, "stdout", stream)
        with guarded_stdout():
            sys.stdout.write("Ξ [−0.1, 0.2] m²/s – 浮")
        assert stream.buffer.getvalue() == text.encode(encoding)
