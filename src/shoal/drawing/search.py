"""A search as it went: the value of every trial, the best so far, and what start and winner are really worth."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shoal.drawing.foot import draw_foot, foot_height
from shoal.drawing.margins import keep_on_page
from shoal.drawing.style import GRAY, INK, LINE_COLORS, Width, lettered, new_figure, style, width_of
from shoal.drawing.titles import entitle

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_LEFT, _RIGHT, _GAP, _TOP, _BELOW = 0.55, 0.1, 0.2, 0.3, 0.42  # [in] beside, between, above and below the axes
_START, _BEST = INK, LINE_COLORS[1]
_NOTE = "whiskers: 95 % interval over runs; the search flatters its best, fresh seeds do not"


@dataclass(frozen=True)
class Measured:
    """A value on fresh seeds, and the ends of its 95 % interval; None where it is not known."""

    name: str
    mean: float
    low: float | None
    high: float | None


def search_figure(
    values: Sequence[float], winner: int, measured: Sequence[Measured], label: str, width: Width = "double"
) -> "Figure":
    """Return a figure of a search.

    Parameters
    ----------
    values : of every trial, the start first; NaN: it has none
    winner : number of the best one
    measured : start and winner on fresh seeds
    label : of the metric
    width : of one column of a journal, or of two
    """
    page = width_of(width)
    right = 0.75 if width == "single" else 1.3
    left, tall = page - _LEFT - _GAP - right - _RIGHT, 1.9 if width == "single" else 2.5
    bottom = foot_height(_NOTE, page) + _BELOW
    height = bottom + tall + _TOP
    with style():
        from matplotlib.ticker import MaxNLocator

        figure = new_figure(page, height)
        axes = figure.add_axes((_LEFT / page, bottom / height, left / page, tall / height))
        begin = (_LEFT + left + _GAP) / page
        side = figure.add_axes((begin, bottom / height, right / page, tall / height), sharey=axes)
        known = np.asarray(values, float)
        axes.plot(np.arange(known.size), known, "o", color=GRAY, markersize=3, markeredgewidth=0, gid="trials")
        axes.plot([winner], [known[winner]], "o", color=_BEST, markersize=6, gid="winner")
        axes.plot([0], [known[0]], "D", color=_START, markersize=5, gid="start")
        entitle(axes, lettered(0, "in the search"))
        axes.set_ylabel(label)
        axes.set_xlabel("trial (0: the start)")
        axes.xaxis.set_major_locator(MaxNLocator(7, steps=[1, 2, 5, 10], integer=True))
        for at, (each, color, marker) in enumerate(zip(measured, (_START, _BEST), "Do", strict=False)):
            if each.low is not None and each.high is not None:
                side.plot([at, at], [each.low, each.high], color=INK, linewidth=1.1, solid_capstyle="butt")
            side.plot([at], [each.mean], marker, color=color, markersize=6, gid=f"fresh-{each.name}")
        entitle(side, lettered(1, "fresh seeds"))
        side.set_xticks(range(len(measured)), [each.name for each in measured])
        side.set_xlim(-0.6, len(measured) - 0.4)
        side.tick_params(axis="y", labelleft=False)
        for each_axes in (axes, side):
            each_axes.grid(axis="y")
        keep_on_page(axes)
        draw_foot(figure, _NOTE)
    return figure
