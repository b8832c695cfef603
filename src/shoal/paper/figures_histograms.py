"""Histograms of the heading-bearing correlation phi: k and target speed down, mixed and all-slow swarm across."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from shoal.drawing.histogram import DENSITY, WIDTHS, draw_phi_bars, label_phi
from shoal.drawing.style import INK, lettered, new_figure, style
from shoal.experiments.rows import Row
from shoal.metrics.heading_bearing import CENTERS
from shoal.metrics.summary import Bounds
from shoal.paper.curves import intervals
from shoal.paper.figures_series import (
    ALL_SLOW,
    DOUBLE,
    Quantity,
    levels,
    plain_rows,
    series,
    swarm_text,
    where,
)
from shoal.paper.plan import AGENTS, MIXED
from shoal.paper.results import Figure
from shoal.record.frames import PHI_EDGES

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_WANTED_K = (10, 20, 40)
_FLEETS = ("fast (BoB-1)", "slow (BoB-0)")
_STATIONARY = Quantity("stationary", "stationary agents", "%", 100.0)
_UNIT = "agents per step"
_PHI = [round(center, 3) for center in CENTERS.tolist()]


def phi_figure(rows: Sequence[Row]) -> Figure | None:
    """Draw mean agents per step over phi, fleets stacked, for up to three k and all target speeds.

    Returns None where no cell of the two swarms has a histogram.
    """
    known = [row for row in plain_rows(rows) if row.get("phi_histogram") and row["fast"] in (MIXED, ALL_SLOW)]
    swarms = [fast for fast in (MIXED, ALL_SLOW) if where(known, fast=fast)]
    ks = _shown_ks(_common_ks(known, swarms))
    lines = [(k, speed) for k in ks for speed in levels(where(known, neighbors=k), "target_speed")]
    if not lines:
        return None
    data: list[Row] = []
    with style():
        figure = new_figure(DOUBLE, 0.95 + 1.12 * len(lines))
        figure.set_layout_engine("constrained", h_pad=0.03, w_pad=0.06)
        panels = figure.subplots(len(lines), len(swarms), squeeze=False, sharex=True, sharey=True)
        for i, (k, speed) in enumerate(lines):
            for j, fast in enumerate(swarms):
                labels = {"fast": fast, "neighbors": k, "target_speed": speed}
                data += _draw_panel(panels[i, j], where(known, **labels), labels)
            panels[i, 0].set_ylabel(f"k = {k}\n{speed:g} m/s", rotation=0, ha="right", va="center", labelpad=6)
        for axes, fast in zip(panels[0], swarms, strict=True):
            axes.set_title(swarm_text(fast).capitalize(), pad=8)
        for number, axes in enumerate(panels.ravel()):
            axes.text(0.075, 0.95, lettered(number), transform=axes.transAxes, va="top", fontweight="bold")
        for axes in panels[-1]:
            label_phi(axes, "still or across")
        figure.supylabel(DENSITY, fontsize=8.0)
        handles, names = _legend(panels[0, 0])
        figure.legend(handles, names, loc="outside upper left", ncols=len(names), borderaxespad=0.2)
    return Figure(
        "phi_histograms", "Where agents head: heading\u2013bearing correlation φ", _caption(known), figure, data
    )


def _common_ks(rows: Sequence[Row], swarms: Sequence[int]) -> list[Any]:
    """The k that both swarms were run with, or, if there is none, all."""
    each = [set(levels(where(rows, fast=fast), "neighbors")) for fast in swarms]
    return sorted(set.intersection(*each) or set.union(*each)) if each else []


def _shown_ks(ks: Sequence[Any]) -> list[Any]:
    """Low, the paper's and high connectivity, or what comes nearest."""
    return sorted({min(ks, key=lambda k: abs(k - wanted)) for wanted in _WANTED_K}) if ks else []


def _draw_panel(axes: "Axes", cell: Sequence[Row], labels: dict[str, Any]) -> list[Row]:
    """Bars of the fleets on each other, the interval of their sum, and how many agents are stationary."""
    axes.grid(axis="y")
    if not cell:
        return []
    fleets = _by_fleet(cell, labels["fast"])
    draw_phi_bars(axes, list(fleets.values()), [_FLEETS[fleet] for fleet in fleets], list(fleets))
    data: list[Row] = [
        {**labels, "agents": _FLEETS[fleet], "phi": at, "unit": _UNIT, "mean": height, "runs": len(cell)}
        for fleet, heights in fleets.items()
        for at, height in zip(_PHI, heights.tolist(), strict=True)
    ]
    totals = intervals(list(np.array([row["phi_histogram"] for row in cell]).T), Bounds(0.0, AGENTS))
    for left, wide, at, (mean, low, high) in zip(PHI_EDGES[:-1], WIDTHS, _PHI, totals, strict=True):
        for color, line in (("white", 2.6), (INK, 1.1)):  # seen on dark bars, too
            axes.vlines(left + wide / 2, low / wide, high / wide, color=color, linewidth=line)
        data.append({**labels, "agents": "all", "phi": at, "unit": _UNIT, "mean": mean,
                     "low": low, "high": high, "runs": len(cell)})  # fmt: skip
    still = series(cell, "neighbors", _STATIONARY)
    if still.mean:
        axes.text(0.15, 0.95, f"{still.mean[0]:.1f} % stationary", transform=axes.transAxes, va="top", fontsize=8)
        data += still.rows("neighbors", _STATIONARY, **labels, agents="all")
    return data


def _by_fleet(cell: Sequence[Row], fast: int) -> dict[int, npt.NDArray[np.float64]]:
    """Mean histogram of each fleet, by its number in the preset (0 fast, 1 slow)."""
    mean = np.mean([row["fleet_phi_histogram"] for row in cell], axis=0)
    numbers = [fleet for fleet, count in enumerate((fast, AGENTS - fast)) if count]
    return dict(zip(numbers, mean, strict=True))


def _legend(axes: "Axes") -> tuple[list[Any], list[str]]:
    from matplotlib.lines import Line2D

    handles, names = axes.get_legend_handles_labels()
    return [*handles, Line2D([], [], color=INK, linewidth=0.9)], [*names, "95 % interval"]


def _caption(rows: Sequence[Row]) -> str:
    seeds = len({row.get("run") for row in rows})
    return (
        "How many agents head away from the target (φ = −1), toward it (φ = 1), or neither: mean agents per step and "
        "unit of φ, so that the areas of all bars of a panel sum to 50; the two outer bins are half as wide. Left the "
        "mixed swarm, right the all-slow one; rows are numbers of neighbors k and target speeds. Agents slower than a "
        "tenth of their top speed count as stationary, at φ = 0, where the bar also holds those that move across. "
        + (f"Black lines: 95 % interval of the sum over {seeds} seeds." if seeds > 1 else "One seed: no intervals.")
    )
