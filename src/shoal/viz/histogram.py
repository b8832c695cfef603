"""Histogram of phi: how many buoys move away from the target, stay, or move toward it."""

from typing import TYPE_CHECKING

import numpy as np

from shoal.metrics.heading_bearing import CENTERS
from shoal.record.record import Record
from shoal.viz.legend import headroom, short_name
from shoal.viz.style import GRAY, fleet_color

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_phi_histogram(axes: "Axes", record: Record) -> None:
    """Draw mean agents per step over phi, fleets stacked; bins have their true widths, the outer two half of the rest.

    Kwa et al., Heterogeneous Swarms, Eq. 8. Bars of all fleets sum to N.
    """
    from matplotlib.ticker import MaxNLocator

    middle = (CENTERS[:-1] + CENTERS[1:]) / 2
    edges = np.concatenate([[-1.0], middle, [1.0]])
    _label(axes)
    if not all(tally.present.any() for tally in record.tallies):
        axes.set_yticks([])
        axes.text(0.5, 0.5, "no target was ever there", transform=axes.transAxes, ha="center", color=GRAY)
        return
    histogram = record.phi_histogram()  # (F, 11)
    base = np.zeros(CENTERS.size)
    for fleet, heights in enumerate(histogram):
        axes.bar(
            edges[:-1], heights, np.diff(edges), base, align="edge", color=fleet_color(fleet),
            edgecolor="white", linewidth=0.6, label=short_name(record.facts.fleets[fleet]),
        )  # fmt: skip
        base += heights
    axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    axes.set_ylim(0.0, base.max())
    headroom(axes, [short_name(name) for name in record.facts.fleets] if len(histogram) > 1 else [])


def _label(axes: "Axes") -> None:
    axes.set_title("Heading relative to the target")
    axes.set_xlabel("heading\u2013bearing correlation φ")
    axes.set_ylabel("mean agents per step")
    axes.set_xlim(-1.02, 1.02)
    axes.set_xticks([-1.0, -0.5, 0.0, 0.5, 1.0])
    axes.set_xticklabels(["\u22121\naway", "\u22120.5", "0\nstationary\nor across", "0.5", "1\ntoward"])
    axes.grid(axis="y")
