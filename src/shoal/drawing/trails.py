"""Where things were: short trails behind targets and buoys, and the whole path of a recorded target."""

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from shoal.drawing.style import INK, TARGET, fleet_line
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Points = npt.NDArray[np.float64]


class TargetTrail:
    """Where a target was up to `steps` ago, fading into the past; broken where it was absent.

    Frames up to `stride` steps apart are joined.
    """

    def __init__(self, axes: "Axes", record: Record, target: int, steps: int, stride: int = 1) -> None:
        from matplotlib.collections import LineCollection

        self._target, self._steps, self._stride = target, steps, stride
        self._side = max(record.scenario.area.width, record.scenario.area.height)
        self._lines = LineCollection([], linewidths=1.6, capstyle="butt", zorder=2)
        self._lines.set_gid("target-trail")
        axes.add_collection(self._lines, autolim=False)
        self.artists = [self._lines]

    def show(self, frames: Trajectory, at: int) -> None:
        """Move to a frame."""
        from matplotlib.colors import to_rgb

        window = consecutive(frames.step, at, self._steps, self._stride)
        points = unwrapped(target_points(frames, window, self._target), self._side)
        segments = np.stack([points[:-1], points[1:]], axis=1)  # (K - 1, 2, 2)
        there = np.isfinite(segments).all(axis=(1, 2))
        age = np.linspace(0.08, 0.9, len(segments))
        self._lines.set_segments(list(segments[there]))
        self._lines.set_color([(*to_rgb(TARGET), alpha) for alpha in age[there]])


class AgentTrails:
    """Where each buoy was up to `steps` ago, in the color of its fleet; of those present."""

    def __init__(self, axes: "Axes", record: Record, steps: int, stride: int = 1) -> None:
        from matplotlib.collections import LineCollection

        self._ends = np.cumsum(record.facts.counts)
        self._steps, self._stride = steps, stride
        self.artists = [
            LineCollection([], colors=fleet_line(fleet), linewidths=0.8, alpha=0.5, zorder=3)
            for fleet in range(len(self._ends))
        ]
        for lines in self.artists:
            lines.set_gid("agent-trails")
            axes.add_collection(lines, autolim=False)

    def show(self, frames: Trajectory, at: int) -> None:
        """Move to a frame."""
        paths = agent_paths(frames, consecutive(frames.step, at, self._steps, self._stride))
        there = np.asarray(frames.alive[at])
        begin = 0
        for lines, end in zip(self.artists, self._ends, strict=True):
            lines.set_segments([paths[i] for i in range(begin, end) if there[i]])
            begin = end


def draw_whole_path(axes: "Axes", frames: Trajectory, target: int, radius: float) -> None:
    """Draw the path of a target of a radius [m] over all frames, the first and the last point of it marked."""
    points = target_points(frames, slice(None), target)
    there = np.flatnonzero(np.isfinite(points).all(axis=1))
    if not there.size:
        return
    widen(axes, points[there], radius)
    axes.plot(points[:, 0], points[:, 1], color=TARGET, linewidth=1.1, alpha=0.75, zorder=1.8, gid="target-path")
    for name, index, marker in (("start", there[0], "o"), ("end", there[-1], "s")):
        x, y = points[index]
        axes.plot(
            [x], [y], marker, markersize=6, markerfacecolor="white", markeredgecolor=TARGET, markeredgewidth=1.3,
            zorder=6, gid=f"path-{name}",
        )  # fmt: skip
        _name_point(axes, name, x, y)


def target_points(frames: Trajectory, window: slice, target: int) -> Points:
    """Positions of a target (K, 2) [m]; NaN where it is absent."""
    points = np.stack([frames.target_x[window, target], frames.target_y[window, target]], axis=-1)
    return np.where(np.asarray(frames.target_present[window, target])[:, None], points, np.nan)


def agent_paths(frames: Trajectory, window: slice) -> Points:
    """Positions of the agents (N, K, 2) [m]; NaN where they are absent."""
    points = np.stack([frames.x[window], frames.y[window]], axis=-1)
    return np.where(np.asarray(frames.alive[window])[..., None], points, np.nan).transpose(1, 0, 2)


def unwrapped(points: Points, side: float) -> Points:
    """A path (K, 2) without the points before which it jumps by half the arena's side [m]: it re-enters there."""
    jumps = np.abs(np.diff(points, axis=0)).max(axis=1, initial=0.0) > side / 2
    broken = points.copy()
    broken[1:][jumps] = np.nan
    return broken


def consecutive(step: npt.NDArray[np.int64], last: int, most: int, stride: int = 1) -> slice:
    """The frames of up to `most` steps that lead, at most `stride` apart, to frame number `last`; itself included."""
    first = int(np.searchsorted(step[: last + 1], step[last] - most))
    jumps = np.flatnonzero(np.diff(step[first : last + 1]) > stride)
    return slice(first + int(jumps[-1]) + 1 if jumps.size else first, last + 1)


def widen(axes: "Axes", points: Points, radius: float) -> None:
    """Show points beyond the arena too, up to twice its size: a track may leave it."""
    axes.set_anchor("NW")
    for limits, set_limits, values in (
        (axes.get_xlim(), axes.set_xlim, points[:, 0]),
        (axes.get_ylim(), axes.set_ylim, points[:, 1]),
    ):
        pad = radius + 0.02 * (limits[1] - limits[0])
        low, high = float(values.min()) - pad, float(values.max()) + pad
        set_limits(max(min(limits[0], low), 2 * limits[0]), min(max(limits[1], high), 2 * limits[1]))


def _name_point(axes: "Axes", name: str, x: float, y: float) -> None:
    """Write a name beside a point, on the side with more room."""
    from matplotlib.patheffects import withStroke

    side = -1 if x > sum(axes.get_xlim()) / 2 else 1
    axes.annotate(
        name, (x, y), (7 * side, 0), textcoords="offset points", ha="left" if side > 0 else "right", va="center",
        fontsize=8, color=INK, path_effects=[withStroke(linewidth=2.5, foreground="white")], zorder=9,
    )  # fmt: skip
