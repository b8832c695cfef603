"""Targets as discs of their size; absent ones are not drawn."""

from typing import TYPE_CHECKING, Any

from shoal.drawing.style import TARGET
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class TargetMarks:
    """A disc of a target's size, its center marked in case that it is too small to see."""

    def __init__(self, axes: "Axes", record: Record, target: int) -> None:
        from matplotlib.patches import Circle

        self._target = target
        radius = record.scenario.targets[target].radius
        self._disc = Circle(
            (0, 0), radius, facecolor=TARGET, alpha=0.22, edgecolor="none", zorder=2.5, gid="target-disc"
        )
        self._rim = Circle((0, 0), radius, fill=False, edgecolor=TARGET, linewidth=1.2, zorder=2.6, gid="target-rim")
        (self._center,) = axes.plot([0], [0], "+", color=TARGET, markersize=6, markeredgewidth=1.3, zorder=2.7)
        axes.add_patch(self._disc)
        axes.add_patch(self._rim)
        self.artists: list[Any] = [self._disc, self._rim, self._center]

    def show(self, frames: Trajectory, at: int) -> None:
        """Move to a frame."""
        there = bool(frames.target_present[at, self._target])
        x, y = float(frames.target_x[at, self._target]), float(frames.target_y[at, self._target])
        for artist in self.artists:
            artist.set_visible(there)
        if there:
            self._disc.set_center((x, y))
            self._rim.set_center((x, y))
            self._center.set_data([x], [y])
