"""Some agents alone: they listen and decide, compiled from the functions that the engine is compiled from."""

from typing import Any, NamedTuple

import numpy as np

from shoal.compiler.kernel import entry_kernel, kernel
from shoal.core.draws import START_STEP, split
from shoal.core.messages import Briefing, Heard, Own, Report, Truth
from shoal.strategies import asking


class Inbox(NamedTuple):
    """m reports in the order of ids. The rows behind them are what n listeners tell themselves.

    id : (m,); numbers : (m, 5) x, y, vx, vy, time; on_target : (m,); told : (m + n,)
    """

    id: Any
    numbers: Any
    on_target: Any
    told: Any


class Room(NamedTuple):
    """Where decisions are worked out: sums (S, 1) over neighbors, and what is wanted (n, 2) [m/s]."""

    sums: Any
    wants: Any


@entry_kernel
def key_of_run(seed, run):
    """The key that all chance of a run lies below."""
    return split(split(seed, 0), run)


@entry_kernel
def begin_one(place, selves, memory, params, key):
    """Set up the memory of the agent at a place; `key` is that of the run."""
    me = own_of(selves[place], 0)
    asking.begin(me, memory[place], params, split(split(key, START_STEP), me.id))


@entry_kernel
def decide_several(places, selves, inbox, near, memory, params, when, room):
    """What n agents want in a step, each on what it hears.

    places : (n,) where each is in selves and memory
    selves : (agents, 21) what each knows of itself, see `own_of`
    near : (n, k, 2) its neighbors: rows of the inbox, ascending, and how many of them are nearer; -1: no more
    when : key of the run, and step
    """
    for n in range(places.size):
        me = own_of(selves[places[n]], when[1])
        vx, vy = _decide(me, inbox, near[n], memory, (places[n], inbox.id.size + n), params, when, room.sums)
        room.wants[n, 0] = vx
        room.wants[n, 1] = vy


@kernel
def own_of(numbers, step):
    """An agent as it knows itself, from (21,) numbers: its reading, id, make, and briefing."""
    max_speed, time_step = numbers[9], numbers[10]
    briefing = Briefing(
        int(numbers[12]),
        numbers[13],
        numbers[14],
        numbers[15],
        numbers[16],
        numbers[17],
        numbers[18] > 0.0,
        numbers[19],
        numbers[20],
    )
    truth = Truth(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return Own(
        int(numbers[8]),
        numbers[0],
        numbers[1],
        numbers[2],
        numbers[3],
        numbers[4] > 0.0,
        max_speed,
        time_step,
        step * time_step,
        int(numbers[11]),
        briefing,
        truth,
        numbers[5],
        numbers[6],
        numbers[7] > 0.0,
    )


@kernel
def _decide(me, inbox, near, memory, rows, params, when, sums):
    """The velocity that an agent wants; `rows` : its own of the memory, and of what the inbox tells."""
    listener = _listener(me)
    leader = -1
    lowest = np.inf
    count = 0
    for s in range(sums.shape[0]):
        sums[s, 0] = 0.0
    for n in range(near.shape[0]):
        j = near[n, 0]
        if j < 0:
            break
        count += 1
        x, y, vx, vy = inbox.numbers[j, 0], inbox.numbers[j, 1], inbox.numbers[j, 2], inbox.numbers[j, 3]
        rank = asking.rank_of(near, n, 1, params)
        other = Report(inbox.id[j], x, y, vx, vy, inbox.on_target[j], inbox.told[j], inbox.numbers[j, 4], rank)
        if asking.has_influence(params):
            asking.add(sums, 0, asking.influence(listener, other, params), True)
        if asking.leads(other, params):
            priority = asking.priority(listener, other, params)
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
    told = inbox.told[leader if found else rows[1]]
    heard = Heard(found, x, y, vx, vy, on_target, 0.0, 0.0, count, told, sums[:, 0])
    return asking.decide(me, heard, memory[rows[0]], params, split(split(when[0], when[1]), me.id))


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
