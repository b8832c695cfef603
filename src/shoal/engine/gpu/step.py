"""A time-step by a block of threads: that of engine/step.py, each thread being a block of one agent that decides alone.

Thread i does for agent i what the engine does for all lanes, with the engine's own kernels: it hands them the slice
[i, i + 1) of everything. What is not of one agent is the clerk's, the last thread, while agents decide or move: sums of
metrics, frames; targets move by a thread each. A barrier stands wherever somebody reads what others write.

    agents   sense         | shares of metrics | listen, decide       | move, effort, heading | targets, errors |
    clerk    mean velocity |                   | sums before the move | links                 | batteries       |

No barrier is called with a condition as its argument: Python may write the end of such a function twice, once for each
outcome, and threads that wait at two places wait forever.
"""

from typing import Any

import numba.cuda

from shoal.compiler.known import column, read
from shoal.core.draws import TARGET_STREAM, split
from shoal.engine.frames import keep_frame, keep_links
from shoal.engine.gpu.hear import add_up, choose
from shoal.engine.gpu.measure import (
    add_after_move,
    add_before_move,
    add_linked,
    add_own,
    look_at_graph,
    look_before_move,
    note_mean_velocity,
)
from shoal.engine.gpu.nearest import find_reach, measure
from shoal.engine.links import settle_links
from shoal.engine.listen import Arrived, Listeners
from shoal.engine.stage import (
    FRAMES,
    NATURE,
    RADIO,
    RUN,
    SCRATCH,
    SEA,
    SWARM,
    TALLY,
    TARGETS,
    TRACKS,
    WORLD,
    Scratch,
)
from shoal.engine.step import Now, Parts, decide, tell
from shoal.metrics.contract import Step
from shoal.world.energy import consume
from shoal.world.motion import NO_DRIFT, limit_maneuver, limited, moved
from shoal.world.neighbors import Links, rank_heard
from shoal.world.position import age_errors, locate
from shoal.world.presence import update_presence
from shoal.world.radio import adapt_degree, hide_far_away, limit_links, row, said, send, speaks, spoken
from shoal.world.sensing import believes, detects
from shoal.world.targets.dispatch import advance_target

cuda: Any = numba.cuda  # it has no types that mypy sees
_device: Any = cuda.jit(device=True)
INFINITE = float("inf")
DOUBLE, INTEGER = numba.float64, numba.int64
SUMS = 4  # more has no strategy of ours


@_device
def begin_step(stage, now, i, clerk):
    """All up to what agents decide; returns how many are on a target. All threads of a block come here.

    Every section reads the parts of the stage that it needs anew: what all need together is more than a thread holds.
    """
    agent = i < read(stage, WORLD).agents
    on_target = sense(stage, now, i, agent, clerk)
    when = Step(now.number, now.batch, 0)
    tally, world, swarm, scratch = read(stage, TALLY), read(stage, WORLD), read(stage, SWARM), read(stage, SCRATCH)
    if agent:
        look_before_move(tally, when, world, swarm, scratch, i)
    engaged = cuda.syncthreads_count(int(on_target))
    if now.frame >= 0:
        if clerk:
            keep_frame(read(stage, FRAMES), now.frame, now.number, world, swarm, read(stage, TARGETS))
        cuda.syncthreads()  # what is decided is not kept yet
    return engaged


@_device
def end_step(stage, room, now, i, clerk):
    """All that follows when agents have decided. All threads of a block come here."""
    agent = i < read(stage, WORLD).agents
    when = Step(now.number, now.batch, 0)
    cuda.syncthreads()
    tally, world, swarm, scratch = read(stage, TALLY), read(stage, WORLD), read(stage, SWARM), read(stage, SCRATCH)
    look_at_graph(tally, when, world, swarm, scratch, room, i)
    if agent:
        move(stage, now, when, i)
    elif clerk:
        count_linked(stage, now, when)
    cuda.syncthreads()
    conclude(stage, now, when, i, agent, clerk)
    cuda.syncthreads()


@_device
def count_before_move(stage, now, engaged):
    """What is said and counted before the move."""
    when = Step(now.number, now.batch, 0)
    world, swarm, radio = read(stage, WORLD), read(stage, SWARM), read(stage, RADIO)
    if speaks(radio, when.number):
        send(radio, swarm, when.number)
    add_before_move(read(stage, TALLY), when, world, swarm, read(stage, TARGETS), read(stage, SCRATCH), engaged)


