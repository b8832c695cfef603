"""Minds in plain Python: for computers without numba, and to read."""

import math
from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np

from shoal.buoy.rows import Floats
from shoal.buoy.said import Near, Said
from shoal.core.draws import START_STEP, split
from shoal.core.messages import Briefing, Heard, Own, Reading, Report, Truth
from shoal.core.wire import told_class
from shoal.scenario.crew import Crew
from shoal.strategies import asking

NO_BRIEFING = Briefing(0, 0.0, 0.0, 0.0, 0.0, 0.0)
NO_TRUTH = Truth(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class PlainMind:
    """What one agent remembers, and how it decides."""

    def __init__(self, crew: Crew, seed: int, run: int) -> None:
        self.crew = crew
        self.memory = _record(crew.memory)()
        self._told = told_class(crew.told)
        self._key = split(split(seed, 0), run)

    def numbers(self) -> tuple[float, ...]:
        """Every field of the memory, in their order."""
        return tuple(getattr(self.memory, name) for name in self.crew.memory)

    def recall(self, numbers: tuple[float, ...]) -> None:
        """Remember these numbers, in the order of the fields."""
        for name, number in zip(self.crew.memory, numbers, strict=True):
            setattr(self.memory, name, number)

    def told(self) -> Any:
        """What reports tell of the memory."""
        return self._told(*(getattr(self.memory, name) for name in self.crew.told))

    def begin(self, me: Own) -> None:
        """Set the memory up."""
        asking.begin(me, self.memory, self.crew.params, split(split(self._key, START_STEP), me.id))

    def decide(self, me: Own, inbox: list[Report], step: int) -> tuple[float, float]:
        """The velocity wanted in a step [m/s]; `inbox` has the reports heard in the order of ids."""
        params = self.crew.params
        listener = me._replace(  # pairs know no more, in the engine too
            briefing=NO_BRIEFING, truth=NO_TRUTH, drift_x=0.0, drift_y=0.0, aground=False
        )
        sums, leader, lowest = [0.0] * self.crew.sums, None, math.inf
        sums_up = asking.has_influence(params)
        for other in inbox:
            if sums_up:
                for number, value in enumerate(asking.influence(listener, other, params)):
                    sums[number] += value
            if asking.leads(other, params):
                priority = asking.priority(listener, other, params)
                if priority < lowest:
                    leader, lowest = other, priority
        found = leader is not None
        said: Any = leader or me
        told = leader.told if leader else self.told()
        heard = Heard(found, said.x, said.y, said.vx, said.vy, said.on_target, 0.0, 0.0, len(inbox), told, tuple(sums))
        vx, vy = asking.decide(me, heard, self.memory, params, split(split(self._key, step), me.id))
        return float(vx), float(vy)


class PlainMinds:
    """Those of several agents.

    Parameters
    ----------
    crew : what runs; seed, run : decide all chance
    selves : the agents, as they know themselves before anything is measured
    """

    def __init__(self, crew: Crew, seed: int, run: int, selves: Sequence[Own]) -> None:
        self._selves = selves
        self._minds = [PlainMind(crew, seed, run) for _ in selves]

    def numbers(self, place: int) -> tuple[float, ...]:
        """Every field of the memory of one, in their order."""
        return self._minds[place].numbers()

    def memories(self, places: Sequence[int]) -> Floats:
        """The memory of several, (n, M)."""
        return np.array([self._minds[place].numbers() for place in places], float)

    def recall(self, place: int, numbers: tuple[float, ...]) -> None:
        """Let one remember these numbers, in the order of the fields."""
        self._minds[place].recall(numbers)

    def told(self, place: int) -> Any:
        """What reports of one tell of its memory."""
        return self._minds[place].told()

    def begin(self, place: int, reading: Reading) -> None:
        """Set the memory of one up."""
        self._minds[place].begin(self._own(place, reading, 0))

    def decide(self, places: Sequence[int], readings: Floats, said: Said, near: Near, step: int) -> Floats:
        """The velocities that some of them want in a step, (n, 2) [m/s].

        Parameters
        ----------
        places : n of them; readings : (n, 8) what their instruments say
        said, near : what is said, and (n, k, 2) by whom of their neighbors
        step : its number
        """
        wants = np.empty((len(places), 2))
        for n, (place, reading, its) in enumerate(zip(places, readings.tolist(), near, strict=True)):
            mind = self._minds[place]
            try:
                wants[n] = mind.decide(self._own(place, reading, step), said.heard(its, mind.crew.ranked), step)
            except (ZeroDivisionError, OverflowError):  # compiled code would go on with infinity
                wants[n] = math.nan
        return wants

    def _own(self, place: int, reading: Sequence[float], step: int) -> Own:
        """The agent as it knows itself: with plain numbers, wherever they come from."""
        me = self._selves[place]
        x, y, vx, vy, on_target, drift_x, drift_y, aground = map(float, reading)
        return me._replace(
            x=x,
            y=y,
            vx=vx,
            vy=vy,
            on_target=bool(on_target),
            time=step * me.time_step,
            drift_x=drift_x,
            drift_y=drift_y,
            aground=bool(aground),
        )


@cache
def _record(fields: tuple[str, ...]) -> type[Any]:
    """A class with these fields and no others, each a double, as the engine's records have them."""

    class Memory:
        __slots__ = fields

        def __init__(self) -> None:
            for name in fields:
                setattr(self, name, 0.0)

        def __setattr__(self, name: str, value: float) -> None:
            object.__setattr__(self, name, float(value))

    return Memory
