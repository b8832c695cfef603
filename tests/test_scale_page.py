"""The page about scale says which length each default follows."""

import re
from pathlib import Path

from shoal.scenario.scales import PAPER
from shoal.scenario.strategy_choice import following
from shoal.strategies import CATALOGUE

PAGE = (Path(__file__).resolve().parents[1] / "docs/explanation/scale.md").read_text(encoding="utf-8")
COLUMNS = ("spacing", "reach", "step")


def test_every_default_that_follows_stands_in_its_column():
    told = {}
    for name, *cells in re.findall(r"^\| `([a-z-]+)` \|([^|]*)\|([^|]*)\|([^|]*)\|$", PAGE, re.MULTILINE):
        for length, cell in zip(COLUMNS, cells, strict=True):
            for parameter in re.findall(r"`(\w+)`", cell):
                told.setdefault((name, parameter), set()).add(length)
    found = {
        (name, parameter): set(mark.lengths)
        for name, known in CATALOGUE.items()
        if known.builtin
        for parameter, mark in following(known).items()
    }
    assert told == found


def test_the_papers_lengths_are_as_it_says():
    for length in COLUMNS:
        said = re.search(rf"^\| {length} \|.*\| ([0-9.]+) m \|$", PAGE, re.MULTILINE).group(1)
        assert f"{getattr(PAPER, length):.3g}" == said
