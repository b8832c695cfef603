"""What a record keeps, as a scene and frames: its own numbers, and those of the engine's sums over single frames."""

from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.core.agents import Floats
from shoal.metrics.summary import INSTALLED, METRICS, evaluate
from shoal.metrics.tally import new_tally
from shoal.record.frames import degrees_of, watching
from shoal.record.record import Record
from shoal.viewer.frame import RECENT, Gauges, pack
from shoal.viewer.meter import Meter
from shoal.viewer.scene import REPULSION, scene_of

_SHOWN = (  # besides those of installed packages
    "time_on_target", "xi", "engaged", "stationary", "response",
    "first_detection", "losses", "reacquisition", "coverage",
)  # fmt: skip


def recorded_scene(record: Record, run: int) -> dict[str, Any]:
    """The scene of a record, with its metrics, their intervals, and their course over the batches of one run."""
    estimates = {name: record.estimate(name) for name in (*_SHOWN, *INSTALLED)}
    tally, facts = record.tallies[run], record.facts
    starts = np.concatenate([[0], np.cumsum(tally.batch_steps)[:-1]])
    return {
        **scene_of(record.scenario, facts, record.trajectories[run].memory),
        "metrics": [
            {
                "name": name,
                "label": METRICS[name].words,
                "unit": METRICS[name].unit,
                "mean": value.mean,
                "low": value.ci95[0] if value.ci95 else None,
                "high": value.ci95[1] if value.ci95 else None,
            }
            for name, value in estimates.items()
        ],
        "history": {
            "step": [int(step) for step in starts],
            **{name: [float(each) for each in evaluate(name, tally, facts)[1]] for name in ("time_on_target", "xi")},
        },
    }


def recorded_frames(record: Record, run: int, chosen: npt.NDArray[np.int64]) -> list[bytes]:
    """The bytes of some of the frames that a record keeps of a run, given their indices."""
    size, kept = record.facts.agents, record.trajectories[run]
    course = _Course(record, run)
    meter = Meter(record.facts, kept)
    repulsion = kept.memory.get(REPULSION)
    degree = degrees_of(record)
    engaged, _ = watching(record, run)
    return [
        pack(
            run=0,
            epoch=0,
            step=int(kept.step[k]),
            gauges=_gauges(course, meter, int(kept.step[k]), k, float(engaged[k])),
            agents={
                "x": kept.x[k],
                "y": kept.y[k],
                "vx": kept.vx[k],
                "vy": kept.vy[k],
                "repulsion": np.full(size, np.nan) if repulsion is None else repulsion[k],
                "degree": degree,
                "on_target": kept.on_target[k],
                "alive": kept.alive[k],
            },
            targets={"x": kept.target_x[k], "y": kept.target_y[k], "present": kept.target_present[k]},
        )
        for k in (int(index) for index in chosen)
    ]


def _gauges(course: "_Course", meter: Meter, step: int, k: int, engaged: float) -> Gauges:
    xi_now, phi = meter.read(k)
    return Gauges(
        time_on_target=course.time_on_target(0, step),
        recent=course.time_on_target(max(0, step - RECENT), step),
        xi=course.xi(step),
        xi_now=xi_now,
        engaged=engaged,
        phi=phi,
    )


class _Course:
    """A run's sums up to a step: a record has them at the ends of batches, or of windows in them; they grow evenly."""

    def __init__(self, record: Record, run: int) -> None:
        tally, self._facts = record.tallies[run], record.facts
        windows = tally.timeline_present.shape[1]
        ends = np.cumsum(tally.batch_steps)
        within = -(-np.arange(1, windows + 1) * tally.batch_steps[:, None] // windows)
        self._windows = np.concatenate([[0.0], ((ends - tally.batch_steps)[:, None] + within).ravel()])
        self._present = _running(tally.timeline_present.reshape(-1, 1))
        self._on_target = _running(tally.timeline_on_target.reshape(-1, 1))
        self._batches = np.concatenate([[0.0], ends])
        self._sums = {name: _running(getattr(tally, name)) for name in ("steps", "fluctuation", "agent_steps")}
        self._none = new_tally(1, 1, len(self._facts.fleets), self._facts.agents, tally.watched.shape[1])

    def time_on_target(self, first: int, last: int) -> float:
        """Over the steps from `first` to before `last`."""
        present = _until(last, self._windows, self._present) - _until(first, self._windows, self._present)
        on_target = _until(last, self._windows, self._on_target) - _until(first, self._windows, self._on_target)
        sums = self._none._replace(present=present, on_target=on_target)
        return METRICS["time_on_target"].formula(sums, self._facts)

    def xi(self, last: int) -> float:
        """Over the steps before `last`."""
        sums: dict[str, Any] = {name: _until(last, self._batches, each)[None] for name, each in self._sums.items()}
        return METRICS["xi"].formula(self._none._replace(**sums), self._facts)


def _running(sums: Floats) -> Floats:
    """Sums of batches (B,) or (B, F), added up from nothing: (B + 1, F)."""
    columns = sums.reshape(sums.shape[0], -1)
    return np.concatenate([np.zeros((1, columns.shape[1])), np.cumsum(columns, axis=0)])


def _until(step: float, ends: Floats, running: Floats) -> Floats:
    """Running sums at a step, (F,)."""
    return np.array([np.interp(step, ends, column) for column in running.T])
