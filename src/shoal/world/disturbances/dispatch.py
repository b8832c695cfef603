"""When each disturbance acts, and the kind that is asked for it: kernels chained once, one link per kind."""

import math
from typing import Any

from shoal.compiler.kernel import kernel
from shoal.core.draws import START_STEP, TARGET_STREAM, split
from shoal.world.disturbances.catalogue import KINDS
from shoal.world.disturbances.contract import NOT_BEGUN, Around
from shoal.world.presence import is_there

_STREAM = 1 << 34  # of keys that neither agents, targets nor the radio draw from


@kernel
def disturb(nature, swarm, targets, world, number, run_key):
    """Let every disturbance say what it does in step `number`; once per step, however often it is asked.

    Who looks at the state between two calls asks before the coming step does; so a run may be cut anywhere.
    """
    if nature.clock[0] == number:
        return
    if nature.clock[0] == NOT_BEGUN:
        _begin_all(nature.disturbances, nature.effects, nature.memory, swarm, world, run_key)
    nature.clock[0] = number
    _calm(nature.effects, swarm, targets, world)
    for d in range(nature.disturbances.size):
        chance = split(split(run_key, START_STEP), _STREAM + d)
        time = number * world.time_step
        around = Around(number, world.agents, world.time_step, time, world.half_x, world.half_y, chance)
        key = split(split(run_key, number), _STREAM + d)
        _act(nature.disturbances[d], around, key, nature.effects, nature.memory[d], swarm, targets)
    nature.clock[1] |= 0 if _take_effect(nature.effects, swarm, targets, world, number) else 1


@kernel
def _begin_all(disturbances, effects, memory, swarm, world, run_key):
    """Set up what is remembered of every agent."""
    _copy(effects, swarm, world)
    for d in range(disturbances.size):
        key = split(split(run_key, START_STEP), _STREAM + d)
        for i in range(world.agents):
            _begin(effects[i], memory[d, i], disturbances[d], split(key, i))


@kernel
def _copy(effects, swarm, world):
    """Let every record say where its agent is."""
    for i in range(world.agents):
        me = effects[i]
        me.id = i
        me.fleet = swarm.fleet[i]
        me.x = swarm.x[i]
        me.y = swarm.y[i]
        me.vx = swarm.vx[i]
        me.vy = swarm.vy[i]


@kernel
def _calm(effects, swarm, targets, world):
    """Nothing is done to anybody yet."""
    _copy(effects, swarm, world)
    for i in range(world.agents):
        me = effects[i]
        me.drift_x = 0.0
        me.drift_y = 0.0
        me.senses = 1.0
        me.hears = 1.0
        me.speed = 1.0
        me.lost = 0
    for j in range(targets.size):
        targets[j].drift_x = 0.0
        targets[j].drift_y = 0.0


@kernel
def _act(options, around, key, effects, memory, swarm, targets):
    """Let one disturbance act on whom it is about, while it lasts; memory : (L,) what it remembers."""
    soon = around.time + 1e-6 * around.time_step  # 3 * 0.3 is less than 0.9
    if soon < options.since or soon >= options.until:
        return
    for i in range(around.agents):
        there = is_there(around.number, swarm.joins[i], swarm.leaves[i])
        if there and (options.fleet < 0 or options.fleet == swarm.fleet[i]):
            _advance(effects[i], memory[i], options, around, split(key, i))
    if options.fleet < 0:
        for j in range(targets.size):
            _carry(targets[j], options, around, split(key, TARGET_STREAM + j))


@kernel
def _take_effect(effects, swarm, targets, world, number):
    """Let the lost be lost; returns whether every drift is finite."""
    finite = True
    for i in range(world.agents):
        if effects[i].lost != 0:
            swarm.leaves[i] = min(swarm.leaves[i], number)
        finite &= math.isfinite(effects[i].drift_x) & math.isfinite(effects[i].drift_y)
    for j in range(targets.size):
        finite &= math.isfinite(targets[j].drift_x) & math.isfinite(targets[j].drift_y)
    return finite


def _chained(role: str, last: Any, link: Any) -> Any:
    chain = last
    for number, each in reversed(list(enumerate(KINDS))):
        chain = kernel(link(number, getattr(each.value, role), chain))
    return chain


def _begin_link(number: int, chosen: Any, others: Any) -> Any:
    def begin(me, memory, options, draw):
        if options.kind == number:
            chosen(me, memory, options, draw)
        else:
            others(me, memory, options, draw)

    return begin


def _advance_link(number: int, chosen: Any, others: Any) -> Any:
    def advance(me, memory, options, around, draw):
        if options.kind == number:
            chosen(me, memory, options, around, draw)
        else:
            others(me, memory, options, around, draw)

    return advance


def _carry_link(number: int, chosen: Any, others: Any) -> Any:
    def carry(target, options, around, draw):
        if options.kind == number:
            chosen(target, options, around, draw)
        else:
            others(target, options, around, draw)

    return carry


@kernel
def _no_kind(me, memory, options, draw):
    """End of the chain."""


@kernel
def _no_kind_around(me, memory, options, around, draw):
    """End of the chain."""


@kernel
def _no_target(target, options, around, draw):
    """End of the chain."""


_begin = _chained("begin", _no_kind, _begin_link)
_advance = _chained("advance", _no_kind_around, _advance_link)
_carry = _chained("carry", _no_target, _carry_link)
