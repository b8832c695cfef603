"""Carry over: the state of a running simulation in another scenario, as if the swarm had changed while it ran."""

import numpy as np
import numpy.typing as npt

from shoal.core.agents import NEVER
from shoal.run.simulation import Simulation
from shoal.run.state import State
from shoal.scenario.schema import Scenario
from shoal.world.disturbances.contract import NOT_BEGUN, Weather

Lanes = npt.NDArray[np.int64]


def carry_over(
    old: Simulation, scenario: Scenario, origin: npt.ArrayLike | None = None, *, sums: bool = False
) -> Simulation:
    """Return a simulation of `scenario` that goes on where `old` is, which stays as it is.

    The step and the whole state are carried over: of agents, of targets of the same kind, and what is on the air. What
    depends on more than the agent itself has a rule: memories go to agents whose strategy is the same, others begin
    theirs where they are; k is carried where it adapts. Same bits, whenever the same is carried over at the same step.

    Parameters
    ----------
    scenario : what is from now on
    origin : (N,) for each agent the one that it was, -1 for a new one; default: agents keep their numbers
    sums : those of the tally go on, which must be of the same fleets, agents, targets and steps; else they start over

    Raises
    ------
    StrategyError : the strategy cannot be compiled
    """
    new = Simulation(scenario, old.run)
    new.number = old.number
    new.catch_up()
    came_from = np.arange(scenario.agents) if origin is None else np.asarray(origin, np.int64)
    here = np.flatnonzero((came_from >= 0) & (came_from < old.scenario.agents))
    there = came_from[here]
    before = old.moment
    with new.edit() as now:
        _carry_bodies(old, new, now, here, there)
        _let_join(new.number, now, np.setdiff1d(np.arange(scenario.agents), here))
        for mine in range(min(new.targets.size, old.targets.size)):
            if new.targets[mine]["kind"] == old.targets[mine]["kind"]:
                now.targets[mine] = before.targets[mine]
        if new.scenario.disturbances == old.scenario.disturbances:
            _carry_weather(before.weather, now.weather, here, there)
        else:  # others begin with the coming step; what the old ones did ends
            now.targets["drift_x"][:] = now.targets["drift_y"][:] = 0.0
            now.weather.clock[0] = NOT_BEGUN
        new.begin()
        _carry_memory(old, new, now, here, there)
        _carry_air(old, new, now, here, there)
        for sum_, known in zip(now.tally, before.tally if sums else (), strict=False):
            sum_[...] = known
    return new


def _carry_bodies(old: Simulation, new: Simulation, now: State, here: Lanes, there: Lanes) -> None:
    """Everything of an agent's own but its memory; k only where it adapts, else it is what is chosen now."""
    chosen = now.swarm.neighbors.copy()
    own = {"fix_x", "fix_y"} | (set() if old.world.inexact else {"error_x", "error_y"})
    for name, theirs in old.moment.swarm._asdict().items():
        if theirs.ndim == 1 and name not in own:  # memories have a column per field, and a rule of their own
            getattr(now.swarm, name)[here] = theirs[there]
    if new.world.inexact:
        now.swarm.fix_x[:] = now.swarm.x + now.swarm.error_x
        now.swarm.fix_y[:] = now.swarm.y + now.swarm.error_y
    adapts = old.radio.adaptive and new.radio.adaptive
    now.swarm.neighbors[:] = np.clip(now.swarm.neighbors, new.radio.fewest, new.radio.most) if adapts else chosen


def _carry_weather(before: Weather, now: Weather, here: Lanes, there: Lanes) -> None:
    """What the same disturbances do and remember; for agents that are new they begin now."""
    now.effects[here] = before.effects[there]
    now.memory[:, here] = before.memory[:, there]
    now.clock[:] = before.clock


def _let_join(number: int, now: State, agents: Lanes) -> None:
    """New agents are there from now on; their lifetimes begin now."""
    now.swarm.joins[agents] = number
    mortal = agents[now.swarm.leaves[agents] < NEVER]
    now.swarm.leaves[mortal] += number


def _carry_memory(old: Simulation, new: Simulation, now: State, here: Lanes, there: Lanes) -> None:
    """Fields of the same name, of agents with the same strategy."""
    before = [old.crew.strategies[fleet] for fleet in old.swarm.fleet[there]]
    after = [new.crew.strategies[fleet] for fleet in new.swarm.fleet[here]]
    same = np.array([one is other for one, other in zip(before, after, strict=True)], bool)
    for column, name in enumerate(new.memory_fields):
        if name in old.memory_fields:
            now.swarm.memory[here[same], column] = old.swarm.memory[there[same], old.memory_fields.index(name)]
    now.swarm.told[:] = now.swarm.memory[:, : now.swarm.told.shape[1]]  # memory begins with what is told


def _carry_air(old: Simulation, new: Simulation, now: State, here: Lanes, there: Lanes) -> None:
    """Reports in flight, and whose each has; where there are none, as if all had said this before, and nobody heard."""
    same = all(getattr(old.radio, each) == getattr(new.radio, each) for each in ("delay", "interval", "max_age"))
    spoken = {name: said for name, said in now.air._asdict().items() if name != "heard"}
    for name, said in spoken.items():
        said[:] = getattr(now.swarm, {"x": "fix_x", "y": "fix_y"}.get(name, name))
        if same and (name != "told" or old.crew.told == new.crew.told):
            said[:, here] = getattr(old.moment.air, name)[:, there]
    if same and now.air.heard.size:
        now.air.heard[np.ix_(here, here)] = old.moment.air.heard[np.ix_(there, there)]
