"""Curves: a mean with its band, and time on target over the course of a run."""

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from shoal.metrics.summary import evaluate
from shoal.record.record import Record
from shoal.viz.style import GRAY, TARGET
from shoal.viz.words import estimate_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_BAND = 0.18  # opacity


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
    axes.fill_between(np.asarray(x, float), np.asarray(low, float), np.asarray(high, float),
                      color=color, alpha=_BAND, linewidth=0)  # fmt: skip
    axes.plot(np.asarray(x, float), np.asarray(mean, float), color=color, label=label)


def draw_batches(axes: "Axes", record: Record) -> None:
    """Draw time on target in consecutive batches of each run, the mean over all steps and its 95 % interval."""
    ends = np.cumsum(record.tallies[0].steps)
    middles = ends - record.tallies[0].steps / 2
    runs = [evaluate("time_on_target", tally, record.facts)[1] for tally in record.tallies]
    _label(axes, record)
    axes.set_xlim(0.0, float(ends[-1]))
    if not np.isfinite(runs).any():
        axes.set_yticks([])
        axes.text(0.5, 0.5, "no target was ever there", transform=axes.transAxes, ha="center", color=GRAY)
        return
    alpha = float(np.clip(3.0 / len(runs), 0.25, 0.8))
    for number, batches in enumerate(runs):
        axes.plot(
            middles, batches, ".-", color=GRAY, linewidth=0.8, markersize=3, alpha=alpha, zorder=1.8,
            label=("each run" if len(runs) > 1 else "batches of the run") if number == 0 else None,
        )  # fmt: skip
    total = record.estimate("time_on_target")
    low, high = total.ci95 or (np.nan, np.nan)
    ones = np.ones(2)
    draw_band(axes, [0.0, ends[-1]], total.mean * ones, low * ones, high * ones, f"mean {estimate_text(total)}", TARGET)
    top = 1.12 * max(float(np.nanmax(runs)), high if np.isfinite(high) else 0.0, 0.05)
    axes.set_ylim(0.0, min(top, 1.03))
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, borderaxespad=0.1, borderpad=0.2)


def _label(axes: "Axes", record: Record) -> None:
    axes.set_title("Time on target")
    axes.set_xlabel(f"step ({record.facts.time_step:g} s each)")
    axes.set_ylabel("share of steps")
    axes.grid(axis="y")
