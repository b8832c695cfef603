"""Curves: a mean with its band, and time on target over the course of a run."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from shoal.drawing.legend import headroom
from shoal.drawing.style import GRAY, TARGET
from shoal.drawing.words import count, estimate_text, legend_text
from shoal.record.names import label_of
from shoal.record.record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_BAND = 0.2  # opacity


@dataclass
class Curve:
    """Mean and 95 % interval of a metric at each of P places x; no interval (None) where there is one run only."""

    label: str
    x: list[Any] = field(default_factory=list)
    mean: list[float] = field(default_factory=list)
    low: list[float | None] = field(default_factory=list)
    high: list[float | None] = field(default_factory=list)

    def add(self, x: Any, mean: float, low: float | None, high: float | None) -> None:
        """Add a place."""
        self.x.append(x)
        self.mean.append(mean)
        self.low.append(low)
        self.high.append(high)


def draw_band(
    axes: "Axes",
    x: npt.ArrayLike,
    mean: npt.ArrayLike,
    low: npt.ArrayLike,
    high: npt.ArrayLike,
    label: str,
    color: str,
) -> None:
    """Draw a mean (P,) as a line and its interval from low to high as a band; NaN leaves a gap."""
    at, middle, bottom, top = (np.asarray(each, float) for each in (x, mean, low, high))
    axes.fill_between(at, bottom, top, color=color, alpha=_BAND, linewidth=0)
    axes.plot(at, middle, color=color, label=legend_text(label))


def draw_curve(axes: "Axes", curve: Curve, color: str, marker: str, *, bold: bool = False, line: Any = "-") -> None:
    """Draw a curve with its band and a marker per point; a single point gets its interval as a bar."""
    at, middle, bottom, top = (np.asarray(each, float) for each in (curve.x, curve.mean, curve.low, curve.high))
    width, size = (2.0, 3.8) if bold else (1.3, 3.2)
    edge = 1.2 if marker in "x+" else 0.0
    draw_band(axes, at, middle, bottom, top, "", color)
    axes.lines[-1].set(linewidth=width, linestyle=line)
    if at.size == 1:
        axes.vlines(at, bottom, top, color=color, linewidth=1.4)
    axes.plot(at, middle, marker, color=color, markersize=size, markeredgewidth=edge, zorder=3)
    axes.plot(
        [],
        [],
        marker,
        color=color,
        markersize=4.5,
        markeredgewidth=edge,
        linewidth=width,
        linestyle=line,
        label=legend_text(curve.label),
    )  # fmt: skip  (for the legend)


def draw_batches(axes: "Axes", record: Record) -> None:
    """Draw time on target in consecutive batches of each run, the mean over all steps and its 95 % interval.

    Batches without a target are shaded.
    """
    edges = np.concatenate([[0.0], np.cumsum(record.tallies[0].steps)])
    runs = np.array([record.of_batches("time_on_target", run) for run in range(len(record.tallies))])  # (R, B)
    _label(axes, record)
    axes.set_xlim(0.0, float(edges[-1]))
    if not np.isfinite(runs).any():
        axes.set_yticks([])
        axes.text(0.5, 0.5, "no target was ever there", transform=axes.transAxes, ha="center", color=GRAY)
        return
    _draw_runs(axes, (edges[:-1] + edges[1:]) / 2, runs)
    total = record.estimate("time_on_target")
    low, high = total.ci95 or (np.nan, np.nan)
    ends, ones = edges[[0, -1]], np.ones(2)
    draw_band(axes, ends, total.mean * ones, low * ones, high * ones, f"mean {estimate_text(total)}", TARGET)
    top = max(float(np.nanmax(runs)), float(np.nan_to_num(high)), 0.1)
    axes.set_ylim(0.0, min(1.05 * top, 1.0))
    top = axes.get_ylim()[1]
    headroom(axes, [str(label) for label in axes.get_legend_handles_labels()[1]])
    _shade_absence(axes, edges, ~np.isfinite(runs).any(axis=0), top)


def _draw_runs(axes: "Axes", middles: npt.NDArray[np.float64], runs: npt.NDArray[np.float64]) -> None:
    """A thin line per run, the fainter the more there are."""
    alpha = float(np.clip(3.0 / len(runs), 0.2, 0.8))
    name = "each run" if len(runs) > 1 else "batches"
    for number, batches in enumerate(runs):
        axes.plot(
            middles, batches, ".-", color=GRAY, linewidth=0.8, markersize=4, markeredgewidth=0, alpha=alpha,
            zorder=1.8, clip_on=False, gid=f"run-{number}", label=None if number else name,
        )  # fmt: skip


def _shade_absence(axes: "Axes", edges: npt.NDArray[np.float64], absent: npt.NDArray[np.bool_], top: float) -> None:
    """Shade the batches without a target, and say so in the longest stretch of them."""
    changes = np.flatnonzero(np.diff(np.concatenate([[False], absent, [False]]).astype(int)))
    stretches = [(edges[begin], edges[end]) for begin, end in changes.reshape(-1, 2)]
    for left, right in stretches:
        axes.fill_between([left, right], 0.0, top, color="#f0f0f0", linewidth=0, zorder=2.2, gid="absence")
    if stretches:
        left, right = max(stretches, key=lambda stretch: float(stretch[1] - stretch[0]))
        upright = 90.0 if right - left < 0.25 * edges[-1] else 0.0
        axes.text(
            (left + right) / 2, top / 2, "no target present", rotation=upright, ha="center", va="center",
            fontsize=8, color=GRAY, zorder=2.3,
        )  # fmt: skip


def _label(axes: "Axes", record: Record) -> None:
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    axes.set_title("Time on target")
    axes.set_xlabel(f"time [steps of {record.facts.time_step:g} s]")
    axes.set_ylabel(label_of("time_on_target"))
    axes.xaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10], integer=True))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: count(round(value))))
    axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    axes.grid(axis="y")
