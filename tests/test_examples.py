"""Every example runs, and the page that quotes it quotes it to the letter."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
SCRIPTS = [file for file in sorted((ROOT / "examples").glob("*.py")) if file.name != "my_strategy.py"]


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.name)
def test_the_example_runs(script, tmp_path):
    done = subprocess.run([sys.executable, script], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout


def test_the_example_strategy_runs(tmp_path):
    command = [sys.executable, "-m", "shoal", "run", "oceans2020", "--steps", "2000", "--strategy"]
    done = subprocess.run(
        [*command, ROOT / "examples/my_strategy.py"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "strategy wander" in done.stdout


def test_the_page_quotes_the_example():
    page = (ROOT / "docs/how-to/own-strategy.md").read_text(encoding="utf-8")
    assert (ROOT / "examples/my_strategy.py").read_text(encoding="utf-8") in page
