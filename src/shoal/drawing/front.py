"""A front: what fleets cost and what they are worth, with intervals; those on the front are joined by steps."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from shoal.drawing.foot import draw_foot, foot_height
from shoal.drawing.legend import legend_above, legend_room
from shoal.drawing.margins import keep_on_page
from shoal.drawing.style import GRAY, INK, LINE_COLORS, Width, new_figure, style, width_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LEFT, _RIGHT, _TOP, _BELOW = 0.55, 0.15, 0.1, 0.42  # [in] beside, above and below the axes
_FRONT, _OWN, _TRIED = LINE_COLORS[0], LINE_COLORS[2], "#8f8f8f"
_THOUSANDS = 5000.0  # costs from which their labels are whole, with commas
_SIGNS = ("tried", "dominated for sure", "behind, by its mean", "on the front", "own fleet")
_LABELED = 7  # points of the front that are named
_BESIDE = 0.1  # of the width: where there is room for a name left of its point
_APART = 0.055  # of the height: names are not closer


@dataclass(frozen=True)
class Place:
    """A fleet in the figure: means and ends of intervals (None: not known), a name, and what it is.

    kind : front; behind - another is better by its mean; beaten - one is better for sure
    """

    less: float
    more: float
    low: float | None
    high: float | None
    name: str
    kind: Literal["front", "behind", "beaten"]
    present: bool = False


def front_figure(
    places: Sequence[Place],
    tried: Sequence[tuple[float, float]],
    labels: tuple[str, str],
    fleets: str,
    width: Width = "double",
) -> "Figure":
    """Return a figure of the front.

    Parameters
    ----------
    places : fleets that were run again, cheapest first
    tried : both metrics of every trial of the search
    labels : of both metrics
    fleets : what the names of places are made of, such as "fast + slow"
    width : of one column of a journal, or of two
    """
    page = width_of(width)
    wide = page - _LEFT - _RIGHT
    tall = 0.8 * wide if width == "single" else 0.5 * wide
    note = f"whiskers: 95 % interval over runs on fresh seeds; numbers: {fleets}"
    bottom = foot_height(note, page) + _BELOW
    height = bottom + tall + legend_room(_SIGNS, wide) + _TOP
    with style():
        from matplotlib.ticker import FuncFormatter

        figure = new_figure(page, height)
        axes = figure.add_axes((_LEFT / page, bottom / height, wide / page, tall / height))
        axes.plot(*np.array(tried, float).reshape(-1, 2).T, ".", color=_TRIED, markersize=4, markeredgewidth=0,
                  label="tried", gid="tried", zorder=1.5)  # fmt: skip
        kinds = {"beaten": ("x", GRAY, "dominated for sure"), "behind": ("o", GRAY, "behind, by its mean")}
        for kind, (marker, color, label) in kinds.items():
            _draw(axes, [each for each in places if each.kind == kind and not each.present], marker, color, label)
        best = [each for each in places if each.kind == "front"]
        axes.step([each.less for each in best], [each.more for each in best], where="post", color=_FRONT,
                  linewidth=1.0, alpha=0.6)  # fmt: skip
        _draw(axes, [each for each in best if not each.present], "o", _FRONT, "on the front")
        _draw(axes, [each for each in places if each.present], "D", _OWN, "own fleet")
        axes.set_xlabel(labels[0])
        axes.set_ylabel(labels[1])
        axes.set_xlim(left=0.0)
        if axes.get_xlim()[1] >= _THOUSANDS:
            axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}"))
        axes.grid(visible=True)
        keep_on_page(axes)
        _name(axes, best)
        legend_above(axes)
        draw_foot(figure, note)
    return figure


def _draw(axes: "Axes", places: Sequence[Place], marker: str, color: str, label: str) -> None:
    if not places:
        return
    for each in places:
        if each.low is not None and each.high is not None:
            axes.plot([each.less] * 2, [each.low, each.high], color=color, linewidth=0.9, solid_capstyle="butt")
    hollow = marker == "o" and color == GRAY
    axes.plot(
        [each.less for each in places], [each.more for each in places], marker, color=color, linestyle="none",
        markersize=6 if marker == "D" else 4.5, markerfacecolor="white" if hollow else color,
        markeredgewidth=1.0 if hollow or marker == "x" else 0.0, label=label, gid=label.replace(" ", "-"), zorder=3,
    )  # fmt: skip


def _name(axes: "Axes", best: Sequence[Place]) -> None:
    """Name some of the front, evenly over its height, where no fleet is: to the left of and above the point."""
    from matplotlib.patheffects import withStroke

    bottom, top = axes.get_ylim()
    wanted = np.linspace(best[0].more, best[-1].more, _LABELED)
    last = -np.inf
    for at in sorted({int(np.argmin([abs(each.more - value) for each in best])) for value in wanted}):
        if best[at].more - last < _APART * (top - bottom):
            continue
        last = best[at].more
        left = best[at].less > _BESIDE * axes.get_xlim()[1]
        text = axes.annotate(
            best[at].name, (best[at].less, best[at].more), xytext=(-5, 4) if left else (6, -9),
            textcoords="offset points", ha="right" if left else "left", fontsize=7.5, color=INK, zorder=4,
        )  # fmt: skip
        text.set_path_effects([withStroke(linewidth=2.5, foreground="white")])
