"""What the paper says beside its figures: time on target with everything else that was tried, as dots."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from shoal.drawing.style import lettered, line_color, new_figure, style
from shoal.experiments.rows import Row
from shoal.metrics.summary import Bounds
from shoal.paper.curves import curve, intervals, values_of
from shoal.paper.figures_series import DOUBLE, TIME_ON_TARGET
from shoal.paper.plan import MIXED
from shoal.paper.results import Figure
from shoal.paper.side_plan import BASE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_NEIGHBORS = 20
_SPEEDS = ((line_color(0), "o", 0.15), (line_color(2), "s", -0.15))


def sides_figure(readings: Mapping[str, Sequence[Row]]) -> Figure | None:
    """Draw time on target of the mixed swarm at k = 20 in every setting, a panel per reading.

    Parameters
    ----------
    readings : rows of the settings under each reading, labeled by `side`
    """
    known = {name: rows for name, rows in readings.items() if rows}
    names = list(dict.fromkeys(row["side"] for rows in known.values() for row in rows))
    if not names:
        return None
    data: list[Row] = []
    with style():
        figure = new_figure(DOUBLE, 0.9 + 0.19 * len(names))
        figure.set_layout_engine("constrained", h_pad=0.05, w_pad=0.05)
        panels = figure.subplots(1, len(known), sharey=True, squeeze=False)[0]
        for number, (axes, (reading, rows)) in enumerate(zip(panels, known.items(), strict=True)):
            data += _draw(axes, reading, rows, names)
            axes.set_title(lettered(number, reading))
            axes.set_xlabel(TIME_ON_TARGET.label)
            axes.set_xlim(0.0, 1.0)
            axes.grid(axis="x")
            axes.tick_params(axis="y", length=0)
        panels[0].set_yticks(range(len(names)), names)
        panels[0].set_ylim(len(names) - 0.5, -0.5)
        figure.legend(
            handles=_signs(values_of(data, "target_speed")), loc="outside upper left", ncols=2, borderaxespad=0.2
        )
    caption = (
        f"The mixed swarm (15 fast of 50, k = {_NEIGHBORS}) with one thing changed at a time, and other strategies in "
        "its place: time on target with 95 % intervals. The dashed lines are the paper's swarm as it is."
    )
    return Figure("sides", "What the paper says besides", caption, figure, data)


def _draw(axes: "Axes", reading: str, rows: Sequence[Row], names: Sequence[str]) -> list[Row]:
    data: list[Row] = []
    for (color, marker, shift), speed in zip(_SPEEDS, values_of(rows, "target_speed"), strict=False):
        for line, name in enumerate(names):
            mine = [row for row in rows if row["side"] == name]
            found = curve(mine, "time_on_target", fast=MIXED, target_speed=speed)
            if _NEIGHBORS not in found.x:
                continue
            at, low, high = intervals(list(found.runs.T), Bounds(0.0, 1.0))[list(found.x).index(_NEIGHBORS)]
            axes.plot([low, high], [line - shift] * 2, color=color, linewidth=1.6, solid_capstyle="butt")
            axes.plot([at], [line - shift], marker, color=color, markersize=4)
            place = {"reading": reading, "setting": name, "target_speed": speed}
            data.append({**place, "unit": TIME_ON_TARGET.unit, "value": at, "low": low, "high": high})
            if name == BASE:
                axes.axvline(at, color=color, linewidth=0.8, linestyle=(0, (4, 3)), zorder=1)
    for line in range(1, len(names), 2):
        axes.axhspan(line - 0.5, line + 0.5, color="#f3f5f7", linewidth=0, zorder=0)
    return data


def _signs(speeds: Sequence[float]) -> list[Any]:
    from matplotlib.lines import Line2D

    return [
        Line2D([], [], color=color, marker=marker, markersize=4, linewidth=1.6, label=f"target {speed:g} m/s")
        for (color, marker, _), speed in zip(_SPEEDS, speeds, strict=False)
    ]
