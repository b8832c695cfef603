"""Every command of the tutorial of a bay runs, in the order of the page, for minutes of the bay instead of hours."""

import re
import shlex
from pathlib import Path

import pytest

from shoal.cli.main import run_command

PAGE = Path(__file__).resolve().parents[1] / "docs/tutorials/a-bay.md"
HOURS, MINUTES = 'steps = "2 h"', 'steps = "3 min"'


def commands():
    """Lines of the page's shell blocks that call Shoal, each as its words and where its output goes."""
    blocks = re.findall(r"```sh\n(.*?)```", PAGE.read_text(encoding="utf-8"), flags=re.DOTALL)
    lines = [shlex.split(line, comments=True) for block in blocks for line in block.splitlines()]
    for words in (line for line in lines if line[:1] == ["shoal"]):
        cut = words.index(">") if ">" in words else len(words)
        yield words[1:cut], (words[cut + 1 :] or [None])[0]


def quick(words):
    """The same command with two runs."""
    return [re.sub(r"^\d+$", "2", word) if before == "--runs" else word
            for before, word in zip(["", *words], words, strict=False)]  # fmt: skip


def test_every_command_runs_and_leaves_what_the_page_says(tmp_path, monkeypatch, capsys):
    for library in ("matplotlib", "pyproj", "scipy"):
        pytest.importorskip(library, reason="the tutorial needs pip install '.[plots,maritime]'")
    monkeypatch.chdir(tmp_path)
    for words, file in commands():
        assert run_command(quick(words)) == 0, f"{words}: {capsys.readouterr().err}"
        said = capsys.readouterr().out
        if file:
            assert said.count(HOURS) == 1
            Path(file).write_text(said.replace(HOURS, MINUTES), encoding="utf-8")
    left = {path.name for path in tmp_path.iterdir()}
    assert left == {"bay.toml", "watch", "watch.png", "watch.kml", "fleet", "fleet.png", "slow"}


def test_it_takes_ten_commands_at_most():
    assert 5 <= len(list(commands())) <= 10
