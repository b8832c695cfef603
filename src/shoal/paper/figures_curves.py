"""Curves against the share of fast buoys and against k: time on target and velocity fluctuation."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.drawing.legend import headroom
from shoal.drawing.style import INK, lettered, line_color, new_figure, style
from shoal.experiments.rows import Row
from shoal.paper.figures_peaks import PeakMark, peak_of
from shoal.paper.figures_series import (
    ALL_SLOW,
    DOUBLE,
    SINGLE,
    Quantity,
    curve,
    levels,
    plain_rows,
    seeds_text,
    series,
    show_means,
    speed_text,
    spread,
    swarm_text,
    where,
)
from shoal.paper.plan import AGENTS, MIXED
from shoal.paper.results import Figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MARKERS = ("o", "s", "^", "D", "v", "P")
_SWARM_COLORS = tuple(map(line_color, range(3)))
_LIGHTEST = 0.55  # of the scale of colors: lighter ones are too pale for a line
_MOST_K = 6  # curves in one panel
_PAPER_K = 20  # of the paper's figures against the share


def share_figure(rows: Sequence[Row], name: str, title: str, quantities: Sequence[Quantity]) -> Figure | None:
    """Draw quantities (a row of panels each) against the share of fast buoys, a curve per k, a panel per target speed.

    Returns None where no k was run with two shares.
    """
    known = plain_rows(rows)
    ks = _ks_with_shares(known)
    rows = [row for row in known if row["neighbors"] in ks]
    speeds = levels(rows, "target_speed")
    if not ks or not speeds:
        return None
    data: list[Row] = []
    with style():
        colors = _shades(len(ks))
        figure = new_figure(DOUBLE if len(speeds) > 1 else SINGLE, 0.75 + 2.05 * len(quantities))
        figure.set_layout_engine("constrained", h_pad=0.06, w_pad=0.06)
        panels = figure.subplots(len(quantities), len(speeds), squeeze=False, sharex=True, sharey="row")
        for (i, quantity), (j, speed) in _pairs(quantities, speeds):
            axes = panels[i, j]
            for k, color, marker in zip(ks, colors, _MARKERS, strict=False):
                points = series(where(rows, neighbors=k, target_speed=speed), "fast", quantity)
                label = f"k = {k} (the paper's)" if k == _PAPER_K and len(ks) > 1 else f"k = {k}"
                curve(axes, points, label, color, marker, 100 / AGENTS, bold=k == _PAPER_K)
                data += points.rows("fast", quantity, neighbors=k, target_speed=speed)
            _label_panel(axes, i * len(speeds) + j, quantity if j == 0 else None, speed)
            axes.set_xticks(range(0, 101, 20))
            show_means(panels[i, 0], [row for row in data if row["quantity"] == quantity.name])
        for axes in panels[-1]:
            axes.set_xlabel("share of fast buoys [%]")
        handles, labels = panels[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper left", ncols=min(len(ks), 3 * len(speeds)), borderaxespad=0.2)
    names = ", and below ".join(_capital(quantity.name) for quantity in quantities)
    caption = (
        f"{names}, of a swarm of {AGENTS} buoys against its share of fast ones, at "
        f"{_several('k', ks)}, for {_speeds(speeds)}. {seeds_text(rows)} Seeds are shared by all points, so that "
        "differences between points are surer than their bands suggest."
    )
    return Figure(name, title, caption, figure, data)


def k_figure(rows: Sequence[Row], name: str, title: str, quantity: Quantity, symbol: str) -> Figure | None:
    """Draw a quantity against k for the mixed and the all-slow swarm, peaks marked with their intervals.

    Returns None where no swarm was run with two k.
    """
    known = plain_rows(rows)
    swarms = _swarms_with_ks(known)
    rows = [row for row in known if row["fast"] in swarms]
    speeds = levels(rows, "target_speed")
    if not swarms or not speeds:
        return None
    data: list[Row] = []
    with style():
        figure = new_figure(DOUBLE if len(speeds) > 1 else SINGLE, 3.35)
        figure.set_layout_engine("constrained", h_pad=0.06, w_pad=0.06)
        panels = figure.subplots(1, len(speeds), squeeze=False, sharey=True)[0]
        peaks: list[str] = []
        for j, speed in enumerate(speeds):
            for fast, color, marker in zip(swarms, _SWARM_COLORS, _MARKERS, strict=False):
                cell = where(rows, fast=fast, target_speed=speed)
                points = series(cell, "neighbors", quantity)
                peak = peak_of(cell, quantity)
                curve(panels[j], points, swarm_text(fast), color, marker)
                data += points.rows("neighbors", quantity, fast=fast, target_speed=speed)
                if peak:
                    _draw_peak(panels[j], color, marker, peak)
                    peaks.append(f"{symbol} {peak.text} ({swarm_text(fast)}, {speed:g} m/s)")
                    data += peak.rows(quantity, fast=fast, target_speed=speed)
            _label_panel(panels[j], j, quantity if j == 0 else None, speed)
            panels[j].set_xlabel("number of neighbors k")
            panels[j].set_xticks([2, 10, 20, 30, 40, 49])
        show_means(panels[0], [row for row in data if row["quantity"] == quantity.name])
        figure.draw_without_rendering()  # panels take their places
        _legends_above(panels)
    caption = (
        f"{_capital(quantity.name)} of the {_several('swarm', [swarm_text(fast) for fast in swarms])} against the "
        f"number of neighbors k that a buoy listens to, for {_speeds(speeds)}. {_told_peaks(peaks)}"
        f"{seeds_text(rows)}"
    )
    return Figure(name, title, caption, figure, data)


def _ks_with_shares(rows: Sequence[Row]) -> list[Any]:
    """The k that were run with the most shares, at most six."""
    shares = {k: len(levels(where(rows, neighbors=k), "fast")) for k in levels(rows, "neighbors")}
    enough = max(2, max(shares.values(), default=0) / 2)
    return spread([k for k, count in shares.items() if count >= enough], _MOST_K, _PAPER_K)


def _swarms_with_ks(rows: Sequence[Row]) -> list[int]:
    """Fast buoys in the mixed and in the all-slow swarm, if they were run with two k or more."""
    return [fast for fast in (MIXED, ALL_SLOW) if len(levels(where(rows, fast=fast), "neighbors")) > 1]


def _draw_peak(axes: "Axes", color: str, marker: str, peak: PeakMark) -> None:
    """A peak where it is, with the intervals of its k and of its height."""
    place, height = peak.place, peak.height
    for x, y in (([place.low, place.high], [height.value] * 2), ([place.value] * 2, [height.low, height.high])):
        axes.plot(x, y, color=INK, linewidth=1.0, solid_capstyle="butt", zorder=3.5)
    axes.plot([place.value], [height.value], marker, color=color, markeredgecolor=INK, markeredgewidth=0.9,
              markersize=5.5, zorder=4)  # fmt: skip


def _told_peaks(peaks: Sequence[str]) -> str:
    """What the crosses are, and their numbers; nothing without any."""
    return f"Crosses: peaks, with the 95 % intervals of place and height; {'; '.join(peaks)}. " if peaks else ""


def _legends_above(panels: Sequence["Axes"]) -> None:
    """A legend in each panel, above the data; panels share their y axis, so room is made once."""
    headroom(panels[0], panels[0].get_legend_handles_labels()[1])
    for axes in panels[1:]:
        axes.legend(loc="upper left", ncols=1, borderaxespad=0.1, borderpad=0.2)


def _label_panel(axes: "Axes", number: int, quantity: Quantity | None, speed: float) -> None:
    """Letter and speed above, the quantity beside the first of a row."""
    axes.grid(visible=True)
    axes.set_title(lettered(number, speed_text(speed)))
    if quantity:
        axes.set_ylabel(quantity.label)


def _shades(count: int) -> list[Any]:
    """Colors from dark to light, for values in order."""
    from matplotlib import colormaps

    return [colormaps["viridis"](share) for share in np.linspace(0.0, _LIGHTEST, count)]


def _pairs(rows: Sequence[Any], columns: Sequence[Any]) -> list[tuple[tuple[int, Any], tuple[int, Any]]]:
    return [(row, column) for row in enumerate(rows) for column in enumerate(columns)]


def _capital(text: str) -> str:
    return text[0].upper() + text[1:]


def _several(noun: str, values: Sequence[Any]) -> str:
    listed = ", ".join(str(value) for value in values)
    return f"{noun} = {listed}" if noun == "k" else f"{noun}{'s' if len(values) > 1 else ''} ({'; '.join(values)})"


def _speeds(speeds: Sequence[float]) -> str:
    return "a target of " + " and ".join(f"{speed:g}" for speed in speeds) + " m/s"
