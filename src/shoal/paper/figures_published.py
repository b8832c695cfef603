"""The predecessor's curves over k, measured and published, and what is between them."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from shoal.drawing.style import GRAY, INK, lettered, line_color, new_figure, style
from shoal.experiments.rows import Row
from shoal.paper.figures_series import (
    DOUBLE,
    RESPONSE,
    TIME_ON_TARGET,
    Quantity,
    curve,
    levels,
    plain_rows,
    seeds_text,
    series,
    show_means,
)
from shoal.paper.results import Figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ADAPTIVE, CONSTANT = "aamas2020", "aamas2020-constant"
_LOOKS = {
    ADAPTIVE: ("adaptive repulsion", line_color(0), "o"),
    CONSTANT: ("constant repulsion", line_color(1), "s"),
}
_QUANTITIES = (TIME_ON_TARGET, RESPONSE)


def published_figure(rows: Sequence[Row], published: Sequence[Row]) -> Figure | None:
    """Draw time on target and response over k beside the published points, and the residuals below.

    Parameters
    ----------
    published : metric, neighbors, published; with measured, low, high where cells are compared

    Returns None where nothing was run.
    """
    rows = plain_rows(rows)
    if not levels(rows, "neighbors"):
        return None
    data: list[Row] = []
    with style():
        figure = new_figure(DOUBLE, 4.7)
        figure.set_layout_engine("constrained", h_pad=0.05, w_pad=0.07)
        panels = figure.subplots(2, len(_QUANTITIES), sharex=True, height_ratios=[2.4, 1], squeeze=False)
        for j, quantity in enumerate(_QUANTITIES):
            points = [row for row in published if row.get("metric") == quantity.column and _known(row, "published")]
            shown = _draw_curves(panels[0, j], rows, points, quantity)
            show_means(panels[0, j], shown)
            data += shown + _draw_residuals(panels[1, j], points, quantity)
            panels[1, j].set_xlabel("number of neighbors k")
            panels[1, j].set_xticks(levels(rows, "neighbors")[::2])
        for number, axes in enumerate(panels.ravel()):
            axes.set_title(lettered(number))
        handles, labels = panels[0, 0].get_legend_handles_labels()
        figure.align_ylabels(panels[:, 0])
        figure.align_ylabels(panels[:, 1])
        figure.legend(handles, labels, loc="outside upper left", ncols=len(labels), borderaxespad=0.2)
    caption = (
        "The homogeneous predecessor (AAMAS 2020): time on target and response of 50 equal buoys against k. Crosses "
        "are the published values, for adaptive repulsion. Below, measured less published with the 95 % interval; the "
        "gray band is what is tolerated; intervals may reach out of the panel. "
        f"{seeds_text(rows)}"
    )
    return Figure("published", "The predecessor's published curves", caption, figure, data)


def _draw_curves(axes: "Axes", rows: Sequence[Row], published: Sequence[Row], quantity: Quantity) -> list[Row]:
    data: list[Row] = []
    for preset in dict.fromkeys(row.get("preset", ADAPTIVE) for row in rows):
        label, color, marker = _LOOKS.get(preset, (str(preset), line_color(2), "^"))
        mine = [row for row in rows if row.get("preset", ADAPTIVE) == preset]
        points = series(mine, "neighbors", quantity)
        curve(axes, points, label, color, marker)
        data += points.rows("neighbors", quantity, source=f"measured, {label}")
    x = [row["neighbors"] for row in published]
    y = [quantity.factor * row["published"] for row in published]
    if x:
        axes.plot(x, y, "x", color=INK, markersize=6, markeredgewidth=1.4, zorder=4, label="published")
    data += [
        {"source": "published", "neighbors": k, "quantity": quantity.name, "unit": quantity.unit, "mean": value,
         "low": math.nan, "high": math.nan}
        for k, value in zip(x, y, strict=True)
    ]  # fmt: skip
    axes.set_ylabel(quantity.label)
    axes.grid(visible=True)
    return data


def _draw_residuals(axes: "Axes", published: Sequence[Row], quantity: Quantity) -> list[Row]:
    """Measured less published, in the unit of the panel above."""
    unit = quantity.unit
    axes.set_ylabel(f"residual\n[{unit}]")
    axes.grid(visible=True)
    axes.axhline(0.0, color=GRAY, linewidth=0.9)
    data: list[Row] = []
    for row in (row for row in published if _known(row, "measured")):
        k, truth = row["neighbors"], row["published"]
        at, low, high = (quantity.factor * (row.get(name, math.nan) - truth) for name in ("measured", "low", "high"))
        axes.vlines(k, low, high, color=line_color(0), linewidth=1.4)
        axes.plot([k], [at], "o", color=line_color(0), markersize=3.8)
        data.append({"source": "measured less published", "neighbors": k, "quantity": quantity.name, "unit": unit,
                     "mean": at, "low": low, "high": high})  # fmt: skip
    tolerance = sorted(
        (row["neighbors"], quantity.factor * row["tolerance"]) for row in published if _known(row, "tolerance")
    )
    if tolerance:
        k, half = np.array(tolerance).T
        axes.fill_between(k, -half, half, color=GRAY, alpha=0.15, linewidth=0, zorder=0.5)
        data += [
            {
                "source": "tolerance",
                "neighbors": at,
                "quantity": quantity.name,
                "unit": unit,
                "mean": 0.0,
                "low": -each,
                "high": each,
            }
            for at, each in tolerance
        ]
    reach = max([1.4 * abs(row["mean"]) for row in data] + [2.2 * half for _, half in tolerance], default=1.0)
    axes.set_ylim(-reach or -1.0, reach or 1.0)  # bars may reach out
    return data


def _known(row: Row, name: str) -> bool:
    value = row.get(name)
    return isinstance(value, (int, float)) and math.isfinite(value)
