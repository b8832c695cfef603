"""The buoys that one process runs, and what reached it: without clock, socket or body, so that anything can drive them.

Every step in this order: `hear` what the mesh brought, `speak`, `hear` until enough is there, `act` once.
"""

from collections.abc import Iterable, Sequence
from contextlib import suppress
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.buoy.buoy import Buoy
from shoal.buoy.hearing import Hearing
from shoal.buoy.inbox import Inbox
from shoal.buoy.orderbook import Orderbook
from shoal.buoy.relay import Relay
from shoal.buoy.rows import Floats, row_of, write
from shoal.buoy.said import Said
from shoal.buoy.tether import Commands, Tick, numbers_of, readings_of
from shoal.core.errors import ShoalError
from shoal.core.links import MOST_LINKED
from shoal.core.messages import Reading
from shoal.scenario.commands import Command
from shoal.scenario.crew import crew_of
from shoal.scenario.load import Source, load

Reaches = npt.NDArray[np.bool_] | None  # (n, m) which of m reports reached each of n buoys; None: all


class Aboard:
    """Some buoys of a scenario, one process, one inbox.

    Parameters
    ----------
    scenario : what the whole swarm is told
    ids : which agents they are
    run : number of the replicate
    max_age : steps that a report may be old to be heard, beside the delay of the scenario's radios; default: the
        scenario's network.max_age
    relays : whether they pass on what they hear, over network.hops hops: where a mesh does not reach all by itself

    Attributes
    ----------
    scenario, ids : as given; present : those of them that are there
    inbox : what reached them
    orderbook : the orders that did; None: they have no key, and obey none that comes over the mesh

    Raises
    ------
    ScenarioError, StrategyError : as Buoy
    """

    def __init__(
        self, scenario: Source, ids: Sequence[int], *, run: int = 0, max_age: int | None = None, relays: bool = False
    ) -> None:
        self.scenario = scenario = load(scenario)
        self.ids = self.present = tuple(ids)
        self.orderbook: Orderbook | None = None
        self._ordered: list[Command] = []
        self.unread = 0  # orders that came without a key to open them
        self.buoys = Buoy.several(scenario, ids, run=run)
        self._delay, self._interval = scenario.network.delay, scenario.report_steps
        self._agents, self._told = scenario.agents, crew_of(scenario).told
        self._max_age = scenario.network.max_age if max_age is None else max_age
        kept = self._delay + self._interval + self._max_age
        self.inbox = Inbox(scenario.agents, self._told, scenario.time_step, kept)
        self._relay = Relay(self.ids, scenario.network.hops if relays else 1)
        self._keeps = scenario.network.max_age > 0
        self._hearing = {id: Hearing(self._max_age) for id in ids}
        self._before: tuple[dict[int, tuple[Any, Hearing]], list[Command]] = {}, []

    def warm(self) -> None:
        """Decide once, so that what must be compiled is, and forget it."""
        buoy, reading = self.buoys[self.ids[0]], Reading(0.0, 0.0, 0.0, 0.0, False)
        state = buoy.state
        said = Said([row_of(buoy.report(reading, 0)._replace(id=buoy.id + 1))], self._told, 1)
        near = said.nearest(np.array([buoy.id]), np.array([reading], float), [1])
        Buoy.decide_together([buoy], np.array([reading], float), said, near, 0)
        buoy.restore(state)

    def begin(self, tick: Tick) -> Commands:
        """Set up memories where the buoys lie; nothing is wanted yet."""
        for id, reading in readings_of(tick):
            self.buoys[id].begin(reading)
        return self._commands(tick, np.zeros((len(tick.readings), 2)))

    def speak(self, tick: Tick) -> list[bytes]:
        """What they publish at a step; nothing between two reports of a slower radio."""
        if tick.step % self._interval:
            return []
        ids = tick.readings["id"].tolist()
        here = [self.buoys[id] for id in ids]
        said = write(Buoy.report_together(here, numbers_of(tick), tick.step), self._told)
        for id, message in zip(ids, said, strict=False):
            self.inbox.spoke(id, tick.step, message)
        return said

    def hear(self, messages: Iterable[bytes], step: int) -> None:
        """Take what the mesh brought, from its authors or from others who passed it on."""
        self._relay.take(messages, self.inbox, step)

    def relayed(self) -> list[bytes]:
        """What they pass on of what they heard, to be published at once."""
        return self._relay.waiting()

    def heard(self, tick: Tick) -> dict[int, int]:
        """Of whom a report can be heard at a step, and when it was said."""
        return self.inbox.when(self.spoken(tick.step), self._max_age)

    def attend(self, messages: Iterable[bytes], tick: Tick, now: float) -> list[bytes]:
        """Take orders that the mesh brought, to be obeyed from the next step on; return what is to be published.

        Parameters
        ----------
        messages : what arrived; tick : the present step; now : [s since 1970]
        """
        self.present = tuple(tick.readings["id"].tolist())
        if self.orderbook is None:
            self.unread += sum(1 for _ in messages)
            return []
        return [each for data in messages for each in self.orderbook.take(data, self, tick.step + 1, now)]

    def refusal(self, command: Command, id: int) -> str | None:
        """Why a buoy cannot obey a command; None if it can."""
        try:
            self.buoys[id].check(command)
        except ShoalError as error:
            where, problem, _ = error.args
            return f"{where}: {problem}"
        return None

    def order(self, command: Command) -> None:
        """Let buoys that are here obey from the command's step on."""
        self._ordered.append(command)

    def _obey(self, step: int) -> None:
        """Obey what came over the mesh until a step."""
        due = [command for command in self._ordered if command.step <= step]
        self._ordered = [command for command in self._ordered if command.step > step]
        for command in due:
            for id in command.agents:
                self.buoys[id].follow(command.step)  # what the scenario tells them at this step comes first
                with suppress(ShoalError):  # what another order of this step has made impossible
                    self.buoys[id].obey(command)

    def missing(self, tick: Tick) -> set[int]:
        """Whose reports of a step have not arrived."""
        if tick.step % self._interval:
            return set()
        return self.inbox.missing(tick.step, np.flatnonzero(tick.alive).tolist())

    def act(self, tick: Tick) -> Commands:
        """What they want at a step, from what they measure and hear, and are told to do."""
        self._obey(tick.step)
        ids, readings = tick.readings["id"].astype(int), numbers_of(tick)
        here = [self.buoys[id] for id in ids.tolist()]
        for buoy in here:
            buoy.follow(tick.step)
        said, reaches = self._kept(tick) if self._keeps else self._arrived(tick)
        near = said.nearest(ids, readings, [buoy.neighbors for buoy in here], reaches)
        wants = Buoy.decide_together(here, readings, said, near, tick.step)
        self.inbox.forget(tick.step)
        self._relay.forget(tick.step - self._delay - self._interval - self._max_age)
        return self._commands(tick, wants)

    def _arrived(self, tick: Tick) -> tuple[Said, Reaches]:
        """What can be heard where nothing is kept: what was said last, or not long before if it is late; by whom."""
        then = self.spoken(tick.step)
        newest, there = self.inbox.newest(then, self._max_age), tick.alive.tolist()
        rows = [newest[id] for id in sorted(newest) if then != tick.step or there[id]]
        said = Said(rows, self._told, len(tick.readings))
        return said, None if tick.hears is None else tick.hears[:, said.inbox.id]

    def _kept(self, tick: Tick) -> tuple[Said, Reaches]:
        """The newest that each has of the others where reports are kept, whoever is there by now."""
        then, ids = self.spoken(tick.step), tick.readings["id"].tolist()
        held: list[dict[int, tuple[int, bytes]]] = []
        for number, id in enumerate(ids):
            hearing = self._hearing[id]
            if then >= 0:
                hearing.reach(then, tick.alive if tick.hears is None else tick.hears[number])
            held.append(hearing.held(self.inbox, then))
        said = {(id, step): row for each in held for id, (step, row) in each.items()}
        places = {key: place for place, key in enumerate(sorted(said))}
        reaches = np.zeros((len(held), len(places)), bool)
        for number, each in enumerate(held):
            reaches[number, [places[id, step] for id, (step, _) in each.items()]] = True
        return Said([said[key] for key in places], self._told, len(held)), reaches

    def links(self, ids: npt.NDArray[np.int32]) -> npt.NDArray[np.bool_] | None:
        """Whom each of n buoys heard when it decided last, (n, N); None of more agents than links are kept of."""
        if self._agents > MOST_LINKED:
            return None
        heard = np.zeros((len(ids), self._agents), np.bool_)
        for row, id in zip(heard, ids.tolist(), strict=True):
            row[self.buoys[id].whom()] = True
        return heard

    def spoken(self, step: int) -> int:
        """The step at which was said what is heard at a step, if nothing is late: that of the simulator's radio."""
        arrived = step - self._delay
        return arrived - arrived % self._interval

    def mark(self, tick: Tick) -> None:
        """Note how `act` will find the buoys of a tick, to go back to by `undo`."""
        ids = tick.readings["id"].tolist()
        self._before = {id: (self.buoys[id].state, self._hearing[id].copy()) for id in ids}, self._ordered

    def undo(self) -> None:
        """Go back to what was marked: the step begins again."""
        buoys, self._ordered = self._before
        for id, (state, hearing) in buoys.items():
            self.buoys[id].restore(state)
            self._hearing[id] = hearing

    def _commands(self, tick: Tick, wants: Floats) -> Commands:
        ids = tick.readings["id"].astype(np.int32)
        memory = Buoy.memories([self.buoys[id] for id in ids.tolist()])
        return Commands(tick.step, tick.turn, ids, wants, memory)
