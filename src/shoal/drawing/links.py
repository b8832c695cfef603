"""Who hears whom: lines from each buoy to its k nearest others."""

import math
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from shoal.drawing.style import GRAY
from shoal.record.frames import degrees_of
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_BLOCK = 4_000_000  # distances held at once


class Links:
    """A line per pair of buoys of which at least one hears the other; where k adapts, as if it had not begun to."""

    def __init__(self, axes: "Axes", record: Record) -> None:
        from matplotlib.collections import LineCollection

        network = record.scenario["network"]
        self._degrees = degrees_of(record)
        self._reach = network["range"] or math.inf
        self._lines = LineCollection([], colors=GRAY, linewidths=0.6, zorder=1.5)
        self._lines.set_gid("links")
        axes.add_collection(self._lines, autolim=False)
        self.artists = [self._lines]

    def show(self, frames: Trajectory, at: int) -> None:
        """Move to a frame."""
        there = np.asarray(frames.alive[at])
        points = np.stack([frames.x[at], frames.y[at]], axis=-1)[there]
        pairs = nearest_pairs(points[:, 0], points[:, 1], self._degrees[there], self._reach)
        self._lines.set_segments(list(points[pairs]))
        self._lines.set_alpha(float(np.clip(60.0 / max(len(pairs), 1), 0.12, 0.6)))  # a mesh must not hide the swarm


def nearest_pairs(
    x: npt.NDArray[np.float64], y: npt.NDArray[np.float64], k: npt.ArrayLike, reach: float = math.inf
) -> npt.NDArray[np.int64]:
    """Pairs (P, 2), i < j, each once, where j is one of the k nearest of i or i of j, and within reach [m].

    Parameters
    ----------
    x, y : (N,) [m]
    k : of all, or of each (N,)
    """
    agents = x.size
    degrees = np.minimum(np.broadcast_to(k, agents), agents - 1)
    most = int(degrees.max(initial=0))
    if most < 1:
        return np.empty((0, 2), np.int64)
    block = max(1, _BLOCK // agents)
    hearing = []
    for begin in range(0, agents, block):
        mine = np.arange(begin, min(begin + block, agents))
        distance2 = (x[mine, None] - x) ** 2 + (y[mine, None] - y) ** 2
        distance2[np.arange(mine.size), mine] = np.inf
        nearest = np.argpartition(distance2, most - 1, axis=1)[:, :most]
        near2 = np.take_along_axis(distance2, nearest, axis=1)
        rank = near2.argsort(axis=1, kind="stable").argsort(axis=1)
        heard = (rank < degrees[mine, None]) & (near2 <= reach * reach)
        i, place = np.nonzero(heard)
        hearing.append(np.stack([mine[i], nearest[i, place]], axis=1))
    pairs: npt.NDArray[np.int64] = np.unique(np.sort(np.concatenate(hearing), axis=1), axis=0)
    return pairs
