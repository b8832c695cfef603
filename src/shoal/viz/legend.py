"""The legend above a snapshot: fleets, target, and the rim of those on target."""

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.record.record import Record
from shoal.viz.style import INK, TARGET, fleet_color, fleet_marker

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROW = 0.18  # [inch] height of a row
_LETTER, _SIGN = 0.056, 0.36  # [inch] width of a letter; of a sign and the space around it
_LONGEST = 26  # letters of a name


def draw_legend(axes: "Axes", record: Record) -> float:
    """Name the signs of a snapshot above it; return the height taken [inch]."""
    from matplotlib.lines import Line2D

    figure = axes.get_figure(root=True)
    page = figure.get_figwidth() if figure else 0.0
    width = page * axes.get_position(original=True).width

    def sign(label: str, marker: str, **look: Any) -> Line2D:
        return Line2D([], [], linestyle="none", marker=marker, label=label, **look)

    signs = [
        sign(label, fleet_marker(fleet), color=fleet_color(fleet), markersize=max(4.0, marker_area(record, fleet) ** 0.5))
        for fleet, label in enumerate(_fleet_labels(record))
    ]
    signs.append(sign("on target", "o", markerfacecolor="white", markeredgecolor=INK, markeredgewidth=1.3, markersize=6))
    signs.append(sign("target", "o", markerfacecolor=TARGET + "38", markeredgecolor=TARGET, markersize=8))
    axes.legend(
        handles=signs, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=_columns(record, width),
        borderaxespad=0.2, borderpad=0.2,
    )  # fmt: skip
    return legend_height(record, width)


def legend_height(record: Record, width: float) -> float:
    """Height of the legend above a snapshot of a width [inch]."""
    entries = len(record.facts.fleets) + 2
    return ROW * -(-entries // _columns(record, width))


def marker_area(record: Record, fleet: int) -> float:
    """Area of a buoy's marker [pt2]: shrinks with the swarm, grows with the fleet's top speed."""
    facts = record.facts
    base = float(np.clip(44.0 * (50.0 / facts.agents) ** 0.5, 9.0, 60.0))
    return base * (0.5 + 0.5 * facts.max_speeds[fleet] / max(facts.max_speeds))


def short_name(name: str) -> str:
    """A name that fits a legend."""
    return textwrap.shorten(name, _LONGEST, placeholder="…") if " " in name else name[:_LONGEST]


def _fleet_labels(record: Record) -> list[str]:
    facts = record.facts
    return [f"{short_name(name)}, {speed:g} m/s" for name, speed in zip(facts.fleets, facts.max_speeds, strict=True)]


def _columns(record: Record, width: float) -> int:
    """As many as fit beside each other, the longest label deciding."""
    labels = _fleet_labels(record)
    longest = _SIGN + _LETTER * max(len(label) for label in [*labels, "on target"])
    return int(np.clip(width / longest, 1, len(labels) + 2))
