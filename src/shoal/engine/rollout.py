"""Many steps of one run in one compiled call; the functions that Python calls."""

from shoal.compiler.kernel import entry_kernel
from shoal.compiler.phase import enter, part
from shoal.core.draws import START_STEP, TARGET_STREAM, split
from shoal.engine.self import own
from shoal.engine.stage import FRAMES, RADIO, SCRATCH, SWARM, TALLY, TARGETS, TRACKS, WORLD
from shoal.engine.step import step, tell
from shoal.strategies import contract
from shoal.world.placement import place
from shoal.world.presence import draw_lifetimes, draw_losses, update_presence
from shoal.world.radio import begin_degree
from shoal.world.targets import begin_target


@entry_kernel
def set_out(here, places, lifetimes, losses, seed, run):
    """Place agents and targets, and draw who will be lost when. `here` is where the stage is.

    places, lifetimes : (F,) index into PLACES and mean lifetime [s] of each fleet, 0 for ever
    losses : (C, 3) step, fleet (-1: any) and number of agents of each loss
    """
    world = part(here, WORLD)
    swarm = part(here, SWARM)
    radio = part(here, RADIO)
    targets = part(here, TARGETS)
    tracks = part(here, TRACKS)
    run_key = split(split(seed, 0), run)
    start_key = split(run_key, START_STEP)
    place(swarm, world, places, run_key)
    draw_lifetimes(swarm, world, lifetimes, run_key)
    for number, fleet, count in losses:
        draw_losses(swarm, world, number, fleet, count, run_key)
    update_presence(swarm, world, 0)
    if radio.adaptive:
        begin_degree(swarm, radio, world.agents)
    for j in range(targets.size):
        begin_target(targets[j], tracks, split(start_key, TARGET_STREAM + j))


@entry_kernel
def begin_run(here, minds, params, seed, run):
    """Set up every agent's memory."""
    world = part(here, WORLD)
    swarm = part(here, SWARM)
    targets = part(here, TARGETS)
    start_key = split(split(split(seed, 0), run), START_STEP)
    for i in range(world.agents):
        me = own(world, swarm, targets, params, 0, i)
        contract.begin(me, minds.memory[i], params, split(start_key, i))
    tell(swarm, 0, world.agents)


@entry_kernel
def rollout(here, minds, params, phases, seed, run, first, last, steps, every, tail):
    """Run time-steps first..last of `steps`, in place.

    Frames are kept of every `every`-th step and of all from step `tail` on. Splitting a run into several calls changes
    no bit: what must survive a call is in the stage.
    """
    run_key = split(split(seed, 0), run)
    world = part(here, WORLD)
    swarm = part(here, SWARM)
    radio = part(here, RADIO)
    targets = part(here, TARGETS)
    tally = part(here, TALLY)
    scratch = part(here, SCRATCH)
    frames = part(here, FRAMES)
    batches = tally.steps.size
    room = frames.step.size
    frame = 0
    for number in range(first, last):
        step_key = split(run_key, number)
        if room > 0 and (number % every == 0 or number >= tail):
            enter(phases.look, here, number, frame, step_key)
            frame += 1
        batch = min(number * batches // steps, batches - 1)
        step(here, world, swarm, radio, targets, scratch, minds, params, phases, batch, step_key, number)
