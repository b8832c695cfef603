"""Snapshot: the arena at one moment, seen from above."""

from typing import TYPE_CHECKING

from shoal.core.errors import RecordError
from shoal.drawing.arena_drawing import ArenaDrawing, Parts
from shoal.drawing.legend import draw_legend
from shoal.drawing.titles import entitle
from shoal.drawing.words import count, plural, time_text
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PLAIN = Parts()
POINTS = 72.0  # to the inch


def draw_snapshot(
    axes: "Axes",
    record: Record,
    run: int = 0,
    frame: int = -1,
    trail: int | None = None,
    parts: Parts = PLAIN,
    letter: str = "",
) -> None:
    """Draw buoys and targets of one frame; buoys that report a target have a dark rim, faster ones are bigger.

    Parameters
    ----------
    run : number of a run that kept a trajectory
    frame : index into its frames, from the end if negative
    trail : steps of the targets' trails (the buoys' are a third of it), 0 for none; as far as consecutive steps were
        kept. Default: what the fastest buoy needs for 8 arena units, each a twentieth of the longer side
    parts : what is drawn besides buoys and targets; trails by `trail`
    letter : of a panel, before the title

    Raises
    ------
    RecordError : no trajectory of this run, no such frame, or no links, a_R or sensor to show
    """
    frames = frames_of(record, run)
    last = _index(frames, frame)
    drawing = ArenaDrawing(axes, record, run, parts._replace(trails=trail != 0), trail)
    drawing.show(last)
    drawing.scale()
    height = draw_legend(axes, record, halos=parts.halos, sensors=parts.sensors)
    entitle(axes, letter + _moment(record, frames, run, last), pad=5.0 + POINTS * height)


def frames_of(record: Record, run: int) -> Trajectory:
    """The frames that a run kept.

    Raises
    ------
    RecordError : it kept none
    """
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


def _moment(record: Record, frames: Trajectory, run: int, last: int) -> str:
    step = int(frames.step[last])
    which = f"Run {run}, step" if len(record.tallies) > 1 else "Step"
    return f"{which} {count(step)} ({time_text(step * record.facts.time_step)}): {state_text(frames, last)}"


def state_text(frames: Trajectory, at: int) -> str:
    """What is present at a frame: 2 on target; or target absent; false alarms; how many of the buoys, if not all."""
    engaged, alarms = int(frames.engaged[at].sum()), int((frames.on_target[at] & ~frames.engaged[at]).sum())
    there, agents = int(frames.alive[at].sum()), frames.alive.shape[1]
    state = f"{engaged} on target" if frames.target_present[at].any() else "target absent"
    if alarms:
        state += f", {plural(alarms, 'false alarm')}"
    return state if there == agents else f"{state}, {there} of {agents} there"