@_device
def count_linked(stage, now, when):
    """What is counted when agents have listened."""
    tally, world, swarm = read(stage, TALLY), read(stage, WORLD), read(stage, SWARM)
    add_linked(tally, when, world, swarm, read(stage, TARGETS), read(stage, SCRATCH))


@_device
def sense(stage, now, i, agent, clerk):
    """What `shoal.engine.phases.sense_all` does: who is there, who is on target, and where all believe to be.

    Returns whether this one is on a target. The clerk adds up velocities meanwhile.
    """
    world, swarm, targets = read(stage, WORLD), read(stage, SWARM), read(stage, TARGETS)
    sea, effects = read(stage, SEA), read(stage, NATURE).effects
    if world.mortal:
        if clerk:
            update_presence(swarm, world, now.number)
        cuda.syncthreads()
    if clerk:
        note_mean_velocity(read(stage, SCRATCH), swarm, world)
    if targets.size == 0:
        cuda.syncthreads()
    on_target = False
    for j in range(targets.size):
        sees = False
        if agent and targets[j].present:
            sees = detects(swarm, targets[j], j, effects, sea, world, now.key, i)
        on_target |= sees
        watchers = cuda.syncthreads_count(int(sees))
        if clerk:
            targets[j].watchers = watchers
    if agent:
        swarm.engaged[i] = on_target
        swarm.on_target[i] = on_target
        if world.imperfect:
            swarm.on_target[i] = believes(swarm, effects, now.key, i)
        if world.inexact:
            locate(swarm, i, i + 1)
    return on_target


@_device
def listen_and_decide(stage, room, memories, params, now, i):
    """Agent i finds out whom it hears, sums up their influence, chooses whom to follow and decides.

    Arrays of one number are the thread's own: of a length that is known, they are kept in registers.
    """
    world, swarm, radio, scratch = read(stage, WORLD), read(stage, SWARM), read(stage, RADIO), read(stage, SCRATCH)
    last = i + 1
    agents, number = world.agents, now.number
    reach, sums = cuda.local.array(1, DOUBLE), cuda.local.array((SUMS, 1), DOUBLE)
    heard, wanted = cuda.local.array(1, INTEGER), cuda.local.array(1, INTEGER)
    leader = cuda.local.array(1, INTEGER)
    x, y, vx = cuda.local.array(1, DOUBLE), cuda.local.array(1, DOUBLE), cuda.local.array(1, DOUBLE)
    vy, max_speed, fleet = cuda.local.array(1, DOUBLE), cuda.local.array(1, DOUBLE), cuda.local.array(1, INTEGER)
    on_target = cuda.local.array(1, numba.boolean)
    x[0], y[0], vx[0], vy[0] = swarm.fix_x[i], swarm.fix_y[i], swarm.vx[i], swarm.vy[i]
    on_target[0], max_speed[0], fleet[0] = swarm.on_target[i], swarm.max_speed[i], swarm.fleet[i]
    others = scratch.links
    rows = agents + agents % 2  # of distances; those of the next agent begin after one more, which is in another bank
    square, rank = column(room[i * (rows + 1) : i * (rows + 1) + rows]), others.rank[:, i:last]
    order = others.order[i * agents : last * agents] if others.rank.shape[0] > 0 else others.order
    links = Links(square, reach, heard, wanted, rank, order, others.silent, others.lists, others.single)
    reports = said(radio, swarm, number)
    measure(square, reports.x, reports.y, x[0], y[0], agents, i)
    wanted[0] = swarm.neighbors[i]
    range_square = radio.range_square
    if world.inexact:
        hide_far_away(links, swarm, range_square, i, agents)
        range_square = INFINITE
    if radio.limited:
        limit_links(links, swarm, radio, i, agents, number, range_square)
    reach[0] = find_reach(square, others.reach[i], wanted[0], agents)
    rank_heard(links, agents)
    then = spoken(radio, number)
    told = memories.told if then == number else memories.arrived[row(radio, then)]
    arrived = Arrived(reports, told, then * world.time_step)
    listeners = Listeners(i, x, y, vx, vy, on_target, max_speed, fleet, world.time_step, number * world.time_step)
    for turn in range(2):
        heard[0] = add_up(arrived, listeners, links, params, agents, sums)
        if turn == 1 or not settle_links(links, world, swarm, radio, read(stage, RUN), number, i):
            break
    leader[0] = choose(arrived, listeners, links, params, agents)
    others.reach[i], others.heard[i] = reach[0], heard[0]
    if now.frame >= 0:
        keep_links(read(stage, FRAMES), now.frame, links, i, agents)
    totals = cuda.local.array((SUMS, 1), DOUBLE)  # in memory, so that sums are in registers until they are known
    for row_of_sums in range(SUMS):
        totals[row_of_sums, 0] = sums[row_of_sums, 0]
    a, b, c, d, sight = scratch.a, scratch.b, scratch.c, scratch.d, scratch.sight
    alone = Scratch(links, leader, totals, a, b, c, d, sight, scratch.hops, scratch.words)
    phases: Any = 0  # there are none on a card
    parts = Parts(stage, phases, world, swarm, radio, read(stage, TARGETS), alone)
    decide(swarm, parts, arrived, memories, params, now, i)
    if radio.adaptive:
        adapt_degree(swarm, radio, links, reports, i, last, world)


