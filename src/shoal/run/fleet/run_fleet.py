"""Run a fleet: a scenario in, a record out, of buoys that decide by themselves."""

import math
import os
from collections import Counter
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from shoal.buoy.named import buoys_of
from shoal.buoy.trust import NOBODY, Trust, key_in
from shoal.core.errors import FleetError
from shoal.record.files import RecordFolder
from shoal.record.record import Record
from shoal.run.compiling import BUOYS, mark_compiled
from shoal.run.fleet.kills import Killing, company, kills_of
from shoal.run.fleet.lockstep import Crowd, run_in_lockstep
from shoal.run.fleet.log import Log, Onlooker
from shoal.run.fleet.memory import InMemory
from shoal.run.fleet.ocean import Ocean, check_buoys_can
from shoal.run.fleet.paced import PacedSea, percentile
from shoal.run.fleet.processes import Processes
from shoal.scenario.crew import crew_of
from shoal.scenario.load import Source, load
from shoal.scenario.schema import Scenario

MESHES = ("zenoh", "memory")


@dataclass(frozen=True)
class Terms:
    """How a fleet is run.

    Attributes
    ----------
    processes : that buoys run in; default: one for each core
    lockstep : whether a step takes as long as all buoys need, instead of its time
    speed : times real time; in lockstep, and in memory: at most, default as fast as it goes
    kill : who is killed when, BUOY@STEP
    mesh : "zenoh", between processes; "memory", all in this process, which is always in lockstep
    max_age : network.max_age of the scenario; default: as it says, and by the clock 1 at least on board
    plain : whether buoys decide without a compiler: they start at once, with less memory
    trust : whose orders they obey, and whom they hear
    """

    processes: int | None = None
    lockstep: bool = False
    speed: float | None = None
    kill: Sequence[str] = field(default=())
    mesh: str = "zenoh"
    max_age: int | None = None
    plain: bool = False
    trust: Trust = NOBODY

    @property
    def in_lockstep(self) -> bool:
        """Whether a step takes as long as all buoys need."""
        return self.lockstep or self.mesh == "memory"


def run_fleet(
    scenario: Source,
    terms: Terms | None = None,
    *,
    out: str | Path | None = None,
    progress: Callable[[int, int], None] | None = None,
    onlooker: Onlooker | None = None,
    tell: Callable[[str], None] | None = None,
) -> Record:
    """Run the buoys of a scenario by themselves in a stand-in for the sea, and return the record of what they did.

    An interrupt ends it early: what was done until then is the record.

    Parameters
    ----------
    scenario : what to run: a preset's name, a TOML file, a dict or a Scenario
    terms : how; default: by the clock, on a mesh of zenoh, in a process for each core
    out : write the record to this new folder
    progress : called as progress(steps done, steps in all)
    onlooker : called as onlooker(simulation, frame, who is silent) before every step, and must be quick
    tell : called with where buoys take orders, once they do

    Raises
    ------
    ScenarioError, StrategyError : what cannot run, or what buoys cannot do
    FleetError : buoys or terms that cannot be
    MissingExtraError : zenoh is not installed
    RecordError : `out` exists or cannot be written
    """
    scenario, terms = load(scenario), terms or Terms()
    kills = kills_of(terms.kill, scenario.agents)
    shares = _shares(scenario.agents, terms)
    in_memory = terms.mesh == "memory"
    if terms.trust.command_key:
        key_in(terms.trust.command_key)
    by_clock = not terms.in_lockstep
    period = scenario.time_step / (terms.speed or 1.0)
    if terms.max_age is not None:
        scenario = load(scenario, **{"network.max_age": terms.max_age})
    max_age = max(scenario.network.max_age, int(by_clock and terms.max_age is None))
    notes: list[str] = []
    report = progress or (lambda done, total: None)
    with ExitStack() as stack:
        folder = None if out is None else stack.enter_context(RecordFolder(out))  # refused now, not after the run
        crowd: Crowd
        if in_memory:
            ocean = _opened(scenario, onlooker)
            crowd = InMemory(scenario, max_age=max_age)
        else:
            check_buoys_can(scenario, crew_of(scenario))
            oceans: list[Ocean] = []
            crowd = stack.enter_context(
                Processes(
                    scenario,
                    shares,
                    max_age=max_age,
                    period=period if by_clock else None,
                    plain=terms.plain,
                    meanwhile=lambda: oceans.append(_opened(scenario, onlooker)),
                    trust=terms.trust,
                )
            )
            (ocean,) = oceans
        mark_compiled(scenario, BUOYS)
        killing, log = Killing(crowd, kills), Log(ocean, folder, onlooker)
        stack.callback(log.close)
        if isinstance(crowd, Processes):
            crowd.heed = log.heed
            if tell and terms.trust.command_key:
                tell(crowd.address)
        sea = PacedSea(ocean, crowd, killing, log, period) if isinstance(crowd, Processes) and by_clock else None
        try:
            if sea:
                sea.run(report)
            else:
                run_in_lockstep(ocean, killing, log, report, pace=period if terms.speed else None)
        except KeyboardInterrupt:
            if log.steps == 0:
                raise
            notes.append(f"interrupted after {log.steps:,} of {scenario.steps:,} steps")
        facts = crowd.finish() if isinstance(crowd, Processes) else []
        words = crowd.last_words() if isinstance(crowd, Processes) else []
        notes = [*notes, *_lost(log.lost), *words, *(sea.notes() if sea else ()), *_measured(facts, by_clock)]
        return log.record(notes)


