"""What pages and programs tell people to type."""

import re
from pathlib import Path

import pytest

import shoal

ROOT = Path(__file__).resolve().parents[1]
FROM_INDEX = re.compile(r"install\s+(-\S+\s+)*['\"]?shoal\b")
TEXTS = [
    *ROOT.glob("*.md"),
    *(file for folder in ("docs", "src", "examples", "web/src") for file in (ROOT / folder).rglob("*")
      if file.suffix in (".md", ".py", ".ts", ".txt", ".toml", ".html")),
]  # fmt: skip


@pytest.mark.parametrize("file", TEXTS, ids=lambda file: str(file.relative_to(ROOT)))
def test_nobody_is_told_to_install_from_an_index_that_has_no_shoal(file):
    told = re.findall(r"pip install [^\n`]*", file.read_text(encoding="utf-8"))
    assert not [each for each in told if FROM_INDEX.search(each)]


def test_installing_from_an_index_is_seen_behind_options_and_with_extras():
    assert FROM_INDEX.search("pip install --no-deps -U 'shoal[plots]'")
    assert not FROM_INDEX.search("pip install --no-deps dist/shoal-0.1.0-py3-none-any.whl")


def test_wheels_in_the_docs_are_of_this_version():
    texts = [file.read_text(encoding="utf-8") for file in TEXTS]
    assert {name for text in texts for name in re.findall(r"shoal-([^-\s]+)-py3-none", text)} == {shoal.__version__}


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
