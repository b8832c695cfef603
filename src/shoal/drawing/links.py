"""Who heard whom: a line between each pair of buoys of which one really heard the other."""

from typing import TYPE_CHECKING

import numpy as np

from shoal.drawing.style import GRAY
from shoal.record.frames import linked_pairs, who_hears_whom
from shoal.record.trajectory import Trajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Links:
    """A line per pair of buoys of which at least one heard the other in the step that a frame begins.

    Raises
    ------
    RecordError : links were not kept
    """

    def __init__(self, axes: "Axes", frames: Trajectory) -> None:
        from matplotlib.collections import LineCollection

        who_hears_whom(frames, 0)  # or there are none to draw
        self._lines = LineCollection([], colors=GRAY, linewidths=0.6, zorder=1.5)
        self._lines.set_gid("links")
        axes.add_collection(self._lines, autolim=False)
        self.artists = [self._lines]

    def show(self, frames: Trajectory, at: int) -> None:
        """Move to a frame."""
        pairs = linked_pairs(frames, at)
        points = np.stack([frames.x[at], frames.y[at]], axis=-1)
        self._lines.set_segments(list(points[pairs]))
        self._lines.set_alpha(float(np.clip(60.0 / max(len(pairs), 1), 0.12, 0.6)))  # a mesh must not hide the swarm
