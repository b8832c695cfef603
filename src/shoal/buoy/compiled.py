"""The minds of several agents compiled by numba: the functions of the engine."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from shoal.buoy.rows import Floats
from shoal.buoy.said import Near, Said
from shoal.core.agents import as_records, width
from shoal.core.messages import Own, Reading
from shoal.core.wire import told_class
from shoal.scenario.crew import Crew
from shoal.strategies.one_agent import Room, begin_one, decide_several, key_of_run


class CompiledMinds:
    """What agents remember, and how they decide; see PlainMinds."""

    def __init__(self, crew: Crew, seed: int, run: int, selves: Sequence[Own]) -> None:
        self.crew = crew
        self._numbers = np.zeros((len(selves), width(crew.memory)))
        memory = as_records(self._numbers, crew.memory)
        self._memory = np.asarray(memory)  # numba takes records as they come from `as_records`, too, but slowly
        self._fields, self._tells = len(crew.memory), len(crew.told)
        self._told = told_class(crew.told)
        self._begin, self._decide = crew.compiled(begin_one, decide_several)
        self._key = np.uint64(key_of_run(np.uint64(seed), run))
        self._sums = np.zeros((crew.sums, 1))
        self._selves = np.zeros((len(selves), 21))
        for row, me in zip(self._selves, selves, strict=True):
            row[8:] = [me.id, me.max_speed, me.time_step, me.fleet, *me.briefing]

    def numbers(self, place: int) -> tuple[float, ...]:
        """Every field of the memory of one, in their order."""
        return tuple(self._numbers[place, : self._fields].tolist())

    def memories(self, places: Sequence[int]) -> Floats:
        """The memory of several, (n, M)."""
        return self._numbers[places, : self._fields]

    def recall(self, place: int, numbers: tuple[float, ...]) -> None:
        """Let one remember these numbers, in the order of the fields."""
        self._numbers[place, : self._fields] = numbers

    def told(self, place: int) -> Any:
        """What reports of one tell of its memory, which begins with it."""
        return self._told(*self._numbers[place, : self._tells].tolist())

    def begin(self, place: int, reading: Reading) -> None:
        """Set the memory of one up."""
        self._selves[place, :8] = reading
        self._begin(place, self._selves, self._memory, self.crew.params, self._key)

    def decide(self, places: Sequence[int], readings: Floats, said: Said, near: Near, step: int) -> Floats:
        """The velocities that some of them want in a step, (n, 2) [m/s].

        Parameters
        ----------
        places : n of them; readings : (n, 8) what their instruments say
        said, near : what is said, and (n, k, 2) by whom of their neighbors
        step : its number
        """
        rows, wants = np.array(places), np.empty((len(places), 2))
        self._selves[rows, :8] = readings
        if self._tells:
            first = len(said.numbers)
            said.tells[first : first + len(rows), : self._tells] = self._numbers[rows, : self._tells]
        room = Room(self._sums, wants)
        self._decide(rows, self._selves, said.inbox, near, self._memory, self.crew.params, (self._key, step), room)
        return wants
