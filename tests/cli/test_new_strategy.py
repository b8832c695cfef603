"""A strategy to start from, with a test that passes."""

import subprocess
import sys
from pathlib import Path

import pytest

from scenarios import scenario
from shoal.cli.main import run_command


@pytest.fixture(autouse=True)
def _own_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_it_writes_a_strategy_of_that_name_that_loads(capsys):
    assert run_command(["new-strategy", "zig-zag"]) == 0
    assert "--strategy zig_zag.py" in capsys.readouterr().out
    assert sorted(file.name for file in Path().iterdir()) == ["test_zig_zag.py", "zig_zag.py"]
    chosen = scenario("oceans2020", {"strategy": {"file": "zig_zag.py"}}).strategy
    assert chosen.name == "zig-zag"
    assert chosen.owner.params.__name__ == "ZigZag"


@pytest.mark.slow
def test_the_test_it_writes_passes():
    assert run_command(["new-strategy", "zig-zag"]) == 0
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout
    assert "3 passed" in done.stdout


def test_goes_where_it_is_told(capsys):
    Path("mine").mkdir()
    assert run_command(["new-strategy", "drift", "--folder", "mine"]) == 0
    assert Path("mine/drift.py").is_file()
    assert "mine/drift.py" in capsys.readouterr().out


@pytest.mark.parametrize("there", ["drift.py", "test_drift.py"])
def test_overwrites_nothing_and_leaves_nothing_half_written(capsys, there):
    Path(there).write_text("mine", encoding="utf-8")
    assert run_command(["new-strategy", "drift"]) == 2
    assert f"{there}: exists already" in capsys.readouterr().err
    assert [file.name for file in Path().iterdir()] == [there]
    assert Path(there).read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize("name", ["Drift", "2nd", "a b", "a--b", "../up", "class", "drift-", "naïve", ""])
def test_a_name_must_be_one(capsys, name):
    assert run_command(["new-strategy", name]) == 2
    assert "is not a strategy name" in capsys.readouterr().err
    assert not list(Path().iterdir())


def test_a_name_that_is_taken_is_refused(capsys):
    assert run_command(["new-strategy", "lattice"]) == 2
    assert "is a strategy that comes with Shoal" in capsys.readouterr().err


def test_a_folder_must_be_there(capsys):
    assert run_command(["new-strategy", "drift", "--folder", "nowhere"]) == 2
    assert "cannot be written" in capsys.readouterr().err
