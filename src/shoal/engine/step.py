"""One time-step: sense, listen, decide, move, measure. Algorithm 2 of the paper, which reference.py has to read."""

from shoal.compiler.kernel import kernel
from shoal.compiler.phase import enter
from shoal.core.draws import split
from shoal.core.messages import Heard
from shoal.engine.listen import choose_leaders, sum_influence
from shoal.engine.self import own
from shoal.strategies import contract
from shoal.world.radio import said


@kernel
def step(here, world, swarm, radio, targets, scratch, minds, params, phases, batch, step_key, number):
    """Advance the world by time-step `number`; `here` is where the stage is."""
    enter(phases.perceive, here, number, batch, step_key)
    reports = said(radio, swarm, number)
    told = minds.told if radio.delay == 0 else minds.arrived[(number + 1) % (radio.delay + 1)]
    together = scratch.leader.size
    for first in range(0, world.agents, together):
        enter(phases.link, here, number, first, step_key)
        listen(here, world, swarm, radio, scratch, reports, told, params, phases, step_key, number, first)
        decide(world, swarm, targets, scratch, reports, told, minds, params, step_key, number, first)
        enter(phases.go, here, number, (batch << 32) | first, step_key)  # a phase takes two numbers, and go needs three
    enter(phases.conclude, here, number, batch, step_key)


@kernel
def listen(here, world, swarm, radio, scratch, reports, told, params, phases, step_key, number, first):
    """Agents from `first` on sum up their neighbors' influence and choose whom to follow."""
    links, leader = scratch.links, scratch.leader
    last = first + leader.size
    block = (
        swarm.x[first:last],
        swarm.y[first:last],
        swarm.vx[first:last],
        swarm.vy[first:last],
        swarm.on_target[first:last],
        swarm.max_speed[first:last],
        swarm.fleet[first:last],
    )
    clock = (world.time_step, number * world.time_step, (number - radio.delay) * world.time_step)
    for turn in range(2):  # the second where ties or losses changed who is heard; written once, compiled once
        sum_influence(reports, told, block, links, params, first, world.agents, clock, scratch.sums)
        if turn == 1 or enter(phases.settle, here, number, first, step_key) == 0:
            break
    choose_leaders(reports, told, block, links, params, first, world.agents, clock, leader, scratch.a)


@kernel
def decide(world, swarm, targets, scratch, reports, told, minds, params, step_key, number, first):
    """Every agent there, from `first` on, asks its strategy for the velocity it wants and updates what it tells."""
    leader, sums, count = scratch.leader, scratch.sums, scratch.links.heard
    last = min(first + leader.size, world.agents)
    for i in range(first, last):
        if swarm.alive[i] == 0.0:
            swarm.command_x[i] = 0.0
            swarm.command_y[i] = 0.0
            continue
        lane = i - first
        me = own(world, swarm, targets, params, number, i)
        found = leader[lane] >= 0
        j = leader[lane] if found else i
        heard = Heard(
            found,
            reports.x[j] if found else me.x,
            reports.y[j] if found else me.y,
            reports.vx[j] if found else me.vx,
            reports.vy[j] if found else me.vy,
            reports.on_target[j] if found else me.on_target,
            0.0,
            0.0,
            count[lane],
            told[j],
            sums[:, lane],
        )
        vx, vy = contract.decide(me, heard, minds.memory[i], params, split(step_key, i))
        swarm.command_x[i] = vx
        swarm.command_y[i] = vy
    tell(swarm, first, last)


@kernel
def tell(swarm, first, last):
    """Copy the fields of memory that reports carry; memory begins with them."""
    for i in range(first, last):
        for field in range(swarm.told.shape[1]):
            swarm.told[i, field] = swarm.memory[i, field]
