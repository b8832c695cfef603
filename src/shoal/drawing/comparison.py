"""Strategies side by side: bars with 95 % intervals, or curves with bands, and standing still as the yardstick."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.drawing.curves import Curve, draw_band
from shoal.drawing.style import FLEET_COLORS, GRAY, INK, TARGET, new_figure, style
from shoal.drawing.words import shorten

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ROW = 0.2  # [inch] height of a bar and the space around it
_LETTER = 0.066  # [inch] width of a letter
_TITLE, _BELOW, _FOOT = 0.36, 0.42, 0.2  # [inch] above a panel, below it, and the line at the foot of the page
_PANELS, _GAP = 4, 0.25  # in a row; between them [inch]
_LINES: tuple[Any, ...] = ("-", "--", ":", "-.")
_CURVES = tuple(color for color in FLEET_COLORS if color != "#F0E442")  # yellow is too pale for a line
_YARDSTICK = TARGET  # standing still is what every strategy has to beat: one color of its own


@dataclass(frozen=True)
class Bar:
    """Mean and 95 % interval of a strategy (None where it cannot be determined); informed: it knows the target."""

    strategy: str
    mean: float
    low: float | None
    high: float | None
    informed: bool = False


@dataclass(frozen=True)
class Panel:
    """Bars under one condition, from the top down; every panel of a figure has the same strategies in one order."""

    title: str
    bars: Sequence[Bar]


def bars_figure(panels: Sequence[Panel], x_label: str, yardstick: str = "lattice") -> "Figure":
    """Return a figure with a panel of horizontal bars per condition; a line through all marks the yardstick."""
    names = [bar.strategy for bar in panels[0].bars]
    columns = min(len(panels), _PANELS)
    rows = -(-len(panels) // columns)
    left = 0.25 + _LETTER * max(len(shorten(name, 28)) for name in names)
    wide = 4.4 if columns == 1 else 2.0
    above = _TITLE if any(panel.title for panel in panels) else 0.12
    tall = _ROW * (len(names) + 0.8)
    page = (left + columns * (wide + _GAP) + 0.05, rows * (above + tall + _BELOW) + _FOOT)
    limits = _limits([bar for panel in panels for bar in panel.bars])
    with style():
        from matplotlib.ticker import MaxNLocator

        figure = new_figure(*page)
        for number, panel in enumerate(panels):
            row, column = divmod(number, columns)
            bottom = page[1] - (row + 1) * (above + tall + _BELOW) + _BELOW
            box = (left + column * (wide + _GAP), bottom, wide, tall)
            axes = figure.add_axes((box[0] / page[0], box[1] / page[1], box[2] / page[0], box[3] / page[1]))
            _draw_bars(axes, panel, yardstick, named=column == 0)
            axes.set_xlim(*limits)
            axes.xaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
            axes.set_xlabel(x_label)
        note = f"whiskers: 95 % interval over runs; dashed: {yardstick}"
        if any(bar.informed for bar in panels[0].bars):
            note += "; hatched: knows the target"
        figure.text(1 - 0.1 / page[0], 0.05 / page[1], note, ha="right", va="bottom", fontsize=7, color=GRAY)
    return figure


def curves_figure(
    curves: Sequence[Curve], x_label: str, y_label: str, yardstick: str = "lattice", informed: Sequence[str] = ()
) -> "Figure":
    """Return a figure of one curve per strategy, with bands; the legend is in the order of their right ends."""
    ordered = sorted(curves, key=lambda curve: (curve.label in informed, -np.nan_to_num(curve.mean[-1], nan=-np.inf)))
    labels = [_curve_label(curve.label, informed) for curve in ordered]
    legend = 0.5 + _LETTER * max(len(label) for label in labels)
    tall = max(3.0, 0.19 * len(curves))
    page = (0.7 + 4.6 + legend, _TITLE + tall + _BELOW + _FOOT)
    with style():
        figure = new_figure(*page)
        axes = figure.add_axes((0.7 / page[0], (_BELOW + _FOOT) / page[1], 4.6 / page[0], tall / page[1]))
        colors = {
            curve.label: number for number, curve in enumerate(each for each in curves if each.label != yardstick)
        }
        for curve, label in zip(ordered, labels, strict=True):
            mean, low, high = (np.array(values, float) for values in (curve.mean, curve.low, curve.high))
            if curve.label == yardstick:
                draw_band(axes, curve.x, mean, low, high, label, _YARDSTICK)
                axes.lines[-1].set_linewidth(2.4)
                continue
            number = colors[curve.label]
            draw_band(axes, curve.x, mean, low, high, label, _CURVES[number % len(_CURVES)])
            axes.lines[-1].set_linestyle(_LINES[number // len(_CURVES) % len(_LINES)])
        axes.set_title(y_label)
        axes.set_xlabel(x_label)
        axes.grid(visible=True)
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.03), borderaxespad=0.1, handlelength=2.6)
        note = "bands: 95 % interval over runs"
        figure.text(1 - 0.1 / page[0], 0.05 / page[1], note, ha="right", va="bottom", fontsize=7, color=GRAY)
    return figure


def _draw_bars(axes: "Axes", panel: Panel, yardstick: str, *, named: bool) -> None:
    at = np.arange(len(panel.bars))
    for place, bar in zip(at, panel.bars, strict=True):
        color = _YARDSTICK if bar.strategy == yardstick else FLEET_COLORS[0]
        if bar.informed:
            look: dict[str, Any] = {"facecolor": "white", "edgecolor": GRAY, "hatch": "////", "linewidth": 0.7}
        else:
            look = {"facecolor": color, "edgecolor": color, "linewidth": 0.7}
        axes.barh(place, bar.mean, height=0.68, gid=f"bar-{bar.strategy}", **look)
        if bar.low is not None and bar.high is not None:
            axes.plot([bar.low, bar.high], [place, place], color=INK, linewidth=1.1, solid_capstyle="butt")
            axes.plot([bar.low, bar.high], [place, place], "|", color=INK, markersize=5, markeredgewidth=1.1)
    still = next((bar.mean for bar in panel.bars if bar.strategy == yardstick), None)
    if still is not None and np.isfinite(still):
        axes.axvline(still, color=_YARDSTICK, linewidth=1.0, linestyle="--", gid="yardstick")
    _divide(axes, panel)
    axes.set_yticks(at, [shorten(bar.strategy, 28) for bar in panel.bars] if named else [""] * at.size)
    axes.tick_params(axis="y", length=0)
    axes.set_ylim(at.size - 0.4, -0.6)
    axes.set_title(panel.title)
    axes.grid(axis="x")


def _limits(bars: Sequence[Bar]) -> tuple[float, float]:
    """From 0 to a little beyond the longest whisker: no metric is below 0, whatever Student's t says."""
    ends = [end for bar in bars for end in (bar.mean, bar.high) if end is not None and np.isfinite(end)]
    return 0.0, 1.03 * max([0.0, *ends]) or 1.0


def _divide(axes: "Axes", panel: Panel) -> None:
    """A line between contenders and those that know the target."""
    first = next((place for place, bar in enumerate(panel.bars) if bar.informed), 0)
    if first:
        axes.axhline(first - 0.5, color=GRAY, linewidth=0.7)


def _curve_label(name: str, informed: Sequence[str]) -> str:
    return shorten(name, 28) + (" (knows the target)" if name in informed else "")
