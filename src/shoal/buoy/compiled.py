"""A strategy's mind compiled by numba: the functions of the engine, for one agent."""

from typing import Any

import numpy as np

from shoal.core.agents import as_records, width
from shoal.core.messages import Own, Report
from shoal.core.wire import told_class
from shoal.scenario.crew import Crew
from shoal.strategies.one_agent import Inbox, begin_one, decide_one, key_of_run


class CompiledMind:
    """What one agent remembers, and how it decides; see PlainMind."""

    def __init__(self, crew: Crew, seed: int, run: int) -> None:
        self.crew = crew
        self._numbers = np.zeros((1, width(crew.memory)))
        self.memory = as_records(self._numbers, crew.memory)
        self._plain = np.asarray(self.memory)  # numba takes records as they come from `as_records`, too, but slowly
        self._told = told_class(crew.told)
        self._begin, self._decide = crew.compiled(begin_one, decide_one)
        self._rooms: dict[int, tuple[Inbox, Any, Any]] = {}  # by how many were heard
        self._key = np.uint64(key_of_run(np.uint64(seed), run))

    def remembered(self) -> dict[str, float]:
        """Every field of the memory by name."""
        return dict(zip(self.crew.memory, self._numbers[0].tolist(), strict=False))

    def recall(self, numbers: tuple[float, ...]) -> None:
        """Remember these numbers, in the order of the fields."""
        self._numbers[0, : len(numbers)] = numbers

    def told(self) -> Any:
        """What reports tell of the memory, which begins with it."""
        return self._told(*self._numbers[0, : len(self.crew.told)].tolist())

    def begin(self, me: Own) -> None:
        """Set the memory up."""
        self._begin(me, self._plain, self.crew.params, self._key)

    def decide(self, me: Own, inbox: list[Report], step: int) -> tuple[float, float]:
        """The velocity wanted in a step [m/s]; `inbox` has the reports heard in the order of ids."""
        count = len(inbox)
        room = self._rooms.get(count) or self._rooms.setdefault(count, self._room(count))
        said, told, sums = room
        if count:
            said.id[:] = [each.id for each in inbox]
            said.numbers[:] = [(each.x, each.y, each.vx, each.vy, each.time) for each in inbox]
            said.on_target[:] = [each.on_target for each in inbox]
            if self.crew.ranked:
                said.rank[:, 0] = [each.rank for each in inbox]
        if self.crew.told:
            told[:] = [*(each.told for each in inbox), self.told()]
        sums[:] = 0.0
        vx, vy = self._decide(me, said, sums, self._plain, self.crew.params, self._key, step)
        return float(vx), float(vy)

    def _room(self, count: int) -> tuple[Inbox, Any, Any]:
        """Memory for so many reports, for what is told in it, and for sums."""
        told = np.zeros((count + 1, width(self.crew.told)))
        said = Inbox(
            np.zeros(count, np.int64),
            np.zeros((count, 5)),
            np.zeros(count, np.bool_),
            np.zeros((count, 1), np.int64),
            np.asarray(as_records(told, self.crew.told)),
        )
        return said, told, np.zeros((self.crew.sums, 1))
