"""Histogram of phi: how many buoys move away from the target, stay, or move toward it."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from shoal.drawing.legend import headroom, name_lines
from shoal.drawing.style import GRAY, fleet_color, fleet_line
from shoal.record.frames import PHI_EDGES
from shoal.record.record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes


WIDTHS = np.diff(PHI_EDGES)
DENSITY = "agents per unit of φ"  # not per bin: the outer two are half as wide


def draw_phi_histogram(axes: "Axes", record: Record) -> None:
    """Draw the density of agents over phi, fleets stacked: the areas of all bars sum to N, the outer bins are narrower.

    Kwa et al., Heterogeneous Swarms, Eq. 8.
    """
    from matplotlib.ticker import MaxNLocator

    axes.set_title("Heading relative to the target")
    axes.set_ylabel(DENSITY)
    label_phi(axes)
    if not all(tally.present.any() for tally in record.tallies):
        axes.set_yticks([])
        axes.text(0.5, 0.5, "no target was ever there", transform=axes.transAxes, ha="center", color=GRAY)
        return
    histogram = record.phi_histogram()  # (F, 11)
    if not np.isfinite(histogram).all():
        axes.set_yticks([])
        axes.text(0.5, 0.5, "not measured", transform=axes.transAxes, ha="center", color=GRAY)
        return
    names = [name_lines(name) for name in record.facts.fleets]
    base = draw_phi_bars(axes, histogram, names)
    axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    axes.set_ylim(0.0, base.max())
    headroom(axes, names if len(names) > 1 else [])


def draw_phi_bars(
    axes: "Axes", histogram: npt.ArrayLike, labels: Sequence[str], fleets: Sequence[int] | None = None
) -> npt.NDArray[np.float64]:
    """Draw the bars of each fleet, (F, 11) agents per bin, on those of the one before, as densities over phi.

    Return where the topmost end (11,). `fleets` are the numbers that give the colors, default 0, 1, ...
    """
    base: npt.NDArray[np.float64] = np.zeros(PHI_EDGES.size - 1)
    rows = np.atleast_2d(np.asarray(histogram, float)) / WIDTHS
    for fleet, heights, label in zip(fleets or range(len(rows)), rows, labels, strict=True):
        axes.bar(
            PHI_EDGES[:-1], heights, WIDTHS, base, align="edge", color=fleet_color(fleet),
            edgecolor=fleet_line(fleet), linewidth=0.5, label=label,
        )  # fmt: skip
        base = base + heights
    return base


def label_phi(axes: "Axes", zero: str = "stationary\nor across") -> None:
    """Label a horizontal axis of phi."""
    axes.set_xlabel("heading\u2013bearing correlation φ")
    axes.set_xlim(-1.02, 1.02)
    axes.set_xticks([-1.0, -0.5, 0.0, 0.5, 1.0])
    axes.set_xticklabels(["\u22121\naway", "\u22120.5", f"0\n{zero}", "0.5", "1\ntoward"])
    axes.grid(axis="y")
