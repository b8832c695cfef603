"""What pages and programs tell people to type."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
TEXTS = [
    *ROOT.glob("*.md"),
    *(file for folder in ("docs", "src", "examples", "web/src") for file in (ROOT / folder).rglob("*")
      if file.suffix in (".md", ".py", ".ts", ".txt", ".toml", ".html")),
]  # fmt: skip


@pytest.mark.parametrize("file", TEXTS, ids=lambda file: str(file.relative_to(ROOT)))
def test_nobody_is_told_to_install_from_an_index_that_has_no_shoal(file):
    told = re.findall(r"pip install [^\n`]*", file.read_text(encoding="utf-8"))
    assert not [each for each in told if re.search(r"install\s+['\"]?shoal\b", each)]


def test_the_first_page_says_what_there_is_and_how_large_it_is():
    first = "\n".join((ROOT / "README.md").read_text(encoding="utf-8").splitlines()[:12])
    assert "deploy" not in first.lower()
    assert "20 m x 20 m" in first


def test_every_field_of_the_first_preset_is_explained():
    text = (ROOT / "src/shoal/scenario/presets/oceans2020.toml").read_text(encoding="utf-8")
    fields = set(re.findall(r"^(\w+) = ", text, re.MULTILINE))
    _, _, explained = text.partition("# What each field means.")
    assert len(fields) > 20
    assert {field for field in fields if not re.search(rf"[ ,]{field}\b", explained)} == set()
