"""Two charts beside a film's arena: current headings, and how many are on target over time."""

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from shoal.drawing.histogram import DENSITY, WIDTHS, label_phi
from shoal.drawing.stretch import Stretch
from shoal.drawing.style import GRAY, TARGET, fleet_color, fleet_line
from shoal.drawing.words import count
from shoal.record.frames import PHI_EDGES, moment_of
from shoal.record.record import Record

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_LEFT, _RIGHT = 0.72, 0.3  # [inch] room for a y label, page margin
_TOP, _BOTTOM, _BETWEEN = 0.88, 0.82, 1.02


class Charts:
    """The charts of a stretch, right of `left` [inch] on a figure.

    engaged : (K,) how many are on target, NaN where no target is
    """

    def __init__(
        self, figure: "Figure", record: Record, run: int, stretch: Stretch,
        engaged: npt.NDArray[np.float64], left: float,
    ) -> None:  # fmt: skip
        page_width, page_height = figure.get_size_inches()
        several = stretch.frames.size > 1  # a still has no course
        tall = page_height - _TOP - _BOTTOM - (_BETWEEN if several else 0.12)
        tall = tall / 2 if several else min(tall, 2.6)
        left += _LEFT
        wide = page_width - left - _RIGHT

        def axes(bottom: float) -> Any:
            return figure.add_axes((left / page_width, bottom / page_height, wide / page_width, tall / page_height))

        self._step = np.asarray(record.trajectories[run].step)[stretch.frames]
        self._engaged = engaged
        self._histograms = _phi_of_frames(record, run, stretch.frames) / WIDTHS  # (K, F, 11)
        self._bars = self._draw_phi(axes(page_height - _TOP - tall))
        self._course = self._draw_engaged(axes(_BOTTOM)) if several else ()
        self.artists = [*(bar for bars in self._bars for bar in bars), *self._course]

    def show(self, number: int) -> None:
        """Move to a frame of the stretch."""
        base = np.zeros(PHI_EDGES.size - 1)
        for bars, heights in zip(self._bars, self._histograms[number], strict=True):
            for bar, bottom, height in zip(bars, base, heights, strict=True):
                bar.set_y(bottom)
                bar.set_height(height)
            base = base + heights
        if self._course:
            line, dot = self._course
            line.set_data(self._step[: number + 1], self._engaged[: number + 1])
            dot.set_data([self._step[number]], [self._engaged[number]])

    def _draw_phi(self, axes: Any) -> list[Any]:
        label_phi(axes)
        axes.set_title("Heading relative to target")
        axes.set_ylabel(DENSITY)
        axes.set_ylim(0.0, max(1.0, 1.05 * float(self._histograms.sum(axis=1).max(initial=0.0))))
        return [
            axes.bar(
                PHI_EDGES[:-1], 0.0 * WIDTHS, WIDTHS, align="edge", color=fleet_color(fleet),
                edgecolor=fleet_line(fleet), linewidth=0.5,
            )
            for fleet in range(self._histograms.shape[1])
        ]  # fmt: skip

    def _draw_engaged(self, axes: Any) -> tuple[Any, Any]:
        from matplotlib.ticker import FuncFormatter, MaxNLocator

        axes.set_title("Buoys on target")
        axes.set_ylabel("agents")
        axes.set_xlabel("step")
        axes.set_xlim(self._step[0], max(self._step[-1], self._step[0] + 1))
        axes.set_ylim(0.0, max(1.0, float(np.nanmax(np.append(self._engaged, 0.0)))) * 1.08)
        axes.xaxis.set_major_locator(MaxNLocator(3, integer=True))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: count(round(value))))
        axes.yaxis.set_major_locator(MaxNLocator(4, integer=True))
        axes.grid(axis="y")
        (line,) = axes.plot([], [], color=TARGET, linewidth=1.3, drawstyle="steps-post")
        (dot,) = axes.plot([], [], "o", color=TARGET, markeredgecolor=GRAY, markersize=4.5, clip_on=False)
        return line, dot


def _phi_of_frames(record: Record, run: int, chosen: npt.NDArray[np.intp]) -> npt.NDArray[np.float64]:
    """Agents of each fleet in each bin of phi at some frames, (K, F, 11); none where no target is present."""
    frames = record.trajectories[run]
    return np.nan_to_num([moment_of(frames, at, record.facts).phi for at in chosen.tolist()])
