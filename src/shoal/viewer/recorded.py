"""What a record keeps, as a scene and frames: its own numbers, and those of the engine's sums over single frames."""

from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.record.charted import describe_metric, in_order
from shoal.record.course import Course
from shoal.record.frames import Moment, engaged_by_frame, moment_of
from shoal.record.record import Record
from shoal.viewer.conditions import kept_comings_and_goings
from shoal.viewer.frame import FULL, RECENT, Gauges, pack
from shoal.viewer.geography import geography_of
from shoal.viewer.scene import scene_of

MOST_STEERED = 1000  # changes of a steered run that a page is told
_SHOWN = (  # besides those of installed packages
    "time_on_target", "xi", "engaged", "stationary", "response",
    "first_detection", "losses", "reacquisition", "coverage",
)  # fmt: skip


def recorded_scene(record: Record, run: int) -> dict[str, Any]:
    """The scene of a record, with its metrics, their intervals, and their course over the batches of one run."""
    shown = [name for name, each in record.metrics.items() if name in _SHOWN or each.package]
    estimates = {name: record.estimate(name) for name in shown}
    charted = [name for name in in_order(record.listed()) if not record.metrics[name].once]
    kept = record.trajectories[run]
    starts = np.concatenate([[0], np.cumsum(record.tallies[run].batch_steps)[:-1]])
    return {
        **scene_of(
            record.scenario,
            kept.memory,
            has_links=kept.links.shape[2] > 0,
            events=kept_comings_and_goings(kept.step, kept.alive),
            geography=geography_of(record.scenario),
        ),
        "metrics": [
            {
                **describe_metric(name),
                "mean": value.mean,
                "low": value.ci95[0] if value.ci95 else None,
                "high": value.ci95[1] if value.ci95 else None,
            }
            for name, value in estimates.items()
        ],
        "series": [{**describe_metric(name), "mean": record.estimate(name).mean} for name in charted],
        "history": {
            "step": [int(step) for step in starts],
            "values": {name: record.of_batches(name, run).tolist() for name in charted},
        },
        "steered": [{"step": step, "words": words} for step, words in record.steered[:MOST_STEERED]],
    }


def recorded_frames(record: Record, run: int, chosen: npt.NDArray[np.int64]) -> list[bytes]:
    """The bytes of some of the frames that a record keeps of a run, given their indices."""
    kept, course = record.trajectories[run], Course(record, run)
    engaged = engaged_by_frame(kept)

    def packed(at: int) -> bytes:
        gauges = _gauges(course, moment_of(kept, at, record.facts), int(kept.step[at]), float(engaged[at]))
        return pack(kept, at, run=0, epoch=0, gauges=gauges, lean=record.facts.agents > FULL)

    return [packed(at) for at in chosen.tolist()]


def _gauges(course: Course, moment: Moment, step: int, engaged: float) -> Gauges:
    return Gauges(
        time_on_target=course.time_on_target(0, step),
        recent=course.time_on_target(max(0, step - RECENT), step),
        xi=course.xi(step),
        xi_now=moment.xi,
        engaged=engaged,
        phi=moment.phi.sum(axis=0),
    )
