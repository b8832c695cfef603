"""A soak: a fleet in virtual time under a seeded adversary, every step of it checked; a seed decides every bit."""

import hashlib
import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple, cast

import numpy as np

from shoal.buoy.tether import BEGIN, Commands, Tick
from shoal.run.fleet.adversary import RECOVERY, Adversary, Incident
from shoal.run.fleet.ear import Ear, Heard, KeptEar
from shoal.run.fleet.invariants import BrokenInvariantError, demand, together, truths
from shoal.run.fleet.log import Log
from shoal.run.fleet.ocean import Ocean
from shoal.run.fleet.order_storm import OrderStorm
from shoal.run.fleet.paced import PacedSea
from shoal.run.fleet.sea_watch import SeaWatch
from shoal.run.fleet.second_opinion import Doubt, SecondOpinion
from shoal.run.fleet.thought_check import check_commands, check_thoughts
from shoal.run.fleet.vessel import Thought, Vessel
from shoal.run.fleet.virtual_mesh import Parcel, VirtualMesh
from shoal.scenario.briefing import fleet_of
from shoal.scenario.load import Source, load
from shoal.scenario.schema import Scenario

STEPS = 3_000  # of a soak, unless it is told otherwise
SECOND = 4  # steps of a process from one decision that is made again to the next


class Outcome(NamedTuple):
    """What came of a soak.

    seed, steps : of it, as far as it went; at_sea : steps of all buoys that were not killed; decisions : that they made
    broken : the invariant that was broken first, and how, or None
    sha256 : of all that happened, in the end: frames, decisions, what befell messages and processes
    events : what the adversary did to processes, "STEP KIND PROCESS AMOUNT"
    """

    seed: int
    steps: int
    at_sea: int
    decisions: int
    broken: str | None
    sha256: str
    events: list[str]


