"""What each agent knows between two steps, as numbers in an array: of itself, of the nearest whom it hears, of memory.

Listeners are taken in blocks of WIDTH, as lanes: those that hear a speaker are bits of a word, and how many of those
heard are nearer is counted for all lanes at once. That sorts without a branch.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.compiler.kernel import kernel
from shoal.compiler.lanes import WIDTH, either, everywhere, put, take, truths
from shoal.core.agents import Floats
from shoal.engine.arrivals import said_by

# What an agent may know of itself and of a report.
OWN = ("x", "y", "vx", "vy", "on_target", "max_speed", "drift_x", "drift_y", "aground")
REPORT = ("heard", "dx", "dy", "vx", "vy", "on_target")


class Block(NamedTuple):
    """Scratch of the agents that are observed together, as lanes.

    who : (WIDTH,) their indices; heard : (WIDTH,) how many each hears
    speaker, hears : (N,) those whom any of them may hear, and which of them do, a bit per lane
    near : (WIDTH, N) whom each hears; square, rank : (N, WIDTH) how far away [m^2], and how many of these are nearer
    """

    who: npt.NDArray[np.int64]
    heard: npt.NDArray[np.int64]
    speaker: npt.NDArray[np.int64]
    hears: npt.NDArray[np.int64]
    near: npt.NDArray[np.int64]
    square: Floats
    rank: Floats


class Seen(NamedTuple):
    """Where it is written what agents know, (E, N, F), and of what that is made.

    there : (E, N) whether an agent is there; of others all numbers are 0
    own, report : which of OWN and REPORT, in their order, a bit each; memory : the columns of it
    slots : of how many reports; width : how many numbers of each
    per_length [1/m], per_speed [s/m] : 1 / what counts as 1
    most : no number is farther from 0, but what is remembered
    """

    observations: npt.NDArray[np.float32]
    there: npt.NDArray[np.bool_]
    own: int
    report: int
    memory: npt.NDArray[np.int64]
    slots: int
    width: int
    per_length: float
    per_speed: float
    most: float
    block: Block


def new_block(agents: int) -> Block:
    """Scratch for a swarm of so many agents."""
    return Block(
        who=np.zeros(WIDTH, np.int64),
        heard=np.zeros(WIDTH, np.int64),
        speaker=np.zeros(agents, np.int64),
        hears=np.zeros(agents, np.int64),
        near=np.zeros((WIDTH, agents), np.int64),
        square=np.zeros((agents, WIDTH)),
        rank=np.zeros((agents, WIDTH)),
    )


@kernel
def observe(parts, arrived, e, seen):
    """Write what each agent of swarm e knows; nearest reports first, of those equally far the lower index."""
    swarm, links, agents, block = parts.swarm, parts.scratch.links, parts.world.agents, seen.block
    for first in range(0, agents, WIDTH):
        if links.silent.size == 0:
            speakers = _hear_by_distance(links, first, agents, block)
        else:
            speakers = _hear_by_lists(links.lists, first, agents, block)
        for lane in range(WIDTH):
            there = block.who[lane] < agents
            block.heard[lane] = _list(block.near[lane], block.speaker, block.hears, speakers, lane) if there else 0
            _measure(swarm, arrived, block.near[lane], lane, block)
        _rank(block)
        for lane in range(WIDTH):
            if block.who[lane] < agents:
                _write(swarm, arrived, e, lane, seen)


@kernel
def _hear_by_distance(links, first, agents, block):
    """Note who is heard by any of the agents from `first` on; returns how many to look at."""
    reach = take(links.reach, first, everywhere(0.0))
    for lane in range(WIDTH):
        block.who[lane] = first + lane
    for j in range(agents):
        block.speaker[j] = j
        block.hears[j] = truths(take(links.square, (j, first), reach) <= reach)
    return agents


@kernel
def _hear_by_lists(lists, first, agents, block):
    """The same of the agents at places from `first` on, where lists say whom each hears."""
    begin, end = lists.begins[first // WIDTH], lists.begins[first // WIDTH + 1]
    for lane in range(WIDTH):
        block.who[lane] = lists.cells.order[first + lane] if first + lane < agents else agents
    for c in range(begin, end):
        block.speaker[c - begin] = lists.cells.order[lists.near[c]]
        block.hears[c - begin] = lists.hears[c]
    return end - begin


@kernel
def _list(near, speaker, hears, speakers, lane):
    """List whom a lane hears of so many speakers; returns how many."""
    count = np.uint64(0)  # unsigned: else numba asks at every index whether it counts from the end
    for n in range(speakers):
        near[count] = speaker[n]
        count += np.uint64((hears[n] >> lane) & 1)
    return int(count)


@kernel
def _measure(swarm, arrived, near, lane, block):
    """Measure how far away those are whom a lane hears, by what they say."""
    i = block.who[lane]
    for c in range(block.heard[lane]):
        x, y, _, _, _ = said_by(arrived, near[c], i)
        dx, dy = x - swarm.fix_x[i], y - swarm.fix_y[i]
        block.square[c, lane] = dx * dx + dy * dy


@kernel
def _rank(block):
    """Count how many of those whom a lane hears are nearer than each of them."""
    most, none = 0, everywhere(0.0)
    for lane in range(WIDTH):
        most = max(most, block.heard[lane])
    for lane in range(WIDTH):
        for c in range(block.heard[lane], most):
            block.square[c, lane] = np.inf
    for c in range(most):
        square, rank = take(block.square, (c, 0), none), none
        for other in range(c):
            rank = either(take(block.square, (other, 0), none) <= square, rank + 1.0, rank)
        for other in range(c + 1, most):
            rank = either(take(block.square, (other, 0), none) < square, rank + 1.0, rank)
        put(block.rank, (c, 0), rank)


@kernel
def _write(swarm, arrived, e, lane, seen):
    """Write what the agent of a lane, of swarm e, knows."""
    block, i = seen.block, seen.block.who[lane]
    row, near = seen.observations[e, i], block.near[lane]
    seen.there[e, i] = swarm.alive[i] > 0.0
    if swarm.alive[i] <= 0.0:
        _clear(row, 0, row.size)
        return
    x, y = swarm.fix_x[i], swarm.fix_y[i]
    first, width, count = _write_oneself(row, swarm, i, seen), seen.width, block.heard[lane]
    last = first + width * seen.slots
    for c in range(count):
        slot = int(block.rank[c, lane])
        if slot < seen.slots:
            _write_report(row[first + width * slot :], said_by(arrived, near[c], i), x, y, seen)
    _clear(row, first + width * min(count, seen.slots), last)
    _write_memory(row, last, swarm.memory[i], seen.memory)


@kernel
def _clear(row, first, last):
    for field in range(first, last):  # rows are arguments of whoever writes: see the trap in compiler/kernel.py
        row[field] = 0.0


@kernel
def _write_memory(row, first, memory, columns):
    for field in range(columns.size):
        row[first + field] = memory[columns[field]]


@kernel
def _write_oneself(row, swarm, i, seen):
    """Write what agent i knows of itself, in the order of OWN; returns how many numbers."""
    own, per_length, per_speed, most, at = seen.own, seen.per_length, seen.per_speed, seen.most, 0
    if own & 1:
        row[at] = _cut(swarm.fix_x[i] * per_length, most)
        at += 1
    if own & 2:
        row[at] = _cut(swarm.fix_y[i] * per_length, most)
        at += 1
    if own & 4:
        row[at] = _cut(swarm.vx[i] * per_speed, most)
        at += 1
    if own & 8:
        row[at] = _cut(swarm.vy[i] * per_speed, most)
        at += 1
    if own & 16:
        row[at] = swarm.on_target[i]
        at += 1
    if own & 32:
        row[at] = swarm.max_speed[i] * per_speed
        at += 1
    if own & 64:
        row[at] = _cut(swarm.drift_x[i] * per_speed, most)
        at += 1
    if own & 128:
        row[at] = _cut(swarm.drift_y[i] * per_speed, most)
        at += 1
    if own & 256:
        row[at] = swarm.aground[i]
        at += 1
    return at


@kernel
def _write_report(row, said, own_x, own_y, seen):
    """Write what a report says, in the order of REPORT; its place as seen from who hears it [m]."""
    x, y, vx, vy, on_target = said
    report, per_length, per_speed, most = seen.report, seen.per_length, seen.per_speed, seen.most
    at, one = np.uint64(0), np.uint64(1)
    if report & 1:
        row[at] = 1.0
        at += one
    if report & 2:
        row[at] = _cut((x - own_x) * per_length, most)
        at += one
    if report & 4:
        row[at] = _cut((y - own_y) * per_length, most)
        at += one
    if report & 8:
        row[at] = _cut(vx * per_speed, most)
        at += one
    if report & 16:
        row[at] = _cut(vy * per_speed, most)
        at += one
    if report & 32:
        row[at] = on_target


@kernel
def _cut(value, most):
    return min(max(value, -most), most)
