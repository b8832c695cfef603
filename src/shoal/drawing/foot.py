"""The note at the foot of a figure: what its whiskers, bands and signs are."""

import textwrap
from typing import TYPE_CHECKING

from shoal.drawing.style import GRAY

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LINE = 0.13  # [inch] height of a line
_LETTER, _SIZE = 0.0515, 6.5  # [inch] width of a letter; of the font [pt]
_EDGE = 0.06  # [inch] below and beside it


def foot_height(text: str, width: float) -> float:
    """Room that a note takes at the bottom of a page of a width [inch]."""
    return LINE * len(_lines(text, width)) + _EDGE


def draw_foot(figure: "Figure", text: str) -> None:
    """Write a note at the bottom of a figure, in lines that fit."""
    width, height = figure.get_size_inches()
    note = "\n".join(_lines(text, width))
    figure.text(1 - _EDGE / width, _EDGE / height, note, ha="right", va="bottom", fontsize=_SIZE, color=GRAY,
                linespacing=1.25)  # fmt: skip


def _lines(text: str, width: float) -> list[str]:
    return textwrap.wrap(text, int((width - 2 * _EDGE) / _LETTER), break_on_hyphens=False)
