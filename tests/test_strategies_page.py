"""The reference page has every strategy, and says which ones are told the truth."""

import re
from pathlib import Path

from shoal.strategies import CATALOGUE

PAGE = (Path(__file__).resolve().parents[1] / "docs/reference/strategies.md").read_text(encoding="utf-8")


def named_in(text):
    """Strategies that have a row of a table of their own."""
    return set(re.findall(r"^\| `([a-z-]+)` \|", text, re.MULTILINE))


def test_every_strategy_has_its_row():
    assert named_in(PAGE) == {name for name, known in CATALOGUE.items() if known.builtin}


def test_those_that_are_told_the_truth_are_named_as_such():
    told = PAGE[PAGE.index("## References that are told") : PAGE.index("## Time on target")]
    assert named_in(told) == {name for name, known in CATALOGUE.items() if known.informed}
