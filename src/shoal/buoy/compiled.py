"""A strategy's mind compiled by numba: the functions of the engine, for one agent."""

from typing import Any, NamedTuple

import numpy as np

from shoal.compiler.kernel import entry_kernel, kernel, uncached
from shoal.core.agents import as_records, width
from shoal.core.draws import START_STEP, split
from shoal.core.messages import Briefing, Heard, Own, Report, Truth
from shoal.core.wire import told_class
from shoal.scenario.crew import Crew
from shoal.strategies import contract


class Inbox(NamedTuple):
    """n reports in the order of ids. The row behind them is what the agent itself tells.

    id, rank : (n,) and (n, 1); numbers : (n, 5) x, y, vx, vy, time; on_target : (n,); told : (n + 1,)
    """

    id: Any
    numbers: Any
    on_target: Any
    rank: Any
    told: Any


class CompiledMind:
    """What one agent remembers, and how it decides; see PlainMind."""

    def __init__(self, crew: Crew, seed: int, run: int) -> None:
        self.crew = crew
        self._numbers = np.zeros((1, width(crew.memory)))
        self.memory = as_records(self._numbers, crew.memory)
        self._told = told_class(crew.told)
        self._begin, self._decide = _entry_points(crew)
        self._key = np.uint64(_key_of_run(np.uint64(seed), run))

    def remembered(self) -> dict[str, float]:
        """Every field of the memory by name."""
        return dict(zip(self.crew.memory, self._numbers[0].tolist(), strict=False))

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


_UNCACHED: dict[Any, tuple[Any, Any]] = {}


def _entry_points(crew: Crew) -> tuple[Any, Any]:
    """The compiled functions: from the cache for our own strategies, fresh ones for a user's."""
    if crew.builtin:
        return begin_one, decide_one
    kind = tuple(each.params for each in crew.strategies)
    if kind not in _UNCACHED:
        _UNCACHED[kind] = (uncached(begin_one), uncached(decide_one))
    return _UNCACHED[kind]


@entry_kernel
def _key_of_run(seed, run):
    return split(split(seed, 0), run)


@entry_kernel
def begin_one(me, memory, params, key):
    """Set up the memory (1,) of one agent; `key` is that of the run."""
    contract.begin(me, memory[0], params, split(split(key, START_STEP), me.id))


@entry_kernel
def decide_one(me, inbox, sums, memory, params, key, step):
    """The velocity that one agent wants; sums (S, 1) are zero and have room for those of its strategy."""
    listener = _listener(me)
    count = inbox.id.size
    leader = -1
    lowest = np.inf
    for j in range(count):
        x, y, vx, vy = inbox.numbers[j, 0], inbox.numbers[j, 1], inbox.numbers[j, 2], inbox.numbers[j, 3]
        rank = contract.rank_of(inbox.rank, j, 0, params)
        other = Report(inbox.id[j], x, y, vx, vy, inbox.on_target[j], inbox.told[j], inbox.numbers[j, 4], rank)
        if contract.has_influence(params):
            contract.add(sums, 0, contract.influence(listener, other, params), True)
        if contract.leads(other, params):
            priority = contract.priority(listener, other, params)
            if priority < lowest:
                leader = j
                lowest = priority
    found = leader >= 0
    x, y, vx, vy, on_target = me.x, me.y, me.vx, me.vy, me.on_target
    if found:
        x, y, vx, vy = (
            inbox.numbers[leader, 0],
            inbox.numbers[leader, 1],
            inbox.numbers[leader, 2],
            inbox.numbers[leader, 3],
        )
        on_target = inbox.on_target[leader]
    heard = Heard(found, x, y, vx, vy, on_target, 0.0, 0.0, count, inbox.told[leader if found else count], sums[:, 0])
    return contract.decide(me, heard, memory[0], params, split(split(key, step), me.id))


@kernel
def _listener(me):
    """The agent as far as pairs know it: without briefing and truth, in the engine too."""
    briefing = Briefing(0, 0.0, 0.0, 0.0, 0.0, 0.0)
    truth = Truth(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return Own(
        me.id, me.x, me.y, me.vx, me.vy, me.on_target, me.max_speed, me.time_step, me.time, me.fleet, briefing, truth
    )
