"""Blocks of code under `<!-- run -->` run as they stand, page by page and in order, but for how long they take."""

import re
import shlex
from pathlib import Path

import pytest

from shoal.cli.main import run_command

ROOT = Path(__file__).resolve().parents[1]
BLOCK = re.compile(r"^<!-- run -->\n```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
SHORT = {"--steps": 400, "--runs": 2}  # at most, so that a page takes seconds
MARK = re.compile(r"^<!-- run -->$", re.MULTILINE)
PAGES = [page for page in sorted((ROOT / "docs").rglob("*.md")) if MARK.search(page.read_text(encoding="utf-8"))]
EXTRAS = ("matplotlib", "pandas", "scipy.stats", "imageio_ffmpeg", "gymnasium", "pettingzoo")


def shortened(words):
    """The same command with fewer steps and runs."""
    pairs = zip(["", *words], words, strict=False)
    return [str(min(int(word), SHORT[before])) if before in SHORT else word for before, word in pairs]


def run_shell(block, capsys):
    """Each line of a block, which calls Shoal or is a comment."""
    for line in block.splitlines():
        words = shlex.split(line, comments=True)
        if not words:
            continue
        assert words[0] == "shoal", f"only shoal runs in a marked block: {line}"
        cut = words.index(">") if ">" in words else len(words)
        code = run_command(shortened(words[1:cut]))
        said = capsys.readouterr()
        assert code == 0, f"{line}: {said.err}"
        if words[cut:]:
            Path(words[cut + 1]).write_text(said.out, encoding="utf-8")


def run_python(block):
    """A block with fewer steps and runs."""
    for word, most in SHORT.items():
        name = word.removeprefix("--")
        block = re.sub(rf"\b{name}=([\d_]+)", lambda found, n=name, m=most: f"{n}={min(int(found[1]), m)}", block)
    exec(compile(block, "<page>", "exec"), {"__name__": "__main__"})


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_marked_block_runs(page, tmp_path, monkeypatch, capsys):
    for extra in EXTRAS:
        pytest.importorskip(extra, reason=f"marked blocks need {extra}")
    monkeypatch.chdir(tmp_path)
    for language, block in BLOCK.findall(page.read_text(encoding="utf-8")):
        run_python(block) if language == "python" else run_shell(block, capsys)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_mark_stands_before_a_block_that_can_run(page):
    text = page.read_text(encoding="utf-8")
    assert len(BLOCK.findall(text)) == len(MARK.findall(text))
    assert {language for language, _ in BLOCK.findall(text)} <= {"sh", "python"}


def test_pages_for_newcomers_have_marked_blocks():
    assert {page.stem for page in PAGES} >= {"researcher", "engineer", "learner", "field-team", "see-a-swarm"}


def test_a_command_is_shortened_and_nothing_else():
    line = ["run", "oceans2020", "--steps", "20000", "--runs", "5", "--seed", "7"]
    assert shortened(line) == ["run", "oceans2020", "--steps", "400", "--runs", "2", "--seed", "7"]
