"""The paper's two pictures of the swarm: agents locked in place, and fast buoys together and apart again."""

from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.drawing.snapshot import draw_snapshot
from shoal.drawing.style import FLEET_COLORS, GRAY, INK, lettered, new_figure, style
from shoal.drawing.words import count
from shoal.experiments.rows import Row
from shoal.paper.figures_series import DOUBLE, SINGLE
from shoal.paper.results import Figure
from shoal.paper.snapshots import Clustering, Locked, find_clustering, find_locked
from shoal.record.record import Record
from shoal.scenario.choices import speed_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as MplFigure

_RUN = 0
_OURS = (
    "Signs are those of all our figures: circles are fast buoys, triangles slow ones; the paper has crosses for both."
)
_TRAIL = 30  # steps of the target's trail, a third of it for the buoys'
_AROUND = 300  # steps of the distance shown before and after the two moments


def locked_figure(record: Record) -> Figure:
    """Draw the frame with the most agents locked inside the area, each in a square."""
    found = find_locked(record, _RUN)
    frames = record.trajectories[_RUN]
    x, y = frames.x[found.frame], frames.y[found.frame]
    with style():
        width, height = SINGLE, 4.55
        figure = new_figure(width, height)
        axes = figure.add_axes((0.57 / width, 0.9 / height, 2.8 / width, 2.8 / height))
        draw_snapshot(axes, record, _RUN, found.frame, trail=_TRAIL)
        looks = (
            (found.locked, INK, 1.2, "strongest repulsion, locked"),
            (found.pushing & ~found.locked, GRAY, 0.6, "the same, moving"),
        )
        for who, color, line, label in looks:
            axes.scatter(
                x[who], y[who], s=115, marker="s", facecolors="none", edgecolors=color, linewidths=line, label=label,
                zorder=6, clip_on=False,
            )  # fmt: skip
        handles, labels = axes.get_legend_handles_labels()
        figure.legend(handles, labels, loc="lower left", bbox_to_anchor=(0.57 / width, 0.0), ncols=1, borderaxespad=0.3)
    data = _frame_rows(record, found.frame, {}, locked=found.locked, pushing=found.pushing)
    return Figure("locked", "Agents locked in place", _locked_caption(record, found), figure, data)


def clustering_figure(record: Record) -> Figure:
    """Draw the fast buoys at their closest and apart again, and their mean distance around these moments."""
    found = find_clustering(record, _RUN)
    apart = found.apart if found.apart is not None else len(found.distance) - 1
    data: list[Row] = []
    with style():
        height = 5.3
        figure = new_figure(DOUBLE, height)
        for number, (frame, name) in enumerate(((found.together, "together"), (apart, "apart again"))):
            box = (0.55 + 3.55 * number, 1.75, 3.0, 3.0)
            axes = figure.add_axes((box[0] / DOUBLE, box[1] / height, box[2] / DOUBLE, box[3] / height))
            draw_snapshot(axes, record, _RUN, frame, trail=_TRAIL)
            _share_legend(axes, figure)
            step = int(record.trajectories[_RUN].step[frame])
            axes.set_title(lettered(number, f"Fast buoys {name}, step {count(step)}"), pad=7)
            data += _frame_rows(record, frame, {"panel": name})
        strip = figure.add_axes((0.55 / DOUBLE, 0.42 / height, (DOUBLE - 0.65) / DOUBLE, 0.68 / height))
        data += _draw_distance(strip, record, found, apart)
    return Figure(
        "clustering", "Fast buoys cluster and disperse", _clustering_caption(record, found, apart), figure, data
    )


def _share_legend(axes: "Axes", figure: "MplFigure") -> None:
    """Move the legend of a snapshot to the top of the page, where one serves all."""
    legend = axes.get_legend()
    if legend is None:
        return
    if not figure.legends:
        signs = [handle for handle in legend.legend_handles if handle is not None]
        names = [text.get_text() for text in legend.get_texts()]
        figure.legend(signs, names, loc="upper left", bbox_to_anchor=(0.07, 1.0), ncols=len(names))
    legend.remove()


