"""Titles fit above their panel."""

import pytest

from shoal.drawing.titles import entitle


@pytest.mark.parametrize("words", [1, 6, 12, 24])
def test_a_title_is_no_wider_than_its_axes(axes, words):
    text = " ".join(["word"] * words)
    entitle(axes, text)
    title = next(each for each in axes.get_children() if getattr(each, "get_text", str)().split() == text.split())
    assert title.get_window_extent().width <= 1.02 * axes.bbox.width
    assert title.get_fontsize() >= 6.5


def test_a_short_title_is_as_large_as_all(axes):
    entitle(axes, "short")
    other = axes.set_title("other", loc="right")
    title = next(each for each in axes.get_children() if getattr(each, "get_text", str)() == "short")
    assert title.get_fontsize() == other.get_fontsize()
