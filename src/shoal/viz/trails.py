"""Where things were: short trails behind targets and buoys, and the whole path of a recorded target."""

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from shoal.record.trajectory import Trajectory
from shoal.viz.style import INK, TARGET, fleet_color

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Points = npt.NDArray[np.float64]


def draw_target_trail(axes: "Axes", frames: Trajectory, window: slice, target: int) -> None:
    """Draw where a target was in a window of consecutive frames, fading into the past; broken where it was absent."""
    from matplotlib.collections import LineCollection
    from matplotlib.colors import to_rgb

    points = target_points(frames, window, target)
    segments = np.stack([points[:-1], points[1:]], axis=1)  # (K - 1, 2, 2)
    there = np.isfinite(segments).all(axis=(1, 2))
    age = np.linspace(0.08, 0.9, len(segments))
    colors = [(*to_rgb(TARGET), alpha) for alpha in age[there]]
    lines = LineCollection(list(segments[there]), colors=colors, linewidths=1.6, capstyle="butt", zorder=2)
    lines.set_gid("target-trail")
    axes.add_collection(lines, autolim=False)


def draw_agent_trails(axes: "Axes", frames: Trajectory, window: slice, counts: tuple[int, ...]) -> None:
    """Draw where each buoy was in a window of consecutive frames, in the color of its fleet."""
    from matplotlib.collections import LineCollection

    paths = np.stack([frames.x[window], frames.y[window]], axis=-1).transpose(1, 0, 2)  # (N, K, 2)
    begin = 0
    for fleet, number in enumerate(counts):
        fleet_paths = paths[begin : begin + number]
        lines = LineCollection(list(fleet_paths), colors=fleet_color(fleet), linewidths=0.8, alpha=0.4, zorder=3)
        lines.set_gid("agent-trails")
        axes.add_collection(lines, autolim=False)
        begin += number


def draw_whole_path(axes: "Axes", frames: Trajectory, target: int, radius: float) -> None:
    """Draw the path of a target of a radius [m] over all frames, the first and the last point of it marked."""
    points = target_points(frames, slice(None), target)
    there = np.flatnonzero(np.isfinite(points).all(axis=1))
    if not there.size:
        return
    _widen(axes, points[there], radius)
    axes.plot(points[:, 0], points[:, 1], color=TARGET, linewidth=1.1, alpha=0.75, zorder=1.8, gid="target-path")
    for name, index, marker in (("start", there[0], "o"), ("end", there[-1], "s")):
        x, y = points[index]
        axes.plot(
            [x], [y], marker, markersize=6, markerfacecolor="white", markeredgecolor=TARGET, markeredgewidth=1.3,
            zorder=6, gid=f"path-{name}",
        )  # fmt: skip
        _name_point(axes, name, x, y)


def target_points(frames: Trajectory, window: slice, target: int) -> Points:
    """Positions of a target (K, 2) [m]; NaN where it is not there."""
    points = np.stack([frames.target_x[window, target], frames.target_y[window, target]], axis=-1)
    return np.where(np.asarray(frames.target_present[window, target])[:, None], points, np.nan)


def consecutive(step: npt.NDArray[np.int64], last: int, most: int) -> slice:
    """The frames of up to `most` steps that lead, one step each, to frame number `last`; that frame itself included."""
    first = max(0, last - most)
    jumps = np.flatnonzero(np.diff(step[first : last + 1]) != 1)
    return slice(first + int(jumps[-1]) + 1 if jumps.size else first, last + 1)


def _widen(axes: "Axes", points: Points, radius: float) -> None:
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
