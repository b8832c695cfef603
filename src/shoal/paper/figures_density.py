"""Swarms of any density: tracking, response, exploration and exploitation, and what the number of agents changes."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from shoal.drawing.style import lettered, line_color, new_figure, style
from shoal.experiments.rows import Row
from shoal.paper.figures_series import (
    DOUBLE,
    TIME_ON_TARGET,
    XI,
    Quantity,
    curve,
    levels,
    seeds_text,
    series,
    show_means,
    where,
)
from shoal.paper.later_plan import AGENTS, AT_SIDES, NUMBER_NEIGHBORS
from shoal.paper.results import Figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_ON_TARGET = Quantity("on_target_share", "agents on target", "share", most=1.0)
_COVERAGE = Quantity("coverage", "coverage in 1,000 steps", "share", most=1.0)
_MARKERS = ("o", "s", "^", "D", "v")
_COLORS = tuple(map(line_color, range(5)))
_OVER_DENSITY = (TIME_ON_TARGET, XI, _ON_TARGET, _COVERAGE)
_OVER_NUMBER = (TIME_ON_TARGET, _ON_TARGET)


def density_figures(rows: Mapping[str, Sequence[Row]]) -> list[Figure]:
    """Return the figure, of six panels; none where nothing was run.

    Parameters
    ----------
    rows : by group of later_plan.density_groups
    """
    side = _known(rows.get("side", ()), AGENTS)
    if not side:
        return []
    data: list[Row] = []
    with style():
        figure = new_figure(DOUBLE, 5.6)
        figure.set_layout_engine("constrained", h_pad=0.05, w_pad=0.06)
        panels: Any = figure.subplots(2, 3).ravel()
        for axes, quantity in zip(panels, _OVER_DENSITY, strict=False):
            data += _over_density(axes, side, quantity)
        for axes, quantity in zip(panels[4:], _OVER_NUMBER, strict=True):
            data += _over_number(axes, rows, quantity)
        for number, axes in enumerate(panels):
            axes.set_title(lettered(number))
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper left", ncols=5, borderaxespad=0.2)
        figure.legend(*panels[4].get_legend_handles_labels(), loc="outside lower right", ncols=3, borderaxespad=0.2)
    caption = (
        f"(a) to (d) {AGENTS} agents in areas of 8 to 64 m, against their density, a curve per k. (e, f) The number of "
        f"agents at three fixed densities, k = {NUMBER_NEIGHBORS}. {seeds_text(side)}"
    )
    return [Figure("density", "Density: phases of tracking, and the number of agents", caption, figure, data)]


def _known(rows: Sequence[Row], agents: int | None = None) -> list[Row]:
    """Finished runs with what the panels show."""
    found = []
    for row in rows:
        if row.get("status", "done") == "done":
            count = agents or int(row["agents"])
            density = count / float(row["area.width"]) ** 2
            found.append({**row, "density": density, "on_target_share": float(row["engaged"]) / count})
    return found


def _over_density(axes: "Axes", rows: Sequence[Row], quantity: Quantity) -> list[Row]:
    data: list[Row] = []
    for k, color, marker in zip(levels(rows, "neighbors"), _COLORS, _MARKERS, strict=False):
        points = series(where(rows, neighbors=k), "density", quantity)
        curve(axes, points, f"k = {k}", color, marker)
        data += points.rows("density", quantity, curve=f"k = {k}")
    axes.set_xscale("log")
    ticks = [tick for tick in (0.01, 0.03, 0.1, 0.3, 1.0) if tick < 1.1 * max(row["density"] for row in rows)]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_xlabel("agents per m²")
    axes.set_ylabel(quantity.label)
    axes.grid(visible=True)
    show_means(axes, data)
    return data


def _over_number(axes: "Axes", rows: Mapping[str, Sequence[Row]], quantity: Quantity) -> list[Row]:
    data: list[Row] = []
    for side, color, marker in zip(AT_SIDES, _COLORS, _MARKERS, strict=False):
        mine = _known(rows.get(f"number/{side:g}", ()))
        label = f"{AGENTS / side**2:.2g} per m²"
        points = series(mine, "agents", quantity)
        if points.x:
            curve(axes, points, label, color, marker)
            data += points.rows("agents", quantity, curve=label)
    axes.set_xscale("log", base=2)
    ticks = levels([row for side in AT_SIDES for row in rows.get(f"number/{side:g}", ())], "agents")
    axes.set_xticks(ticks, [str(tick) for tick in ticks])
    axes.minorticks_off()
    axes.set_xlabel("number of agents")
    axes.set_ylabel(quantity.label)
    axes.grid(visible=True)
    if data:
        show_means(axes, data)
    return data
