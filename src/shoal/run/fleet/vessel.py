"""A process of buoys in virtual time: what `shoal.buoy.paced` does by a clock, with neither clock nor tether."""

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

from shoal.buoy.aboard import Aboard
from shoal.buoy.paced import HALF
from shoal.buoy.rows import Floats
from shoal.buoy.said import Near, Said
from shoal.buoy.tether import Commands, Tick
from shoal.run.fleet.virtual_mesh import Parcel
from shoal.scenario.schema import Scenario


class Thought(NamedTuple):
    """What n buoys decided on in a step, and what came of it.

    ids, readings : which, and (n, 8) what they measured
    said, near : what was said, and (n, k, 2) by whom of their neighbors
    wants : (n, 2) velocities [m/s]; before, after : (n, M) their memories
    """

    ids: list[int]
    readings: Floats
    said: Said
    near: Near
    step: int
    wants: Floats
    before: Floats
    after: Floats


class WatchedMinds:
    """Minds of buoys of which somebody sees every thought.

    Parameters
    ----------
    minds : to watch; ids : whose they are; thoughts : where they are kept
    """

    def __init__(self, minds: Any, ids: tuple[int, ...], thoughts: list[Thought]) -> None:
        self._minds, self._ids, self._thoughts = minds, ids, thoughts
        self.told, self.begin, self.numbers, self.recall = minds.told, minds.begin, minds.numbers, minds.recall
        self.memories = minds.memories

    def decide(self, places: list[int], readings: Floats, said: Said, near: Near, step: int) -> Floats:
        """As the minds do.

        Parameters
        ----------
        places, readings, said, near, step : as theirs
        """
        before = self.memories(places)
        wants: Floats = self._minds.decide(places, readings, said, near, step)
        ids, after = [self._ids[place] for place in places], self.memories(places)
        self._thoughts.append(Thought(ids, readings, said, near, step, wants, before, after))
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
        buoys = self.aboard.buoys
        minds = WatchedMinds(buoys[self.ids[0]]._minds, self.ids, self.thoughts)
        for id, buoy in buoys.items():
            buoy._minds = minds
            if id in states:
                buoy.restore(states[id])

    def states(self) -> dict[int, Any]:
        """What its buoys would go on from."""
        return {id: buoy.state for id, buoy in self.aboard.buoys.items()}

    def speak(self, tick: Tick) -> list[bytes] | None:
        """Begin a step, unless it is in one, or has done this one by its own clock: what is published."""
        step = max(tick.step, math.floor(tick.step + self.off))
        if self.tick is not None or step == self.done or tick.step < self.away:
            return None
        self.tick = tick.of(self.ids)._replace(step=step)
        self.acts_at = max(float(tick.step), min(step - self.off, float(tick.step)) + HALF)
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
