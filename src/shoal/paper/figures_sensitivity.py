"""What the paper leaves open, flipped one at a time: where the curves over k peak then, as dots with intervals."""

from collections.abc import Sequence
from typing import Any

from shoal.drawing.style import lettered, line_color, new_figure, style
from shoal.experiments.rows import Row
from shoal.paper.figures_peaks import peak_of
from shoal.paper.figures_series import (
    ALL_SLOW,
    DOUBLE,
    TIME_ON_TARGET,
    XI,
    Quantity,
    limits,
    plain_rows,
    swarm_text,
    where,
)
from shoal.paper.plan import MIXED
from shoal.paper.results import Figure

_SWARMS = {MIXED: (line_color(0), "o", 0.17), ALL_SLOW: (line_color(1), "s", -0.17)}
_PANELS: tuple[tuple[Quantity, str, str], ...] = (
    (TIME_ON_TARGET, "k* (time on target peaks)", "place"),
    (XI, "k of the peak of Ξ", "place"),
    (TIME_ON_TARGET, "time on target at k* [share]", "height"),
)


def sensitivity_figure(rows: Sequence[Row], speed: float) -> Figure | None:
    """Draw the peaks of every variant, a line each, mixed and all-slow swarm, for a target of this speed [m/s]; the
    first variant's as vertical lines.

    Returns None where no variant has a peak.
    """
    rows = where(plain_rows(rows), target_speed=speed)
    names = list(dict.fromkeys(row["variant"] for row in rows if row.get("variant")))
    peaks = {
        (name, fast, quantity.column): peak
        for name in names
        for fast in _SWARMS
        for quantity in (TIME_ON_TARGET, XI)
        if (peak := peak_of(where(rows, variant=name, fast=fast), quantity)) is not None
    }
    if not peaks:
        return None
    data: list[Row] = []
    with style():
        figure = new_figure(DOUBLE, 0.95 + 0.34 * len(names))
        figure.set_layout_engine("constrained", h_pad=0.05, w_pad=0.05)
        panels = figure.subplots(1, len(_PANELS), sharey=True)
        for axes, (quantity, label, what) in zip(panels, _PANELS, strict=True):
            for fast, (color, marker, shift) in _SWARMS.items():
                for line, name in enumerate(names):
                    peak = peaks.get((name, fast, quantity.column))
                    if peak is None:
                        continue
                    at, low, high = peak.place if what == "place" else peak.height
                    axes.plot([low, high], [line - shift] * 2, color=color, linewidth=1.8, solid_capstyle="butt")
                    face = "white" if peak.at_edge else color
                    axes.plot([at], [line - shift], marker, color=color, markerfacecolor=face, markersize=4.5)
                    data.append(
                        {"variant": name, "fast": fast, "quantity": label, "value": at, "low": low, "high": high}
                    )
                    if line == 0:
                        axes.axvline(at, color=color, linewidth=0.8, linestyle=(0, (4, 3)), zorder=1)
            axes.set_xlim(*limits([row for row in data if row["quantity"] == label], "value"))
            for line in range(1, len(names), 2):
                axes.axhspan(line - 0.5, line + 0.5, color="#f3f5f7", linewidth=0, zorder=0)
            axes.set_xlabel(label)
            axes.grid(axis="x")
        for number, axes in enumerate(panels):
            axes.set_title(lettered(number))
        panels[0].set_yticks(range(len(names)), names)
        panels[0].set_ylim(len(names) - 0.5, -0.5)
        for axes in panels:
            axes.tick_params(axis="y", length=0)
        figure.legend(handles=_signs(), loc="outside upper left", ncols=2, borderaxespad=0.2)
    seeds = len({row.get("run") for row in rows})
    caption = (
        "What the paper does not say, decided the other way, one choice at a time: where time on target and Ξ peak "
        f"over k then, and how high time on target gets, with 95 % intervals over {seeds} seeds, for a target of "
        f"{speed:g} m/s. Dashed lines: {names[0]}, the "
        "paper as printed. Hollow: a peak at the edge of the k that were run. A "
        "conclusion depends on a choice where its dots leave the dashed lines."
    )
    return Figure(f"sensitivity_{speed:g}", f"What the paper does not say, target {speed:g} m/s", caption, figure, data)


def _signs() -> list[Any]:
    from matplotlib.lines import Line2D

    return [
        Line2D([], [], color=color, marker=marker, markersize=4.5, linewidth=1.8, label=swarm_text(fast))
        for fast, (color, marker, _) in _SWARMS.items()
    ]