@dataclass(frozen=True)
class Setting:
    """Under which rules a fleet is soaked, by chance of its seed."""

    scenario: Scenario
    shares: list[list[int]]
    max_age: int

    @classmethod
    def of(cls, seed: int, source: Source, steps: int) -> "Setting":
        """The setting of a seed: buoys in 3 to 8 processes, ages up to 3 steps, in one of four radios with limits."""
        scenario = load(source)
        chance = np.random.default_rng([seed, 0x5E77])
        network = scenario.network
        if chance.random() < 0.25:
            limits: dict[str, Any] = {
                "range": 0.4 * math.hypot(scenario.area.width, scenario.area.height),
                "delay": int(chance.integers(0, 3)),
            }
            if chance.random() < 0.5:
                limits["interval"] = int(chance.integers(2, 4)) * scenario.time_step
            network = network.model_validate({**dict(network), **limits})
        agents = scenario.agents
        processes = min(agents, int(chance.integers(3, 9)))
        cuts = [agents * p // processes for p in range(processes + 1)]
        changed = {**dict(scenario), "network": network, "seed": seed, "steps": steps}
        shares = [list(range(a, b)) for a, b in pairwise(cuts)]
        return cls(Scenario.model_validate(changed), shares, max(network.max_age, int(chance.integers(0, 4))))


class _Decided(NamedTuple):
    """A decision of a process: at which tick, what its buoys thought, and what came of it.

    heard : what they can have heard; under : the orders that they are under, of those who are under any
    """

    tick: Tick
    thought: Thought
    commands: Commands
    heard: Heard
    under: dict[int, str]


class Soak:
    """One fleet, from its first step to its last.

    Parameters
    ----------
    seed : decides everything
    source : the scenario, whose seed and radios the seed replaces
    steps : how long it takes
    """

    def __init__(self, seed: int, source: Source = "oceans2020", steps: int = STEPS) -> None:
        self.seed, self.events, self.at_sea, self.decisions = seed, list[str](), 0, 0
        self._hash = hashlib.sha256()
        self._setting = setting = Setting.of(seed, source, steps)
        self._scenario = scenario = setting.scenario
        self._ocean = Ocean(scenario)
        self._log = Log(self._ocean)
        # Of the sea by the clock all that has no clock: who is silent, who is lost, what is noted.
        self._sea = PacedSea(self._ocean, cast(Any, None), cast(Any, None), self._log, scenario.time_step)
        self._adversary = Adversary(seed, len(setting.shares), scenario.agents)
        self._mesh = VirtualMesh(len(setting.shares), self._adversary)
        self._vessels = {p: Vessel(scenario, ids, setting.max_age) for p, ids in enumerate(setting.shares)}
        self._told = self._vessels[0].aboard.buoys[0].told
        self._ears = {p: self._ear() for p in self._vessels}
        self._neighbors = self._vessels[0].aboard.buoys[0].neighbors
        self._speeds = np.array([scenario.fleets[fleet_of(scenario, id)].max_speed for id in range(scenario.agents)])
        self._second = SecondOpinion(scenario)
        self._watch = SeaWatch(scenario, self._ocean)
        self._orders = OrderStorm(seed, scenario, len(setting.shares))
        for process, vessel in self._vessels.items():
            self._orders.start(process, vessel, 0, anew=True)
        self._saved: dict[int, dict[int, Any]] = {}

    def run(self) -> Outcome:
        """Go to the end, or to the first invariant that is broken."""
        broken = None
        try:
            self._run()
        except BrokenInvariantError as error:
            broken = str(error)
        except Exception as error:  # whatever it is, its seed is what is needed
            broken = f"nothing raises an error: {type(error).__name__}: {str(error)[:300]}"
        counts = self._ocean.number, self.at_sea, self.decisions
        return Outcome(self.seed, *counts, broken, self._hash.hexdigest(), self.events)

    def _run(self) -> None:
        first = self._ocean.tick(BEGIN)._replace(readings=self._ocean.readings(), hears=None)
        for vessel in self._vessels.values():
            begun = vessel.aboard.begin(first.of(vessel.ids))
            self._log.remember(begun.ids, begun.memory)
            self._watch.note(begun, 0)
        while self._ocean.number < self._scenario.steps:
            self._step()
        self._watch.check_record(self._log.record(self._sea.notes()))
        self._hash.update(repr(sorted(self._mesh.counts.items())).encode())

    def _step(self) -> None:
        now, tick = self._ocean.number, self._ocean.tick()
        self._watch.check_tick(tick, self._ocean)
        self.at_sea += len(tick.readings)
        for incident in self._adversary.plan(sorted(self._vessels)):
            self._befall(now, incident)
        self._orders.blow(now)
        self._speak(now, tick)
        answers = self._hear_and_act(now)
        self._ocean.follow(answers)
        for commands in answers:
            self._sea._said[commands.ids] = now
            self._watch.note(commands, now)
        self._sea._stop_the_silent()
        self._watch.check_before(now, self._ocean, self._log)
        frame = self._ocean.advance()
        self._log.keep(frame)
        for commands in answers:
            self._log.remember(commands.ids, commands.memory)
        self._hash.update(frame.x.tobytes() + frame.y.tobytes())
        self._watch.check_after(frame, self._ocean, self._log)
        demand("messages add up", self._mesh.broken(), None)

    def _befall(self, now: int, incident: Incident) -> None:
        kind, process, amount = incident
        vessel = self._vessels.get(process)
        if vessel is None or (kind == "kill" and not now):
            return
        event = f"{now} {kind} {process} {amount:g}"
        self.events.append(event)
        self._hash.update(event.encode())
        if kind == "kill":
            self._mesh.listen(process, False)
            del self._vessels[process]
            self._watch.lose(now, vessel.ids)
            self._sea._lose(list(vessel.ids))
        elif kind == "restart" and process not in self._saved:
            self._saved[process] = vessel.states() if int(amount) % 4 else {}
            self._mesh.listen(process, False)
            vessel.tick, vessel.away = None, now + amount
        elif kind == "freeze":
            vessel.away = max(vessel.away, now + amount)
        elif kind == "clock":
            vessel.off = amount
        elif kind == "mend":
            vessel.off, vessel.away = 0.0, min(vessel.away, float(now))

    def _speak(self, now: int, tick: Tick) -> None:
        """Let every process that is ready begin its step."""
        time_step = self._scenario.time_step
        said: list[bytes] = []
        ticks: list[Tick] = []
        senders: list[int] = []
        for process, vessel in self._vessels.items():
            if process in self._saved and vessel.away <= now:
                states = self._saved.pop(process)
                vessel.start(states)
                self._orders.start(process, vessel, now, anew=not states)
                demand("a restart goes on from what was", states in ({}, vessel.states()), True)
                self._ears[process] = self._ear()
                self._mesh.listen(process, True)
            if process in self._saved:
                continue
            spoke = vessel.speak(tick)
            if spoke is None or vessel.tick is None:
                continue
            if vessel.tick.step % self._scenario.report_steps:
                demand("nobody speaks between reports", spoke, [])
                continue
            demand("every buoy speaks", len(spoke), len(vessel.tick.readings))
            said += spoke
            ticks.append(vessel.tick)
            senders += [process] * len(spoke)
        if said:
            readings = together(ticks)
            steps = [each.step for each in ticks for _ in each.readings]
            meant = truths(said, readings, steps, self._told, time_step)
            parcels = list(map(Parcel, said, readings["id"].tolist(), meant, steps))
            self._mesh.publish(float(now), parcels, senders)
        self._mesh.disturb(now, time_step, tuple(0.0 for _ in self._told))

    def _hear_and_act(self, now: int) -> list[Commands]:
        """Let every process hear what arrived, and decide, in the order of time."""
        decided: list[_Decided] = []
        ready = [(vessel.acts_at, process) for process, vessel in self._vessels.items()]
        for at, process in sorted(ready):
            vessel, ear = self._vessels[process], self._ears[process]
            tick = vessel.tick
            if tick is None or vessel.away > now:
                continue
            parcels = self._mesh.take(process, max(float(now), min(at, now + 1.0)))
            self._orders.deliver(process, vessel, now)
            commands = vessel.acts(now, parcels)
            ear.take(parcels, tick.step)
            ear.check_counts(vessel.aboard.inbox)
            if commands is None:
                continue
            demand("every buoy decides", [len(each.ids) for each in vessel.thoughts], [len(tick.readings)])
            heard, under = ear.hears(tick, self._spoken(tick)), self._orders.check(process, vessel, tick.step)
            decided.append(_Decided(tick, vessel.thoughts[0], commands, heard, under))
            ear.forget(tick.step)
            ear.check_kept(vessel.aboard.inbox)
            self._hash.update(commands.wants.tobytes())
            self.decisions += len(commands.ids)
        if decided:
            self._check(decided)
        if self._adversary.calm > RECOVERY:
            demand("after a calm everybody decides", len(decided), len(self._vessels))
        return [each.commands for each in decided]

    def _spoken(self, tick: Tick) -> int:
        """The step at which was said what is heard in a step, if nothing is late."""
        arrived = tick.step - self._scenario.network.delay
        return arrived - arrived % self._scenario.report_steps

    def _check(self, decided: list[_Decided]) -> None:
        """Every decision of a step is what it must be."""
        ticks, thoughts, commands, heard, under = zip(*decided, strict=True)
        windows = [(self._spoken(tick) - self._setting.max_age, self._spoken(tick)) for tick in ticks]
        nearest = check_thoughts(thoughts, ticks, heard, self._neighbors, windows, self._scenario.time_step)
        check_commands(commands, thoughts, self._speeds, {id: word for each in under for id, word in each.items()})
        doubts: dict[int, list[Doubt]] = {}
        begin = 0
        for tick, thought, *_ in decided:
            one = tick.step // SECOND % len(thought.ids)
            if tick.step % SECOND == 0:
                about = (each[one] for each in (thought.before, thought.wants, thought.after))
                doubt = Doubt(thought.ids[one], thought.readings[one], nearest[begin + one], *about)
                doubts.setdefault(tick.step, []).append(doubt)
            begin += len(thought.ids)
        for step, those in doubts.items():
            self._second.check(those, step)
        if self._adversary.calm > RECOVERY:
            for tick, each in zip(ticks, heard, strict=True):
                if self._spoken(tick) >= 0:
                    there = ~np.isnan(each.tables[:, :-1, 0]).all(axis=0)
                    demand("after a calm everybody is heard", int(there[tick.alive].sum()), int(tick.alive.sum()))

    def _ear(self) -> Ear:
        scenario, max_age = self._scenario, self._setting.max_age
        ear = KeptEar if scenario.network.max_age else Ear
        kept = scenario.network.delay + scenario.report_steps + max_age
        return ear(scenario.agents, len(self._told), kept, max_age)


def soak(seed: int, source: Source = "oceans2020", steps: int = STEPS) -> Outcome:
    """Soak the fleet of a scenario under the adversary of a seed.

    Parameters
    ----------
    seed : decides every bit of it; source : the scenario; steps : how long it takes

    Raises
    ------
    ScenarioError, StrategyError : as Ocean
    """
    return Soak(seed, source, steps).run()
