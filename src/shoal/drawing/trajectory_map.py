"""Trajectory map: the paths of buoys and targets over a stretch of steps, fading into the past."""

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from shoal.drawing.agents import AgentMarks
from shoal.drawing.arena import draw_arena, draw_scale_bar
from shoal.drawing.chart import draw_chart
from shoal.drawing.dots import MARKED, Dots
from shoal.drawing.legend import draw_map_legend
from shoal.drawing.snapshot import POINTS, frames_of
from shoal.drawing.stretch import stretch_of
from shoal.drawing.style import TARGET, fleet_line
from shoal.drawing.targets import TargetMarks
from shoal.drawing.titles import entitle
from shoal.drawing.trails import Points, agent_paths, target_points, unwrapped, widen
from shoal.drawing.words import count, time_text
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.scenario.schema import ARENA_UNITS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_SHADES = 8  # of a path, from its start to its end
_FAINTEST, _DARKEST = 0.18, 0.85  # opacity


def draw_trajectory_map(
    axes: "Axes",
    record: Record,
    run: int = 0,
    start: int | None = None,
    steps: int | None = None,
    every: int | None = None,
) -> None:
    """Draw the path of each buoy, in the color of its fleet, and of each target, from a ring to a mark.

    Of very many buoys there is only where they are at the end, as dots.

    Parameters
    ----------
    run : number of a run that kept a trajectory
    start, steps, every : which steps, see `stretch.stretch_of`; default: the last in which the fastest buoy can cross
        the arena once

    Raises
    ------
    RecordError : no trajectory of this run, or a frame that is needed was not kept
    """
    all_frames = frames_of(record, run)
    kept, facts = np.asarray(all_frames.step), record.facts
    if start is None and steps is None:
        steps = min(round(ARENA_UNITS * facts.unit / (max(facts.max_speeds) * facts.time_step)), int(kept[-1]) + 1)
    stretch = stretch_of(kept, start, steps, every)
    frames = _part(all_frames, stretch.frames)
    area, targets = record.scenario.area, record.scenario.targets
    side = max(area.width, area.height)
    draw_arena(axes, area)
    draw_chart(axes, record.scenario)
    dotted = facts.agents > MARKED
    paths = np.empty((0, 1, 2)) if dotted else agent_paths(frames, slice(None))  # (N, K, 2)
    begin = 0
    for fleet, number in enumerate(() if dotted else facts.counts):
        mine = paths[begin : begin + number]
        _draw_paths(axes, mine, fleet_line(fleet), 0.9, f"paths-{fleet}", 3)
        _draw_starts(axes, mine, fleet_line(fleet), 7.0, f"starts-{fleet}")
        begin += number
    if dotted:
        Dots(axes, record).show(frames, -1)
    for number, target in enumerate(targets):
        path = target_points(frames, slice(None), number)
        there = path[np.isfinite(path).all(axis=1)]
        if target.kind == "track" and there.size:
            widen(axes, there, target.radius)
        broken = unwrapped(path, side)
        _draw_paths(axes, broken[None], TARGET, 2.0, f"target-path-{number}", 2)
        _draw_starts(axes, path[None], TARGET, 26.0, f"target-start-{number}")
        TargetMarks(axes, record, number).show(frames, -1)
    AgentMarks(axes, record, reporting=dotted).show(frames, -1)
    draw_scale_bar(axes, area, paths.reshape(-1, 2))
    height = draw_map_legend(axes, record)
    entitle(axes, _words(record, frames, run), pad=5.0 + POINTS * height)


def _draw_paths(axes: "Axes", paths: Points, color: str, width: float, gid: str, zorder: float) -> None:
    """Paths (P, K, 2), in pieces that darken from start to end."""
    from matplotlib.collections import LineCollection
    from matplotlib.colors import to_rgb

    edges = np.unique(np.linspace(0, paths.shape[1] - 1, _SHADES + 1).round().astype(int))
    shades = np.linspace(_FAINTEST, _DARKEST, max(len(edges) - 1, 1))
    pieces, colors = [], []
    for begin, end, alpha in zip(edges[:-1], edges[1:], shades, strict=False):
        pieces += list(paths[:, begin : end + 1])
        colors += [(*to_rgb(color), alpha)] * len(paths)
    lines = LineCollection(pieces, colors=colors, linewidths=width, capstyle="butt", joinstyle="round", zorder=zorder)
    lines.set_gid(gid)
    axes.add_collection(lines, autolim=False)


def _draw_starts(axes: "Axes", paths: Points, color: str, size: float, gid: str) -> None:
    """A ring where each path begins: where it is first there."""
    there = np.isfinite(paths[..., 0])  # (P, K)
    known = there.any(axis=1)
    first = paths[known, there[known].argmax(axis=1)]
    axes.scatter(
        first[:, 0], first[:, 1], s=size, facecolors="white", edgecolors=color, linewidths=0.8, zorder=4, gid=gid
    )


def _part(frames: Trajectory, chosen: npt.NDArray[np.intp]) -> Trajectory:
    return Trajectory.from_arrays({name: np.asarray(values[chosen]) for name, values in frames.arrays().items()})


def _words(record: Record, frames: Trajectory, run: int) -> str:
    first, last = int(frames.step[0]), int(frames.step[-1])
    which = f"Run {run}, steps" if len(record.tallies) > 1 else "Steps"
    return f"{which} {count(first)} to {count(last)} ({time_text((last - first) * record.facts.time_step)})"
