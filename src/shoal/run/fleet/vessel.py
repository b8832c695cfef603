"""A process of buoys in virtual time: what `shoal.buoy.paced` does by a clock, with neither clock nor tether."""

import math
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

from shoal.buoy import inbox
from shoal.buoy.aboard import Aboard
from shoal.buoy.paced import HALF
from shoal.buoy.tether import Commands, Tick
from shoal.core.messages import Own, Report
from shoal.run.fleet.virtual_mesh import Parcel
from shoal.scenario.schema import Scenario

_MANY = 4_000  # reports that are remembered as they were read


@contextmanager
def reading_once() -> Iterator[None]:
    """Until the block ends, bytes that reach several inboxes are read once: they say the same to all of them."""
    known: dict[bytes, Report] = {}

    class Once:
        @staticmethod
        def from_bytes(data: bytes, told: tuple[str, ...]) -> Report:
            report = known.get(data)
            if report is None:
                if len(known) > _MANY:
                    known.clear()
                report = known[data] = Report.from_bytes(data, told)
            return report

    reader: Any = inbox
    reader.Report = Once
    try:
        yield
    finally:
        reader.Report = Report


class Thought(NamedTuple):
    """What a buoy decided on, and what came of it: velocities [m/s]."""

    me: Own
    heard: list[Report]
    step: int
    wants: tuple[float, float]


class WatchedMind:
    """A buoy's mind of which somebody sees every thought.

    Parameters
    ----------
    mind : to watch; thoughts : where they are kept
    """

    def __init__(self, mind: Any, thoughts: list[Thought]) -> None:
        self._mind, self._thoughts = mind, thoughts
        self.told, self.begin, self.remembered, self.recall = mind.told, mind.begin, mind.remembered, mind.recall

    def decide(self, me: Own, heard: list[Report], step: int) -> tuple[float, float]:
        """As the mind does."""
        wants: tuple[float, float] = self._mind.decide(me, heard, step)
        self._thoughts.append(Thought(me, heard, step, wants))
        return wants


class Vessel:
    """Some buoys, and the clock that they go by.

    Parameters
    ----------
    scenario : of the fleet; ids : which agents they are; max_age : steps that a report may be old to be heard

    Attributes
    ----------
    off : steps by which its clock is ahead; away : the step until which it is frozen or down
    tick : with which the step began that it has not yet decided in; acts_at : when it will [steps]
    done : the last step that it decided in, by its own clock
    thoughts : of its last decisions
    """

    def __init__(self, scenario: Scenario, ids: Iterable[int], max_age: int) -> None:
        self._scenario, self._max_age = scenario, max_age
        self.ids = tuple(ids)
        self.off, self.away = 0.0, 0.0
        self.thoughts: list[Thought] = []
        self.start({})

    def start(self, states: dict[int, Any]) -> None:
        """Start anew, with an empty inbox, and buoys that go on from these states or set their memories up again."""
        self.aboard = Aboard(self._scenario, self.ids, max_age=self._max_age)
        self.tick: Tick | None = None
        self.acts_at, self.done = math.inf, -1
        for id, buoy in self.aboard.buoys.items():
            buoy._mind = WatchedMind(buoy._mind, self.thoughts)
            if id in states:
                buoy.restore(states[id])

    def states(self) -> dict[int, Any]:
        """What its buoys would go on from."""
        return {id: buoy.state for id, buoy in self.aboard.buoys.items()}

    def speak(self, tick: Tick) -> list[bytes] | None:
        """Begin a step, unless it is in one, or is further by its own clock: what is published."""
        if self.tick is not None or tick.step <= self.done or tick.step < self.away:
            return None
        step = max(tick.step, math.floor(tick.step + self.off))
        self.tick = tick._replace(step=step)
        self.acts_at = max(float(tick.step), step + HALF - self.off)
        return self.aboard.speak(self.tick)

    def acts(self, now: int, parcels: list[Parcel]) -> Commands | None:
        """Hear what arrived, and decide if it is time, before step `now` + 1 begins, or if everybody is heard."""
        assert self.tick is not None
        self.aboard.hear([parcel.data for parcel in parcels], self.tick.step)
        if self.acts_at >= now + 1 and self.aboard.missing(self.tick):
            return None
        self.thoughts.clear()
        commands = self.aboard.act(self.tick)
        self.done, self.tick, self.acts_at = self.tick.step, None, math.inf
        return commands
