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
        self._told = told_class(crew.told)
        self._begin, self._decide = crew.compiled(begin_one, decide_one)
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
        self._begin(me, self.memory, self.crew.params, self._key)

    def decide(self, me: Own, inbox: list[Report], step: int) -> tuple[float, float]:
        """The velocity wanted in a step [m/s]; `inbox` has the reports heard in the order of ids."""
        count = len(inbox)
        told = np.zeros((count + 1, width(self.crew.told)))
        if self.crew.told:
            told[:] = [*(report.told for report in inbox), self.told()]
        said = Inbox(
            np.array([report.id for report in inbox], np.int64),
            np.array([(each.x, each.y, each.vx, each.vy, each.time) for each in inbox], float).reshape(count, 5),
            np.array([report.on_target for report in inbox], np.bool_),
            np.array([report.rank or 0 for report in inbox], np.int64).reshape(count, 1),
            as_records(told, self.crew.told),
        )
        sums = np.zeros((self.crew.sums, 1))
        vx, vy = self._decide(me, said, sums, self.memory, self.crew.params, self._key, step)
        return float(vx), float(vy)
