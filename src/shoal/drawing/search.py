"""A search as it went: the value of every trial, the best so far, and what start and winner are really worth."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shoal.drawing.style import FLEET_COLORS, GRAY, INK, TARGET, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_WIDTH, _HEIGHT = 6.4, 3.4  # [in]


@dataclass(frozen=True)
class Measured:
    """A value on fresh seeds, and the ends of its 95 % interval; None where it is not known."""

    name: str
    mean: float
    low: float | None
    high: float | None


def search_figure(values: Sequence[float], winner: int, measured: Sequence[Measured], label: str) -> "Figure":
    """Return a figure of a search.

    Parameters
    ----------
    values : of every trial, the start first; NaN: it has none
    winner : number of the best one
    measured : start and winner on fresh seeds
    label : of the metric
    """
    with style():
        from matplotlib.ticker import MaxNLocator

        figure = new_figure(_WIDTH, _HEIGHT)
        axes = figure.add_axes((0.1, 0.19, 0.66, 0.7))
        side = figure.add_axes((0.8, 0.19, 0.17, 0.7), sharey=axes)
        known = np.asarray(values, float)
        axes.plot(np.arange(known.size), known, "o", color=GRAY, markersize=3, markeredgewidth=0, gid="trials")
        axes.plot([winner], [known[winner]], "o", color=FLEET_COLORS[2], markersize=6, gid="winner")
        axes.plot([0], [known[0]], "D", color=TARGET, markersize=5, gid="start")
        axes.set_title(f"{label}: in the search")
        axes.set_xlabel("trial (0: the start)")
        axes.xaxis.set_major_locator(MaxNLocator(7, steps=[1, 2, 5, 10], integer=True))
        for at, (each, color, marker) in enumerate(zip(measured, (TARGET, FLEET_COLORS[2]), "Do", strict=False)):
            if each.low is not None and each.high is not None:
                side.plot([at, at], [each.low, each.high], color=INK, linewidth=1.1, solid_capstyle="butt")
            side.plot([at], [each.mean], marker, color=color, markersize=6, gid=f"fresh-{each.name}")
        side.set_title("on fresh seeds")
        side.set_xticks(range(len(measured)), [each.name for each in measured])
        side.set_xlim(-0.6, len(measured) - 0.4)
        side.tick_params(axis="y", labelleft=False)
        for each_axes in (axes, side):
            each_axes.grid(axis="y")
        note = "whiskers: 95 % interval over runs; the search flatters its best, fresh seeds do not"
        figure.text(0.97, 0.015, note, ha="right", va="bottom", fontsize=7, color=GRAY)
    return figure
