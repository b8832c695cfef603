"""Strategies side by side: bars with 95 % intervals, or curves with bands, and standing still as the yardstick."""

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.drawing.curves import Curve, draw_curve
from shoal.drawing.foot import draw_foot, foot_height
from shoal.drawing.legend import legend_above, legend_room
from shoal.drawing.margins import keep_on_page
from shoal.drawing.style import (
    FLEET_COLORS,
    GRAY,
    INK,
    LINE_COLORS,
    Width,
    fleet_marker,
    lettered,
    new_figure,
    style,
    width_of,
)
from shoal.drawing.titles import entitle

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ROW = 0.19  # [inch] height of a bar and the space around it
_LETTER = 0.06  # [inch] width of a letter
_TITLE, _BELOW, _EDGE = 0.27, 0.42, 0.1  # [inch] above a panel, below it, beside the page
_GAP, _NARROWEST = 0.25, 1.15  # [inch] between panels; width of one
_LONGEST = 26  # letters of a line of a name
_LEFT, _TALL = 0.55, 2.6  # [inch] left of curves, their least height
_LINES: tuple[Any, ...] = ("-", "--", ":", "-.")
_CURVES = tuple(color for color in LINE_COLORS if color != INK)
_YARDSTICK = INK  # standing still is what every strategy has to beat: a color of its own, never the target's


@dataclass(frozen=True)
class Bar:
    """Mean and 95 % interval of a strategy (None where it cannot be determined).

    informed : it knows the target; sign : of a difference to the baseline that was shown, + better, − worse
    """

    strategy: str
    mean: float
    low: float | None
    high: float | None
    informed: bool = False
    sign: str = ""


@dataclass(frozen=True)
class Panel:
    """Bars under one condition, from the top down; every panel of a figure has the same strategies in one order."""

    title: str
    bars: Sequence[Bar]