def _draw_distance(axes: "Axes", record: Record, found: Clustering, apart: int) -> list[Row]:
    """Mean distance among the fast buoys over time, the two moments marked, and its median over the run."""
    step = np.asarray(record.trajectories[_RUN].step)
    window = slice(max(0, found.together - _AROUND), min(len(step), apart + _AROUND))
    axes.plot(step[window], found.distance[window], color=FLEET_COLORS[0], linewidth=1.2)
    axes.axhline(found.median, color=GRAY, linewidth=0.8, linestyle=(0, (4, 3)))
    for frame, name in ((found.together, "a"), (apart, "b")):
        axes.plot([step[frame]], [found.distance[frame]], "o", color=INK, markersize=4.5)
        axes.annotate(name, (step[frame], found.distance[frame]), (5, -3), textcoords="offset points",
                      fontweight="bold", va="top")  # fmt: skip
    axes.set_xlim(step[window][0], step[window][-1])
    axes.set_ylim(0.0, 1.15 * float(found.distance[window].max()))
    axes.set_title(lettered(2, "Mean distance between two fast buoys (dashed: its median over the run)"), pad=4)
    axes.set_xlabel("step", labelpad=1)
    axes.set_ylabel("distance [m]")
    axes.grid(visible=True)
    rows = zip(step[window].tolist(), found.distance[window].tolist(), strict=True)
    return [
        *({"panel": "distance", "step": at, "mean_distance_fast [m]": value} for at, value in rows),
        {"panel": "distance", "what": "median of the run", "mean_distance_fast [m]": found.median},
    ]


def _frame_rows(record: Record, frame: int, labels: dict[str, Any], **flags: Any) -> list[Row]:
    """What a snapshot shows, one row per agent, target and point of a trail."""
    frames, facts = record.trajectories[_RUN], record.facts
    fleets = np.repeat(facts.fleets, facts.counts)
    rows: list[Row] = []
    for at in range(max(0, frame - _TRAIL), frame + 1):
        time = {**labels, "step": int(frames.step[at]), "what": "trail" if at < frame else "moment"}
        x, y = float(frames.target_x[at, 0]), float(frames.target_y[at, 0])
        rows.append({**time, "who": "target", "x [m]": x, "y [m]": y})
        for i, fleet in enumerate(fleets.tolist()) if at >= frame - _TRAIL // 3 else ():
            row = {**time, "who": f"agent {i}", "fleet": fleet,
                   "x [m]": float(frames.x[at, i]), "y [m]": float(frames.y[at, i])}  # fmt: skip
            if at == frame:
                speed = float(np.hypot(frames.vx[at, i], frames.vy[at, i]))
                row |= {"speed [m/s]": speed, "on_target": bool(frames.on_target[at, i])}
                row |= {"a_R [m]": float(frames.memory["repulsion"][at, i])}
                row |= {name: bool(values[i]) for name, values in flags.items()}
            rows.append(row)
    return rows


def _locked_caption(record: Record, found: Locked) -> str:
    frames = record.trajectories[_RUN]
    locked, on_target = int(found.locked.sum()), int(frames.on_target[found.frame].sum())
    there = int((found.locked & ~found.inside).sum())
    edge_text = f"{'all' if there == locked else there or 'none'} of them at the line that no buoy crosses"
    return (
        f"{_swarm(record)}. Squares: buoys that have heard of no target for so long that their repulsion a_R is at its "
        f"maximum; {locked} of these {int(found.pushing.sum())} are locked (dark squares: slower than a tenth of their "
        f"top speed), {edge_text}, while "
        f"{on_target} {'is' if on_target == 1 else 'are'} on target. Of {count(frames.step.size)} steps this is the "
        "first with the most buoys locked inside the area while others are on target. "
        f"Lines: the last {_TRAIL} steps of the target, {_TRAIL // 3} of the buoys. {_OURS}"
    )


def _clustering_caption(record: Record, found: Clustering, apart: int) -> str:
    seconds = (apart - found.together) * record.facts.time_step
    later = (
        f"(b) The first later step with that distance above its median over the run, {found.median:.1f} m; this takes "
        f"{seconds:.1f} s."
        if found.apart is not None
        else f"(b) The last step; the distance is not back above its median over the run, {found.median:.1f} m."
    )
    return (
        f"{_swarm(record)}. (a) Of {count(found.distance.size)} steps, the one with the smallest mean distance between "
        f"two fast buoys while somebody is on target, {found.distance[found.together]:.1f} m. {later} (c) That "
        f"distance over time. {_OURS}"
    )


def _swarm(record: Record) -> str:
    facts, scenario = record.facts, record.scenario
    fleets = " and ".join(f"{n} {name}" for n, name in zip(facts.counts, facts.fleets, strict=True))
    return (
        f"A swarm of {fleets} tracks a target of {speed_of(scenario.targets[0]):g} m/s at "
        f"k = {scenario.network.neighbors} (seed {scenario.seed})"
    )
