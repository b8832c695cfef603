"""One agent alone: it listens to an inbox and decides, compiled from the functions that the engine is compiled from."""

from typing import Any, NamedTuple

import numpy as np

from shoal.compiler.kernel import entry_kernel, kernel
from shoal.core.draws import START_STEP, split
from shoal.core.messages import Briefing, Heard, Own, Report, Truth
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


@entry_kernel
def key_of_run(seed, run):
    """The key that all chance of a run lies below."""
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
    briefing = Briefing(0, 0.0, 0.0, 0.0, 0.0, 0.0, False, 0.0, 0.0)
    truth = Truth(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return Own(
        me.id,
        me.x,
        me.y,
        me.vx,
        me.vy,
        me.on_target,
        me.max_speed,
        me.time_step,
        me.time,
        me.fleet,
        briefing,
        truth,
        0.0,
        0.0,
        False,
    )