def bars_figure(
    panels: Sequence[Panel], x_label: str, note: str = "", yardstick: str = "lattice", width: Width = "double"
) -> "Figure":
    """Return a figure with a panel of horizontal bars per condition; a line through all marks the yardstick.

    Parameters
    ----------
    x_label : of all panels
    note : at the foot, before what the signs are
    width : of one column of a journal, or of two
    """
    page = width_of(width)
    names = ["\n".join(textwrap.wrap(bar.strategy, _LONGEST)) for bar in panels[0].bars]
    left = 0.2 + _LETTER * max(len(line) for name in names for line in name.split("\n"))
    columns = max(1, min(len(panels), int((page - left - _EDGE + _GAP) / (_NARROWEST + _GAP))))
    wide = (page - left - _EDGE + _GAP) / columns - _GAP
    row = _ROW * max(1.0, 0.75 * max(name.count("\n") + 1 for name in names))
    above = _TITLE if any(panel.title for panel in panels) else _EDGE
    rows, tall = -(-len(panels) // columns), row * (len(names) + 0.8)
    foot = _note(panels, note, yardstick)
    height = rows * (above + tall + _BELOW) + foot_height(foot, page)
    limits = _limits([bar for panel in panels for bar in panel.bars])
    with style():
        from matplotlib.ticker import MaxNLocator

        figure = new_figure(page, height)
        for number, panel in enumerate(panels):
            line, column = divmod(number, columns)
            bottom = height - (line + 1) * (above + tall + _BELOW) + _BELOW
            box = (left + column * (wide + _GAP), bottom, wide, tall)
            axes = figure.add_axes((box[0] / page, box[1] / height, box[2] / page, box[3] / height))
            _draw_bars(axes, panel, yardstick, names if column == 0 else None)
            entitle(axes, lettered(number, panel.title) if len(panels) > 1 else panel.title)
            axes.set_xlim(*limits)
            axes.xaxis.set_major_locator(MaxNLocator(max(2, int(2.2 * wide)), steps=[1, 2, 5, 10]))
            if number + columns >= len(panels):
                axes.set_xlabel(x_label)
        draw_foot(figure, foot)
    return figure


def curves_figure(
    curves: Sequence[Curve],
    labels: tuple[str, str],
    note: str = "",
    yardstick: str = "lattice",
    informed: Sequence[str] = (),
    width: Width = "double",
) -> "Figure":
    """Return a figure of one curve per strategy, with bands, a marker at every place that was run.

    Parameters
    ----------
    labels : of both axes
    note : at the foot, before what the bands are
    informed : strategies that know the target
    width : of one column of a journal, with the legend above; or of two, with the legend beside
    """
    page = width_of(width)
    ordered = sorted(curves, key=lambda curve: (curve.label in informed, -np.nan_to_num(curve.mean[-1], nan=-np.inf)))
    names = {curve.label: _curve_label(curve.label, informed) for curve in curves}
    beside = width == "double"
    legend = 0.5 + _LETTER * max(len(line) for name in names.values() for line in name.split("\n")) if beside else 0.0
    wide = page - _LEFT - _EDGE - legend
    tall = max(_TALL, 0.19 * len(curves)) if beside else 0.75 * wide
    above = _EDGE if beside else _EDGE + legend_room(list(names.values()), wide)
    foot = ". ".join(part for part in (note, "Bands: 95 % interval over runs") if part)
    bottom = foot_height(foot, page) + _BELOW
    height = bottom + tall + above
    others = [curve.label for curve in curves if curve.label != yardstick]
    with style():
        figure = new_figure(page, height)
        axes = figure.add_axes((_LEFT / page, bottom / height, wide / page, tall / height))
        for curve in ordered:
            still = curve.label == yardstick
            number = 0 if still else others.index(curve.label)
            drawn = Curve(names[curve.label], curve.x, curve.mean, curve.low, curve.high)
            color = _YARDSTICK if still else _CURVES[number % len(_CURVES)]
            draw_curve(axes, drawn, color, "x" if still else fleet_marker(number), bold=still,
                       line="--" if still else _LINES[number // len(_CURVES) % len(_LINES)])  # fmt: skip
        axes.set_xlabel(labels[0])
        axes.set_ylabel(labels[1])
        axes.grid(visible=True)
        keep_on_page(axes)
        if beside:
            axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), borderaxespad=0.1, handlelength=2.6)
        else:
            legend_above(axes)
        draw_foot(figure, foot)
    return figure


def _draw_bars(axes: "Axes", panel: Panel, yardstick: str, names: Sequence[str] | None) -> None:
    at = np.arange(len(panel.bars))
    for place, bar in zip(at, panel.bars, strict=True):
        color = GRAY if bar.strategy == yardstick else FLEET_COLORS[0]
        if bar.informed:
            look: dict[str, Any] = {"facecolor": "white", "edgecolor": GRAY, "hatch": "////", "linewidth": 0.7}
        else:
            look = {"facecolor": color, "edgecolor": color, "linewidth": 0.7}
        axes.barh(place, bar.mean, height=0.68, gid=f"bar-{bar.strategy}", **look)
        end = bar.mean
        if bar.low is not None and bar.high is not None:
            axes.plot([bar.low, bar.high], [place, place], color=INK, linewidth=1.1, solid_capstyle="butt")
            axes.plot([bar.low, bar.high], [place, place], "|", color=INK, markersize=5, markeredgewidth=1.1)
            end = bar.high
        if bar.sign and np.isfinite(end):
            axes.annotate(bar.sign, (end, place), (4, 0), textcoords="offset points", va="center_baseline",
                          fontweight="bold", gid=f"sign-{bar.strategy}")  # fmt: skip
    still = next((bar.mean for bar in panel.bars if bar.strategy == yardstick), None)
    if still is not None and np.isfinite(still):
        axes.axvline(still, color=_YARDSTICK, linewidth=1.0, linestyle="--", gid="yardstick")
    _divide(axes, panel)
    axes.set_yticks(at, names or [""] * at.size)
    axes.tick_params(axis="y", length=0)
    axes.set_ylim(at.size - 0.4, -0.6)
    axes.grid(axis="x")


def _note(panels: Sequence[Panel], note: str, yardstick: str) -> str:
    bars = [bar for panel in panels for bar in panel.bars]
    parts = [note, "Whiskers: 95 % interval over runs", f"Dashed: {yardstick}"]
    if any(bar.informed for bar in bars):
        parts.append("Hatched: knows the target")
    return ". ".join(part for part in parts if part)


def _limits(bars: Sequence[Bar]) -> tuple[float, float]:
    """From 0 to beyond the longest whisker and its sign: no metric is below 0."""
    ends = [end for bar in bars for end in (bar.mean, bar.high) if end is not None and np.isfinite(end)]
    room = 1.12 if any(bar.sign for bar in bars) else 1.03
    return 0.0, room * max([0.0, *ends]) or 1.0


def _divide(axes: "Axes", panel: Panel) -> None:
    """A line between contenders and those that know the target."""
    first = next((place for place, bar in enumerate(panel.bars) if bar.informed), 0)
    if first:
        axes.axhline(first - 0.5, color=GRAY, linewidth=0.7)


def _curve_label(name: str, informed: Sequence[str]) -> str:
    return "\n".join(textwrap.wrap(name + (" (knows the target)" if name in informed else ""), _LONGEST))
