"""Many steps of one run in one compiled call; the functions that Python calls.

`stage` is the address of a stage (compiler/placed.py), which the caller keeps in place until the call is back.
"""

import numpy as np

from shoal.compiler.kernel import Entry, entry_kernel
from shoal.compiler.phase import enter
from shoal.compiler.placed import part
from shoal.core.draws import START_STEP, TARGET_STREAM, split
from shoal.engine.self import own
from shoal.engine.stage import FRAMES, PHASES, RADIO, RUN, SCRATCH, SEA, SWARM, TALLY, TARGETS, TRACKS, WORLD
from shoal.engine.step import Now, Parts, step, tell
from shoal.strategies import asking
from shoal.world.placement import draw_sides, place
from shoal.world.position import begin_errors, locate
from shoal.world.presence import draw_lifetimes, draw_losses, lose, update_presence
from shoal.world.radio import begin_degree
from shoal.world.targets.dispatch import begin_target


@entry_kernel
def set_out(stage, places, lifetimes, losses):
    """Place agents and targets, and draw when agents will be lost.

    places, lifetimes : (F,) index into PLACES and mean lifetime [s] of each fleet, 0 for ever
    losses : (C, 4) step, fleet (-1: any), number of agents and the agent (-1: by lot) of each loss
    """
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    radio = part(stage, RADIO)
    targets = part(stage, TARGETS)
    tracks = part(stage, TRACKS)
    run = part(stage, RUN)
    run_key = split(split(run.seed, 0), run.run)
    start_key = split(run_key, START_STEP)
    sea = part(stage, SEA)
    place(swarm, world, places, run_key)
    if world.coastal:
        for i in range(world.agents):
            enter(part(stage, PHASES).launch, stage, places[swarm.fleet[i]], i, 0, run_key)
    draw_sides(swarm, targets, world, run_key)
    draw_lifetimes(swarm, world, lifetimes, run_key)
    for number, fleet, count, agent in losses:
        if agent >= 0:
            lose(swarm, number, agent)
        else:
            draw_losses(swarm, world, number, fleet, count, run_key)
    update_presence(swarm, world, 0)
    if world.inexact:
        begin_errors(swarm, world, start_key)
        locate(swarm, 0, world.agents)
    if radio.adaptive:
        begin_degree(swarm, radio, world.agents)
    for j in range(targets.size):
        begin_target(targets[j], tracks, swarm, sea, world, split(start_key, TARGET_STREAM + j))


SET_OUT = Entry(set_out, 0, np.zeros(1, np.int64), np.zeros(1), np.zeros((1, 4), np.int64))


@entry_kernel
def begin_run(stage, memories, params):
    """Set up every agent's memory."""
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    targets = part(stage, TARGETS)
    run = part(stage, RUN)
    start_key = split(split(split(run.seed, 0), run.run), START_STEP)
    for i in range(world.agents):
        me = own(world, swarm, targets, params, 0, i)
        asking.begin(me, memories.memory[i], params, split(start_key, i))
    tell(swarm, 0, world.agents)


@entry_kernel
def rollout(stage, memories, params, first, last, every, tail):
    """Run time-steps first..last, in place; returns what is not finite at the end, 0: nothing, see come_to_rest.

    Frames are kept of every `every`-th step and of all from step `tail` on. Splitting a run into several calls changes
    no bit: what must survive a call is in the stage, and true when a call is back.
    """
    phases = part(stage, PHASES)
    run = part(stage, RUN)
    parts = Parts(
        stage,
        phases,
        part(stage, WORLD),
        part(stage, SWARM),
        part(stage, RADIO),
        part(stage, TARGETS),
        part(stage, SCRATCH),
    )
    batches = part(stage, TALLY).steps.size
    room = part(stage, FRAMES).step.size
    run_key = split(split(run.seed, 0), run.run)
    frame = 0
    for number in range(first, last):
        batch = min(number * batches // run.steps, batches - 1)
        keeps = room > 0 and (number % every == 0 or number >= tail)
        step(parts, memories, params, Now(number, batch, split(run_key, number), frame if keeps else -1))
        frame += keeps
    return enter(phases.come_to_rest, stage, last, 0, 0, split(run_key, last))


@entry_kernel
def look(stage, number):
    """Fill the only frame of a stage with what step `number` will begin with, and whom agents will hear in it."""
    phases = part(stage, PHASES)
    run = part(stage, RUN)
    world = part(stage, WORLD)
    scratch = part(stage, SCRATCH)
    together = scratch.leader.size
    key = split(split(split(run.seed, 0), run.run), number)
    enter(phases.record_frame, stage, number, 0, 0, key)
    if part(stage, FRAMES).links.shape[2] > 0:
        for first in range(0, world.agents, together):
            enter(phases.look_at_links, stage, number, first, 0, key)
