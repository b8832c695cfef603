"""Who hears whom: lines from each buoy to its k nearest others."""

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from shoal.viz.style import GRAY

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_BLOCK = 4_000_000  # distances held at once


def draw_links(axes: "Axes", x: npt.NDArray[np.float64], y: npt.NDArray[np.float64], k: int) -> None:
    """Draw a line per pair of buoys (N,) [m] of which at least one hears the other."""
    from matplotlib.collections import LineCollection

    pairs = nearest_pairs(x, y, k)
    points = np.stack([x, y], axis=-1)
    alpha = float(np.clip(60.0 / len(pairs), 0.12, 0.6))  # a mesh must not hide the swarm
    lines = LineCollection(list(points[pairs]), colors=GRAY, linewidths=0.6, alpha=alpha, zorder=1.5)
    lines.set_gid("links")
    axes.add_collection(lines, autolim=False)


def nearest_pairs(x: npt.NDArray[np.float64], y: npt.NDArray[np.float64], k: int) -> npt.NDArray[np.int64]:
    """Pairs (P, 2), i < j, each once, where j is one of the k nearest of i or i of j."""
    agents = x.size
    block = max(1, _BLOCK // agents)
    hearing = []
    for begin in range(0, agents, block):
        mine = np.arange(begin, min(begin + block, agents))
        distance2 = (x[mine, None] - x) ** 2 + (y[mine, None] - y) ** 2
        distance2[np.arange(mine.size), mine] = np.inf
        nearest = np.argpartition(distance2, k - 1, axis=1)[:, :k]
        hearing.append(np.stack([np.repeat(mine, k), nearest.ravel()], axis=1))
    pairs: npt.NDArray[np.int64] = np.unique(np.sort(np.concatenate(hearing), axis=1), axis=0)
    return pairs
