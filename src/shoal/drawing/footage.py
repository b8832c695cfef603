"""Footage: frames of a run made to be looked at, and the current frame of a simulation."""

from shoal.core.errors import ScenarioError
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.run.facts import facts_of
from shoal.run.simulate import ProgressCallback, chunk_steps
from shoal.run.simulation import Simulation
from shoal.scenario.schema import Scenario


def footage(
    scenario: Scenario,
    steps: int,
    *,
    start: int = 0,
    every: int = 1,
    run: int = 0,
    progress: ProgressCallback | None = None,
) -> Record:
    """Run a scenario to step start + steps, and return the record with every `every`-th frame from `start` on.

    Raises
    ------
    ScenarioError : the scenario has fewer steps
    """
    end = start + steps
    if end > scenario.steps:
        raise ScenarioError(
            f"steps {start} to {end - 1}",
            f"are more than the {scenario.steps} of scenario {scenario.name}",
            "ask for fewer, or raise its `steps`",
        )
    simulation = Simulation(scenario, run)
    parts = []
    while simulation.number < end:
        goal = start if simulation.number < start else end
        chunk = min(chunk_steps(scenario.agents), goal - simulation.number)
        part = simulation.advance(chunk, every=every if goal == end else None)
        parts += [part] if part else []
        if progress:
            progress(simulation.number, end)
    return _record(scenario, simulation, Trajectory.join(parts))


def current_record(simulation: Simulation) -> Record:
    """Return a record of one frame, the state that a simulation is in; the simulation stays as it is."""
    return _record(simulation.scenario, simulation, simulation.look())


def _record(scenario: Scenario, simulation: Simulation, frames: Trajectory) -> Record:
    facts, about = facts_of(scenario), {"seed": scenario.seed}
    return Record(scenario, facts, simulation.roster, (simulation.tally,), about, {simulation.run: frames})
