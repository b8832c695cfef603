"""Footage: frames of a run made to be looked at, and the current frame of a simulation."""

from typing import Any

import numpy as np

from shoal.core.errors import ScenarioError
from shoal.record.record import Record
from shoal.record.trajectory import OF_AGENTS, Trajectory
from shoal.run.facts import facts_of
from shoal.run.keep import check_room, frame_bytes
from shoal.run.simulate import ProgressCallback, chunk_steps
from shoal.run.simulation import Simulation
from shoal.scenario.schema import Scenario

_LEAN = {"x": 8, "y": 8, "on_target": 1, "engaged": 1, "alive": 1}  # what drawing needs, and its bytes


def footage(
    scenario: Scenario,
    steps: int,
    *,
    start: int = 0,
    every: int = 1,
    run: int = 0,
    lean: bool = False,
    progress: ProgressCallback | None = None,
) -> Record:
    """Run a scenario to step start + steps, and return the record with every `every`-th frame from `start` on.

    lean : frames are only to be drawn; what agents want and remember, how fast they are and what their k is, is 0

    Raises
    ------
    ScenarioError : the scenario has fewer steps, or there is no room for so many frames
    """
    end = start + steps
    if end > scenario.steps:
        raise ScenarioError(
            f"steps {start} to {end - 1}",
            f"are more than the {scenario.steps} of scenario {scenario.name}",
            "ask for fewer, or raise its `steps`",
        )
    check_room(-(-steps // every), footage_bytes(scenario, lean), None)
    simulation = Simulation(scenario, run)
    parts: dict[str, list[Any]] = {}
    while simulation.number < end:
        goal = start if simulation.number < start else end
        chunk = min(chunk_steps(scenario.agents), goal - simulation.number)
        part = simulation.advance(chunk, every=every if goal == end else None)
        for name, values in part.arrays().items() if part else ():
            parts.setdefault(name, []).append(_nothing(values) if lean and _left_out(name) else values)
        if progress:
            progress(simulation.number, end)
    arrays = {name: _joined(parts.pop(name)) for name in list(parts)}
    return _record(scenario, simulation, Trajectory.from_arrays(arrays))


def footage_bytes(scenario: Scenario, lean: bool) -> int:
    """What a frame of footage takes in memory."""
    return scenario.agents * sum(_LEAN.values()) if lean else frame_bytes(scenario)


def _left_out(name: str) -> bool:
    return (name in OF_AGENTS and name not in _LEAN) or name.startswith("memory.")


def _nothing(values: Any) -> Any:
    """Zeros of the shape of these values, which take no room."""
    return np.broadcast_to(np.zeros((), values.dtype), values.shape)


def _joined(parts: list[Any]) -> Any:
    """Consecutive frames as one array; nothing stays nothing."""
    first = parts[0]
    if first.size and not any(first.strides):
        return np.broadcast_to(first[:1], (sum(map(len, parts)), *first.shape[1:]))
    return np.concatenate(parts)


def current_record(simulation: Simulation) -> Record:
    """Return a record of one frame, the state that a simulation is in; the simulation stays as it is."""
    return _record(simulation.scenario, simulation, simulation.look())


def _record(scenario: Scenario, simulation: Simulation, frames: Trajectory) -> Record:
    facts, about = facts_of(scenario), {"seed": scenario.seed}
    return Record(scenario, facts, simulation.roster, (simulation.tally,), about, {simulation.run: frames})
