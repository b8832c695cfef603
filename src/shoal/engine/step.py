"""One time-step: sense, link, listen, decide, move, measure. Algorithm 2 of the paper; shoal/reference.py is to read.

What knows no strategy is a phase, called through its address (engine/phases.py); listen and decide are compiled for
each strategy: the paper's, with Algorithm 1, is strategies/knn_pso.py.
"""

from typing import Any, NamedTuple

from shoal.compiler.kernel import kernel
from shoal.compiler.phase import enter
from shoal.core.draws import split
from shoal.core.messages import Heard
from shoal.engine.arrivals import arriving, choose, said_by, sum_up, told_by
from shoal.engine.listen import Listeners
from shoal.engine.self import own
from shoal.engine.stage import Addresses, Scratch
from shoal.strategies import asking


class Parts(NamedTuple):
    """What a step needs of the stage, and the stage's address, for phases."""

    stage: Any
    phases: Addresses
    world: Any
    swarm: Any
    radio: Any
    targets: Any
    scratch: Scratch


class Now(NamedTuple):
    """A step: its number, the batch that its sums go into, the key of its chance, the frame to keep it in, -1: none."""

    number: int
    batch: int
    key: Any
    frame: int


@kernel
def step(parts, memories, params, now):
    """Advance the world by a time-step: Algorithm 2."""
    phases, world = parts.phases, parts.world
    run(phases.sense, parts, now, 0)  # f_i of all agents (Eq. 1), and Eq. 5 of the velocities that they have
    if now.frame >= 0:
        run(phases.record_frame, parts, now, now.frame)
    arrived = arriving(memories, parts.radio, parts.swarm, now.number, world.time_step)
    together = parts.scratch.leader.size
    for first in range(0, world.agents, together):  # in one go; one after the other in the sequential order
        run(phases.link, parts, now, first)  # N_i: the k nearest others
        listen(parts, arrived, params, now, first)  # whose position Nbest is, and the sum over N_i of Eq. 4
        if now.frame >= 0:
            enter(phases.record_links, parts.stage, now.number, first, now.frame, now.key)
        decide(parts.swarm, parts, arrived, memories, params, now, first)  # v_pso (Eq. 2) + v_rep: the strategy's
        tell(parts.swarm, first, min(first + together, world.agents))
        run(phases.move, parts, now, first)  # limited to the top speed, then Eq. 3
    run(phases.measure, parts, now, 0)  # Eq. 8
    run(phases.move_targets, parts, now, 0)


@kernel
def run(phase, parts, now, first):
    """Run a phase of this step."""
    return enter(phase, parts.stage, now.number, first, now.batch, now.key)


@kernel
def listen(parts, arrived, params, now, first):
    """Agents from `first` on sum up their neighbors' influence and choose whom to follow."""
    world, scratch = parts.world, parts.scratch
    listeners = listening(parts, now, first)
    for turn in range(2):  # the second where ties or losses changed who is heard; written once, compiled once
        sum_up(arrived, listeners, scratch.links, params, world.agents, scratch.sums)
        if turn == 1 or run(parts.phases.settle_ties, parts, now, first) == 0:
            break
    choose(arrived, listeners, scratch.links, params, world.agents, scratch.leader, scratch.a)


@kernel
def listening(parts, now, first):
    """The agents from `first` on that decide together, as they listen in this step."""
    world, swarm = parts.world, parts.swarm
    last = first + parts.scratch.leader.size
    return Listeners(
        first,
        swarm.fix_x[first:last],
        swarm.fix_y[first:last],
        swarm.vx[first:last],
        swarm.vy[first:last],
        swarm.on_target[first:last],
        swarm.max_speed[first:last],
        swarm.fleet[first:last],
        world.time_step,
        now.number * world.time_step,
    )


@kernel
def decide(swarm, parts, arrived, memories, params, now, first):
    """Every agent there, from `first` on, asks its strategy for the velocity it wants and updates what it remembers.

    `swarm` is parts.swarm: what is written to must be near, see compiler/kernel.py.
    """
    world, scratch = parts.world, parts.scratch
    last = min(first + scratch.leader.size, world.agents)
    for i in range(first, last):
        if swarm.alive[i] == 0.0:
            swarm.command_x[i] = 0.0
            swarm.command_y[i] = 0.0
            continue
        lane = i - first
        me = own(world, swarm, parts.targets, params, now.number, i)
        found = scratch.leader[lane] >= 0
        j = scratch.leader[lane] if found else i
        x, y, vx, vy, on_target = said_by(arrived, j, lane)
        heard = Heard(
            found,
            x if found else me.x,
            y if found else me.y,
            vx if found else me.vx,
            vy if found else me.vy,
            on_target if found else me.on_target,
            0.0,
            0.0,
            scratch.links.heard[lane],
            told_by(arrived, j, lane),
            scratch.sums[:, lane],
        )
        vx, vy = asking.decide(me, heard, memories.memory[i], params, split(now.key, i))
        swarm.command_x[i] = vx
        swarm.command_y[i] = vy


@kernel
def tell(swarm, first, last):
    """Copy the fields of memory that reports carry; memory begins with them."""
    for i in range(first, last):
        for field in range(swarm.told.shape[1]):
            swarm.told[i, field] = swarm.memory[i, field]
