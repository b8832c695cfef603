"""Live edits: what a watcher may do to a running simulation without another scenario."""

import numpy as np

from shoal.core.errors import ScenarioError
from shoal.run.simulation import Simulation


def remove_agent(simulation: Simulation, agent: int) -> None:
    """Let an agent be gone from now on; it keeps its number.

    Raises
    ------
    ScenarioError : no such agent, it is gone already, or only two are left
    """
    swarm, agents = simulation.swarm, simulation.scenario.agents
    if not 0 <= agent < agents:
        raise ScenarioError("agent", f"is {agent}", f"name one from 0 to {agents - 1}")
    if swarm.leaves[agent] <= simulation.number:
        raise ScenarioError("agent", f"{agent} is gone already", "name another")
    if np.count_nonzero(swarm.alive[:agents]) <= 2:
        raise ScenarioError("agent", "a swarm has at least 2 agents", "add some before you remove one")
    with simulation.edit() as now:
        now.swarm.leaves[agent] = simulation.number


def move_target(simulation: Simulation, target: int, x: float, y: float) -> None:
    """Put a target at x, y [m], or as near as its box lets it; it goes on from there.

    Raises
    ------
    ScenarioError : no such target, or one that follows its track
    """
    targets = simulation.targets
    if not 0 <= target < targets.size:
        raise ScenarioError("target", f"is {target}", f"name one from 0 to {targets.size - 1}")
    if simulation.scenario.targets[target].kind == "track":
        raise ScenarioError("target", "follows its recorded track", "drag targets of other kinds")
    half_x = targets[target]["half_x"] or simulation.world.half_x  # a target at rest has no box of its own
    half_y = targets[target]["half_y"] or simulation.world.half_y
    with simulation.edit() as now:
        now.targets[target]["x"] = min(max(x, -half_x), half_x)
        now.targets[target]["y"] = min(max(y, -half_y), half_y)
