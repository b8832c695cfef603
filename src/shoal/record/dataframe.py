"""A record as tidy pandas tables: one row per run and metric, or per frame and agent."""

from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.core.errors import UnknownNameError
from shoal.metrics.each_target import each_target
from shoal.metrics.effort import fleet_power
from shoal.metrics.energy import fleet_energy
from shoal.metrics.heading_bearing import fleet_stationary
from shoal.metrics.summary import METRICS
from shoal.metrics.velocity_fluctuation import fleet_fluctuation
from shoal.record.tables import data_frame
from shoal.record.trajectory import Trajectory

if TYPE_CHECKING:
    import pandas

    from shoal.record.record import Record

_SHOWN = ("x", "y", "vx", "vy", "on_target", "engaged", "alive", "neighbors")


def to_pandas(record: "Record", what: str) -> "pandas.DataFrame":
    """Return one of the TABLES of a record, see `Record.to_pandas`.

    Raises
    ------
    UnknownNameError : there is no such table
    MissingExtraError : pandas is not installed
    """
    if what not in TABLES:
        raise UnknownNameError.of("table", what, TABLES)
    return data_frame(TABLES[what](record), "a record as a DataFrame")


def _metrics(record: "Record") -> dict[str, Any]:
    return _columns(
        ("run", "metric", "value", "unit"),
        [
            (run, name, metric.formula(tally, record.facts), metric.unit)
            for run, tally in enumerate(record.tallies)
            for name, metric in METRICS.items()
        ],
    )


def _fleets(record: "Record") -> dict[str, Any]:
    rows = []
    for run, tally in enumerate(record.tallies):
        speed, power = fleet_power(tally, record.facts)
        energy, charge = fleet_energy(tally, record.facts)
        of_metric = {
            "xi_raw": fleet_fluctuation(tally, record.facts),
            "stationary": fleet_stationary(tally, record.facts),
            "speed": speed,
            "power": power,
            **({"energy": energy, "charge": charge} if any(record.facts.capacities) else {}),
        }
        for name, values in of_metric.items():
            for fleet, value in zip(record.facts.fleets, values, strict=True):
                rows.append((run, fleet, name, float(value), METRICS[name].unit))
    return _columns(("run", "fleet", "metric", "value", "unit"), rows)


def _targets(record: "Record") -> dict[str, Any]:
    rows = [
        (run, target, name, float(value), METRICS[name].unit)
        for run, tally in enumerate(record.tallies)
        for name, values in each_target(tally, record.facts).items()
        for target, value in enumerate(values)
    ]
    return _columns(("run", "target", "metric", "value", "unit"), rows)


def _frames(record: "Record") -> dict[str, Any]:
    fleets = np.repeat(record.facts.fleets, record.facts.counts)
    return _stacked(
        record,
        lambda frames: {
            "agent": np.arange(frames.x.shape[1]),
            "fleet": fleets,
            **{name: getattr(frames, name) for name in _SHOWN},
            **{f"memory_{name}": values for name, values in frames.memory.items()},
        },
    )


def _target_frames(record: "Record") -> dict[str, Any]:
    return _stacked(
        record,
        lambda frames: {
            "target": np.arange(frames.target_x.shape[1]),
            "x": frames.target_x,
            "y": frames.target_y,
            "present": frames.target_present,
        },
    )


def _stacked(record: "Record", columns: Any) -> dict[str, Any]:
    """Frames of all runs below each other: a row per run, step and what has the columns."""
    parts = [_of_run(record, run, frames, columns(frames)) for run, frames in sorted(record.trajectories.items())]
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]} if parts else {}


def _of_run(record: "Record", run: int, frames: Trajectory, columns: dict[str, Any]) -> dict[str, Any]:
    shape = next(values.shape for values in columns.values() if values.ndim == 2)
    step = np.broadcast_to(np.asarray(frames.step)[:, None], shape).ravel()
    known = {name: np.broadcast_to(values, shape).ravel() for name, values in columns.items()}
    return {"run": np.full(step.size, run), "step": step, "time": step * record.facts.time_step, **known}


def _columns(names: tuple[str, ...], rows: list[tuple[Any, ...]]) -> dict[str, Any]:
    return dict(zip(names, zip(*rows, strict=True), strict=True))


TABLES = {
    "metrics": _metrics,
    "fleets": _fleets,
    "targets": _targets,
    "frames": _frames,
    "target_frames": _target_frames,
}
