"""A preset's text with other values keeps its comments."""

import tomllib

import pytest

import shoal
from shoal.scenario.load import load, preset_text
from shoal.scenario.text import rewritten

HERE = [name for name in shoal.presets() if name not in ("bay", "offshore")]  # which are at a place on Earth


@pytest.mark.parametrize("name", HERE)
def test_every_preset_that_can_be_scaled_keeps_its_lines(name):
    text, larger = preset_text(name), load(name).scaled(20)
    new = rewritten(text, larger)
    assert load(tomllib.loads(new)) == larger
    assert [line for line in new.splitlines() if line.startswith("#")] == [
        line for line in text.splitlines() if line.startswith("#")
    ]
    assert [line for line in new.splitlines() if line.startswith("[")] == [
        line for line in text.splitlines() if line.startswith("[")
    ]


def test_what_does_not_change_keeps_the_comment_behind_it_and_what_does_loses_it():
    text = preset_text("oceans2020").replace("count = 15", "count = 15  # fast")
    new = rewritten(text, load("oceans2020").scaled(20))
    assert "count = 15  # fast" in new
    assert "sqrt(pi 2^2 / 50)" in text
    assert "sqrt(pi 2^2 / 50)" not in new


def test_nothing_is_better_than_another_scenario():
    text = preset_text("oceans2020")
    assert rewritten(text, load("oceans2020")) == text
    assert rewritten(text, load("oceans2020", losses=[{"step": 5, "count": 2}])) is None