@_device
def move(stage, now, when, i):
    """What `shoal.engine.phases.move_agents` does, for agent i, and what it adds to the metrics then."""
    world, swarm, scratch = read(stage, WORLD), read(stage, SWARM), read(stage, SCRATCH)
    last = i + 1
    tell(swarm, i, last)
    if world.inertial:
        limit_maneuver(swarm, i, last, world.time_step)
    x, y = limited(swarm.command_x[i], swarm.command_y[i], swarm.max_speed[i], world.divide)
    swarm.command_x[i], swarm.command_y[i] = x, y
    if world.powered:
        consume(swarm, world, now.number, i, last)
    swarm.x[i], swarm.vx[i] = moved(swarm.x[i], x, NO_DRIFT, world.clamp_x, world.time_step)
    swarm.y[i], swarm.vy[i] = moved(swarm.y[i], y, NO_DRIFT, world.clamp_y, world.time_step)
    if world.inexact:
        locate(swarm, i, last)
    add_own(read(stage, TALLY), when, world, swarm, read(stage, TARGETS), scratch, i)


@_device
def conclude(stage, now, when, i, agent, clerk):
    """Targets move, each by a thread, and errors age."""
    world, swarm, targets = read(stage, WORLD), read(stage, SWARM), read(stage, TARGETS)
    tracks, sea = read(stage, TRACKS), read(stage, SEA)
    if agent and world.inexact:
        age_errors(swarm, now.key, i, i + 1)
    j = i
    while j < targets.size:
        advance_target(targets[j], tracks, swarm, sea, world, now.number + 1, split(now.key, TARGET_STREAM + j))
        j += cuda.blockDim.x
    if clerk:
        add_after_move(read(stage, TALLY), when, world, swarm, targets, read(stage, SCRATCH))


def make_rollout(at_memories: Any, at_params: Any, place: Any, near: bool) -> Any:
    """The kernel that runs steps first..last of every run of a batch, for memories and parameters of two types.

    Parameters
    ----------
    at_memories, at_params : functions of an address that read them there, see compiler/packed.py
    place : function of a stage's address, see compiler/known.py
    near : whether all distances of a run fit the memory that a block has for itself; else they are in `far`
    """

    def rollout(stages, memories, params, far, first, last, every, tail):
        run_number = cuda.blockIdx.x
        i = cuda.threadIdx.x
        clerk = i == cuda.blockDim.x - 1
        stage = place(stages[run_number])
        agents = read(stage, WORLD).agents
        room = cuda.shared.array(0, DOUBLE)  # squared distances, from all to each agent
        if not near:
            size = agents * (agents + 2)
            room = far[run_number * size : (run_number + 1) * size]
        run = read(stage, RUN)
        batches = read(stage, TALLY).steps.size
        frames = read(stage, FRAMES).step.size
        run_key = split(split(run.seed, 0), run.run)
        frame = 0
        batch = first * batches // run.steps
        for number in range(first, last):
            if number * batches >= (batch + 1) * run.steps and batch < batches - 1:
                batch += 1
            keeps = frames > 0 and (number % every == 0 or number >= tail)
            now = Now(number, batch, split(run_key, number), frame if keeps else -1)
            engaged = begin_step(stage, now, i, clerk)
            if i < agents:
                memory, chosen = at_memories(memories[run_number]), at_params(params[run_number])
                listen_and_decide(stage, room, memory, chosen, now, i)
            elif clerk:
                count_before_move(stage, now, engaged)
            end_step(stage, room, now, i, clerk)
            frame += keeps

    return rollout