def _opened(scenario: Scenario, onlooker: Onlooker | None) -> Ocean:
    """The sea before the first step, as the onlooker sees it while buoys start."""
    ocean = Ocean(scenario)
    if onlooker:
        onlooker(ocean.simulation, ocean.simulation.look(), ())
    return ocean


def check_terms(scenario: Scenario, terms: Terms) -> list[str]:
    """Refuse terms that cannot be, and what buoys cannot do, before anything starts; say who is killed with others.

    Raises
    ------
    ScenarioError, StrategyError, FleetError : as run_fleet
    """
    kills = kills_of(terms.kill, scenario.agents)
    shares = _shares(scenario.agents, terms)
    check_buoys_can(scenario, crew_of(scenario))
    return [] if terms.mesh == "memory" else company(kills, shares)


def _shares(agents: int, terms: Terms) -> list[list[int]]:
    """Which buoys are in one process each.

    Raises
    ------
    FleetError : a term that cannot be
    """
    if terms.mesh not in MESHES:
        raise FleetError("--mesh", f"is {terms.mesh!r}", f"there are: {', '.join(MESHES)}")
    if terms.mesh == "memory" and any(terms.trust):
        option = "--command-key" if terms.trust.command_key else "--mesh-config"
        raise FleetError(option, "is for a mesh between processes", "leave it out, or take --mesh zenoh")
    if terms.mesh == "memory" and terms.processes not in (None, 1):
        raise FleetError("--mesh memory", "is within one process", "leave out --processes, or take --mesh zenoh")
    for name, number, least, most in (
        ("--processes", terms.processes, 1, agents),
        ("--speed", terms.speed, 0.001, 1000.0),
        ("--max-age", terms.max_age, 0, 1000),
    ):
        if number is not None and not (math.isfinite(number) and least <= number <= most):
            raise FleetError(name, f"is {number:g}", f"give {least:g} to {most:g}")
    processes = terms.processes or min(os.cpu_count() or 1, agents)
    return [list(range(agents))[agents * p // processes : agents * (p + 1) // processes] for p in range(processes)]


def _lost(lost: list[tuple[int, int]]) -> list[str]:
    steps = sorted({step for step, _ in lost})
    return [f"lost at step {step:,}: {buoys_of(id for then, id in lost if then == step)}" for step in steps]


def _measured(facts: list[dict[str, Any]], by_clock: bool) -> list[str]:
    """What the processes measured, in sentences."""
    if not facts:
        return []
    buoy_seconds = sum(len(each["ids"]) * each["seconds"] for each in facts)
    spent = sum(each["spent"] for each in facts)
    counts: Counter[str] = Counter()
    for each in facts:
        counts.update(each["counts"])
    words = ("late", "duplicate", "changed", "early", "damaged", "strange", "reordered")
    dropped = [f"{counts[word]:,} {word}" for word in words]
    notes = [
        f"{1000 * spent / max(buoy_seconds, 1e-9):.2f} ms of processor per buoy and second, "
        f"{max(each['memory'] for each in facts) / 2**20:.0f} MiB in the largest of {len(facts)} processes",
        f"of the reports that arrived {counts['new']:,} were new; {', '.join(dropped)}",
    ]
    foreign = sum(each["foreign"] for each in facts)
    if foreign:
        notes.append(f"{foreign:,} reports were said by somebody else under the number of a buoy that reports itself")
    orders: Counter[str] = Counter()
    for each in facts:
        orders.update(each["orders"])
    if orders["unread"]:
        notes.append(f"{orders['unread']:,} orders came, and none was obeyed: the buoys have no key for them")
    elif orders:
        notes.append("of the messages about orders " + ", ".join(f"{n:,} {word}" for word, n in sorted(orders.items())))
    if by_clock:
        delays, ages = (_summed(facts, name) for name in ("delays", "ages"))
        unheard = ages.pop(-1, 0)
        heard = sum(ages.values())
        skipped = sum(each["skipped"] for each in facts)
        mean = sum(age * count for age, count in ages.items()) / max(1, heard)
        notes += [
            f"reports arrived {percentile(delays, 0.5)} ms after their step began (median; 99 %: "
            f"{percentile(delays, 0.99)} ms)",
            f"decisions were on reports {mean:.4f} steps old on average; {unheard / max(1, unheard + heard):.3%} of "
            "the reports of those who were there did not come in time",
            f"{skipped:,} step{'s' * (skipped != 1)} passed without a decision of a process",
        ]
    return notes


def _summed(facts: list[dict[str, Any]], name: str) -> dict[int, int]:
    found: Counter[int] = Counter()
    for each in facts:
        found.update({int(key): count for key, count in each.get(name, {}).items()})
    return dict(found)
