"""Snapshot: the arena at one moment, seen from above."""

from typing import TYPE_CHECKING

import numpy as np

from shoal.core.errors import RecordError
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.viz.arena import draw_arena, draw_scale_bar, in_kilometers
from shoal.viz.legend import draw_legend, marker_area
from shoal.viz.links import draw_links
from shoal.viz.style import INK, TARGET, fleet_color, fleet_marker
from shoal.viz.trails import consecutive, draw_agent_trails, draw_target_trail, draw_whole_path, target_points
from shoal.viz.words import count, time_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

REACH = 8.0  # arena units that the fastest buoy covers in the default trail
POINTS = 72.0  # to the inch
_TRAILED = 1000  # more buoys than this draw no trails


def draw_snapshot(
    axes: "Axes", record: Record, run: int = 0, frame: int = -1, links: bool = False, trail: int | None = None
) -> None:
    """Draw buoys and targets of one frame; buoys on target have a dark rim, faster ones are bigger.

    Parameters
    ----------
    run : number of a run that kept a trajectory
    frame : index into its frames, from the end if negative
    links : draw a line to the k nearest others of each buoy
    trail : steps of the targets' trails (the buoys' are a third of it), 0 for none; as far as consecutive steps were
        kept. Default: what the fastest buoy needs for 8 arena units, each a twentieth of the longer side

    Raises
    ------
    RecordError : no trajectory of this run, or no such frame
    """
    frames = _frames(record, run)
    last = _index(frames, frame)
    scenario, facts = record.scenario, record.facts
    steps = trail if trail is not None else round(REACH * facts.unit / (max(facts.max_speeds) * facts.time_step))
    draw_arena(axes, scenario["area"])
    for number, target in enumerate(scenario["targets"]):
        if target["kind"] == "track":
            draw_whole_path(axes, frames, number, target["radius"])
        else:
            draw_target_trail(axes, frames, consecutive(frames.step, last, steps), number)
        _draw_target(axes, frames, last, number, target["radius"])
    if steps >= 3 and facts.agents <= _TRAILED:
        draw_agent_trails(axes, frames, consecutive(frames.step, last, steps // 3), facts.counts)
    if links:
        draw_links(axes, np.asarray(frames.x[last]), np.asarray(frames.y[last]), scenario["network"]["neighbors"])
    _draw_agents(axes, record, frames, last)
    tracks = [number for number, target in enumerate(scenario["targets"]) if target["kind"] == "track"]
    if in_kilometers(scenario["area"]) or tracks:
        paths = [target_points(frames, slice(None), number) for number in tracks]
        draw_scale_bar(axes, np.concatenate([np.empty((0, 2)), *paths]))
    height = draw_legend(axes, record)
    axes.set_title(_moment(record, frames, run, last), pad=7.0 + POINTS * height)


def _frames(record: Record, run: int) -> Trajectory:
    if run not in record.trajectories:
        kept = ", ".join(str(each) for each in sorted(record.trajectories)) or "none"
        raise RecordError(
            f"run {run}", f"kept no trajectory; runs that did: {kept}", "simulate with `every`, or draw another run"
        )
    return record.trajectories[run]


def _index(frames: Trajectory, frame: int) -> int:
    size = frames.step.size
    if not -size <= frame < size:
        raise RecordError(f"frame {frame}", f"is not one of the {size} frames kept", f"choose 0 to {size - 1}, or -1")
    return frame % size


def _draw_target(axes: "Axes", frames: Trajectory, last: int, target: int, radius: float) -> None:
    """A disc of the target's size, its center marked in case that it is too small to see."""
    from matplotlib.patches import Circle

    if not frames.target_present[last, target]:
        return
    center = float(frames.target_x[last, target]), float(frames.target_y[last, target])
    axes.add_patch(
        Circle(center, radius, facecolor=TARGET, alpha=0.22, edgecolor="none", zorder=2.5, gid="target-disc")
    )
    axes.add_patch(Circle(center, radius, fill=False, edgecolor=TARGET, linewidth=1.2, zorder=2.6, gid="target-rim"))
    axes.plot(*center, "+", color=TARGET, markersize=6, markeredgewidth=1.3, zorder=2.7)


def _draw_agents(axes: "Axes", record: Record, frames: Trajectory, last: int) -> None:
    facts = record.facts
    begin = 0
    for fleet, number in enumerate(facts.counts):
        mine = slice(begin, begin + number)
        on_target = np.asarray(frames.on_target[last, mine])
        area = marker_area(record, fleet)
        axes.scatter(
            frames.x[last, mine], frames.y[last, mine], marker=fleet_marker(fleet), color=fleet_color(fleet),
            s=area * np.where(on_target, 1.35, 1.0), linewidths=area**0.5 * np.where(on_target, 0.2, 0.08),
            edgecolors=[INK if on else "white" for on in on_target], zorder=5, gid=f"fleet-{fleet}",
        )  # fmt: skip
        begin += number


def _moment(record: Record, frames: Trajectory, run: int, last: int) -> str:
    step = int(frames.step[last])
    which = f"Run {run}, step" if len(record.tallies) > 1 else "Step"
    there = frames.target_present[last].any()
    state = f"{int(frames.on_target[last].sum())} on target" if there else "target absent"
    return f"{which} {count(step)} ({time_text(step * record.facts.time_step)}): {state}"
