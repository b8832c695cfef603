"""What agents of an environment know, do and are rewarded for: small specs, and the arrays that the engine works on."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from shoal.core.errors import did_you_mean
from shoal.engine.environment import REWARDS, Earned
from shoal.engine.observation import OWN, REPORT, Seen, new_block
from shoal.learn.errors import LearnError
from shoal.run.swarms import Actions
from shoal.scenario.briefing import degrees
from shoal.scenario.crew import Crew, crew_of
from shoal.scenario.schema import Scenario
from shoal.strategies.guided import GUIDED

MOST = 2.0  # what is observed is cut to +- this, of what counts as 1


@dataclass(frozen=True)
class Observe:
    """What an agent knows, in this order: of itself, of the reports that it hears, the nearest first, of its memory.

    Places and distances are shares of half the area's longer side, velocities of the fastest fleet's top speed.

    Parameters
    ----------
    own : some of x, y, vx, vy, on_target, max_speed, drift_x, drift_y, aground; default: the first six
    report : some of heard (1: there is one), dx, dy (as seen from oneself), vx, vy, on_target; default: all six
    reports : of how many; those not heard are zeros; default: as many as the scenario lets any agent hear, so that
        with `neighbors=8` an agent knows 6 + 8 * 6 = 54 numbers
    memory : fields of the strategy's memory, in their own units; default: none
    """

    own: tuple[str, ...] = ("x", "y", "vx", "vy", "on_target", "max_speed")
    report: tuple[str, ...] = ("heard", "dx", "dy", "vx", "vy", "on_target")
    reports: int | None = None
    memory: tuple[str, ...] = ()


@dataclass(frozen=True)
class Act:
    """What an agent does: numbers from -1 to 1.

    Parameters
    ----------
    kind : velocity, the default: the two parts of the wanted velocity, as shares of its own top speed; repulsion: a_R
        and the attraction to the nearest neighbor on target, in the paper's rule (Eqs. 2 and 4); memory: fields of the
        memory of the scenario's own strategy, which it finds there when it decides
    bounds : what -1 and 1 mean, by field: of kind repulsion `repulsion` [m] and `attraction`, else the paper's a_R and
        0 to 1; of kind memory all that are written
    scaled : False: velocities are in m/s
    """

    kind: Literal["velocity", "repulsion", "memory"] = "velocity"
    bounds: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    scaled: bool = True


def seen_by(observe: Observe, scenario: Scenario, crew: Crew, count: int) -> Seen:
    """Arrays for what the agents of `count` swarms know.

    Raises
    ------
    LearnError : there is nothing of a name, or no report of a number
    """
    _check("observe.own", observe.own, OWN)
    _check("observe.report", observe.report, REPORT)
    _check("observe.memory", observe.memory, crew.memory)
    agents = scenario.agents
    most = agents - 1
    slots = _most_heard(scenario, crew) if observe.reports is None else observe.reports
    if not 0 <= slots <= most:
        problem = f"is {slots}, but {agents} agents hear {most} others at most"
        raise LearnError("observe.reports", problem, "ask for 0 or more, up to that")
    width = len(observe.report) if slots else 0
    size = len(observe.own) + width * slots + len(observe.memory)
    if size == 0:
        raise LearnError("observe", "is of nothing", "name something under own, report or memory")
    return Seen(
        observations=np.zeros((count, agents, size), np.float32),
        there=np.zeros((count, agents), np.bool_),
        own=_bits(observe.own, OWN),
        report=_bits(observe.report, REPORT),
        memory=np.array([crew.memory.index(name) for name in observe.memory], np.int64),
        slots=slots,
        width=width,
        per_length=2.0 / max(scenario.area.width, scenario.area.height),
        per_speed=1.0 / max(fleet.max_speed for fleet in scenario.fleets),
        most=MOST,
        block=new_block(agents),
    )


def names_of(observe: Observe, seen: Seen) -> list[str]:
    """What each number of an observation is, in their order, such as report.0.dx."""
    own = [f"own.{name}" for name in OWN if name in observe.own]
    heard = [f"report.{n}.{name}" for n in range(seen.slots) for name in REPORT if name in observe.report]
    return [*own, *heard, *(f"memory.{name}" for name in observe.memory)]


def earned_by(reward: Mapping[str, float], agents: int, count: int) -> Earned:
    """Arrays for the rewards of `count` swarms of so many agents.

    Raises
    ------
    LearnError : there is no reward of a name, or none at all
    """
    _check("reward", reward, REWARDS)
    if not reward:
        raise LearnError("reward", "is for nothing", f"weigh some of: {', '.join(REWARDS)}")
    weights = np.array([float(reward.get(name, 0.0)) for name in REWARDS])
    return Earned(np.zeros(count), np.zeros((count, agents)), np.zeros((count, agents, len(REWARDS))), weights)


def acting(act: Act, scenario: Scenario) -> tuple[Crew, Actions]:
    """Who decides by what is written into memories, and what actions mean.

    Raises
    ------
    LearnError : there is no such kind or field, bounds are missing or no range
    """
    crew = crew_of(scenario)
    if act.kind == "velocity":
        if act.bounds:
            raise LearnError("act.bounds", "are not of kind velocity", "leave them out")
        top = np.repeat([fleet.max_speed for fleet in scenario.fleets], scenario.counts)[:, None] * np.ones(2)
        free = np.full(2, np.inf)  # the engine limits what is too fast
        return crew.puppets(), Actions(-free, free, 0.0 * top, top if act.scaled else 1.0 + 0.0 * top, np.arange(2))
    bounds = dict(act.bounds)
    if act.kind == "repulsion":
        paper = scenario.with_(strategy="knn-pso").strategy.kernel_params()  # lengths that suit the scenario
        crew = _guided(crew, paper)
        _check("act.bounds", bounds, GUIDED.memory)
        bounds = {"repulsion": (paper.repulsion_min, paper.repulsion_max), "attraction": (0.0, 1.0)} | bounds
    elif act.kind != "memory":
        raise LearnError("act.kind", f"is {act.kind!r}", "write velocity, repulsion or memory")
    _check("act.bounds", bounds, crew.memory)
    if not bounds:
        raise LearnError("act.bounds", "name no field", f"say what -1 and 1 mean: {{{crew.memory[0]!r}: (0.0, 1.0)}}")
    for name, (low, high) in bounds.items():
        if not (np.isfinite(low) and np.isfinite(high) and low < high):
            raise LearnError(f"act.bounds.{name}", f"is {low} to {high}", "give two numbers, the lower first")
    low, high = np.array(list(bounds.values()), float).T
    one, everybody = np.ones(len(bounds)), np.ones((scenario.agents, 1))
    columns = np.array([crew.memory.index(name) for name in bounds])
    return crew, Actions(-one, one, everybody * (high + low) / 2, everybody * (high - low) / 2, columns)


def _guided(crew: Crew, paper: Any) -> Crew:
    params = GUIDED.params(**{name: getattr(paper, name) for name in GUIDED.params._fields})
    return Crew(strategies=(GUIDED,) * len(crew.strategies), params=params, memory=tuple(GUIDED.memory), told=())


def _most_heard(scenario: Scenario, crew: Crew) -> int:
    """The most reports that an agent hears in a step."""
    adaptive = scenario.network.adaptive
    return min(scenario.agents - 1, max([*degrees(scenario, crew), adaptive.most if adaptive else 0]))


def _bits(names: Iterable[str], known: tuple[str, ...]) -> int:
    return sum(1 << known.index(name) for name in dict.fromkeys(names))


def _check(where: str, names: Iterable[str], known: Iterable[str]) -> None:
    names, known = list(names), list(known)
    for name in names:
        if name not in known:
            fix = f"{did_you_mean(name, known)}there are: {', '.join(known) or 'none'}"
            raise LearnError(where, f"there is no {name!r}", fix)
        if names.count(name) > 1:
            raise LearnError(where, f"names {name!r} twice", "once is enough")
