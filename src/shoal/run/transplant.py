"""Transplant: the state of a running simulation carried over into another scenario, as if the swarm had changed."""

from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.core.agents import NEVER
from shoal.core.errors import ScenarioError
from shoal.run.simulation import Simulation
from shoal.scenario.schema import Scenario

Lanes = npt.NDArray[np.int64]

# What a target is doing; all else is its make.
_DOING = (
    "present", "x", "y", "watchers", "lost", "heading_x", "heading_y", "dive_phase",
    "waypoint_x", "waypoint_y", "waypoint_age", "leg",
)  # fmt: skip
_BODY = ("x", "y", "vx", "vy", "command_x", "command_y", "on_target", "alive", "joins", "leaves", "contact")
_SAID = ("x", "y", "vx", "vy", "on_target", "told")


def transplant(old: Simulation, scenario: Scenario, origin: npt.ArrayLike | None = None) -> Simulation:
    """Return a simulation of `scenario` that goes on where `old` is, which stays as it is.

    Positions, velocities, targets (of the same kind), the step and what is on the air are carried over, and memories of
    agents whose strategy is the same; other agents begin theirs where they are. Sums begin anew. Same bits, whenever
    the same is transplanted at the same step.

    Parameters
    ----------
    origin : (N,) for each agent the one that it was, -1 for a new one; default: agents keep their numbers
    """
    new = Simulation(scenario, old.run)
    new.number = old.number
    came_from = np.arange(scenario.agents) if origin is None else np.asarray(origin, np.int64)
    here = np.flatnonzero((came_from >= 0) & (came_from < old.scenario.agents))
    there = came_from[here]
    for name in _BODY:
        getattr(new.swarm, name)[here] = getattr(old.swarm, name)[there]
    _let_join(new, np.setdiff1d(np.arange(scenario.agents), here))
    for mine, before in zip(new.targets, old.targets, strict=False):
        if mine["kind"] == before["kind"]:
            for name in _DOING:
                mine[name] = before[name]
    new.begin()
    _carry_memory(old, new, here, there)
    _carry_radio(old, new, here, there)
    if (new.swarm.leaves < NEVER).any():
        _reckon_with_absence(new)
    return new


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
    swarm.leaves[agent] = simulation.number
    swarm.alive[agent] = 0.0
    swarm.vx[agent] = 0.0
    swarm.vy[agent] = 0.0
    _reckon_with_absence(simulation)


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
    here = targets[target]
    half_x = here["half_x"] or simulation.world.half_x  # a target at rest has no box of its own
    half_y = here["half_y"] or simulation.world.half_y
    here["x"] = min(max(x, -half_x), half_x)
    here["y"] = min(max(y, -half_y), half_y)


def _let_join(new: Simulation, agents: Lanes) -> None:
    """New agents are there from now on; their lifetimes begin now."""
    new.swarm.joins[agents] = new.number
    mortal = agents[new.swarm.leaves[agents] < NEVER]
    new.swarm.leaves[mortal] += new.number


def _carry_memory(old: Simulation, new: Simulation, here: Lanes, there: Lanes) -> None:
    """Fields of the same name, of agents with the same strategy; and k where it adapts."""
    before = [old.crew.strategies[fleet] for fleet in old.swarm.fleet[there]]
    now = [new.crew.strategies[fleet] for fleet in new.swarm.fleet[here]]
    same = np.array([one is other for one, other in zip(before, now, strict=True)], bool)
    for column, name in enumerate(new.memory_fields):
        if name in old.memory_fields:
            new.swarm.memory[here[same], column] = old.swarm.memory[there[same], old.memory_fields.index(name)]
    new.swarm.told[:] = new.swarm.memory[:, : new.swarm.told.shape[1]]  # memory begins with what is told
    if old.radio.adaptive and new.radio.adaptive:
        degrees = np.clip(old.swarm.neighbors[there], new.radio.fewest[here], new.radio.most[here])
        new.swarm.neighbors[here] = degrees


def _carry_radio(old: Simulation, new: Simulation, here: Lanes, there: Lanes) -> None:
    """Reports that are still on their way; where there are none such, as if all had always said what they say now."""
    for name in _SAID:
        said: Any = getattr(new.radio, name)
        said[:] = getattr(new.swarm, name)
        if old.radio.delay == new.radio.delay and (name != "told" or old.crew.told == new.crew.told):
            said[:, here] = getattr(old.radio, name)[:, there]


def _reckon_with_absence(simulation: Simulation) -> None:
    """Switch on what the engine leaves out of runs in which everybody is always there."""
    simulation.world = simulation.world._replace(mortal=True)
    simulation.radio = simulation.radio._replace(limited=True)
