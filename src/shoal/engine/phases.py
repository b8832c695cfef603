"""The parts of a step that know no strategy, each compiled once for all of them (see compiler/phase.py).

Every phase takes the address of the stage, the number of the step, the first agent of the block that decides together,
the batch of the sums, and the key of the step's chance; it returns an integer.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from shoal.compiler.borrowed import lend
from shoal.compiler.kernel import kernel
from shoal.compiler.phase import enter, phase
from shoal.compiler.placed import part
from shoal.core.agents import Swarm
from shoal.core.draws import TARGET_STREAM, split
from shoal.core.plugin_errors import plugin_errors
from shoal.engine.ahead import Part, compile_ahead, compile_all
from shoal.engine.frames import keep_frame, keep_links
from shoal.engine.links import link, link_single, look_at_links, look_at_single, settle, settle_single
from shoal.engine.listen import Arrived, InTurn, Listeners, Single
from shoal.engine.many import link_many, look_at_many, settle_many
from shoal.engine.measure import measure_after_move, measure_before_move, measure_links
from shoal.engine.nature import disturb_all, drift_targets, hide, launch_agent, receive, sail_all, stop_target
from shoal.engine.rollout import SET_OUT
from shoal.engine.stage import (
    FRAMES,
    NATURE,
    PHASES,
    RADIO,
    SCRATCH,
    SEA,
    SWARM,
    TALLY,
    TARGETS,
    TRACKS,
    WORLD,
    Addresses,
    Frames,
    Run,
    Scratch,
)
from shoal.engine.step import Now, Parts
from shoal.metrics.contract import Step
from shoal.metrics.tally import Tally
from shoal.world.arena import World
from shoal.world.disturbances.contract import Nature
from shoal.world.energy import consume
from shoal.world.motion import (
    limit_maneuver,
    limit_speed,
    move,
    move_adrift,
    note_drift,
    slow_down,
)
from shoal.world.neighbors import Links
from shoal.world.orders import obey
from shoal.world.position import age_errors, locate
from shoal.world.presence import update_presence
from shoal.world.radio import (
    Radio,
    adapt_degree,
    said,
    send,
    speaks,
)
from shoal.world.sea.sea import Sea
from shoal.world.sensing import sense
from shoal.world.targets.contract import Around
from shoal.world.targets.dispatch import advance_target

lend(World, Swarm, Radio, Nature, Sea, Tally, Links, Scratch, Frames, Run)
lend(Parts, Now, Arrived, InTurn, Single, Listeners, Around)  # made of these

SPOILED_AGENTS, SPOILED_TARGETS, SPOILED_DRIFT = 1, 2, 3  # what a run ends with whose numbers are not finite


@phase
def sense_all(stage, number, first, batch, key):
    """What nature does, who is there, who is on target, and what is said."""
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    radio = part(stage, RADIO)
    targets = part(stage, TARGETS)
    nature = part(stage, NATURE)
    tally = part(stage, TALLY)
    scratch = part(stage, SCRATCH)
    if world.disturbed:
        enter(part(stage, PHASES).disturb, stage, number, 0, 0, key)
    if world.mortal:
        update_presence(swarm, world, number)
    sense(swarm, targets, nature.effects, part(stage, SEA), world, key)
    measure_before_move(tally, Step(number, batch, 0), world, swarm, targets, scratch)
    if world.inexact:
        locate(swarm, 0, world.agents)
    if speaks(radio, number):
        send(radio, swarm, number)
    return 0


@phase
def record_frame(stage, number, frame, batch, key):
    """Keep the state at the start of a step as a frame."""
    keep_frame(part(stage, FRAMES), frame, number, part(stage, WORLD), part(stage, SWARM), part(stage, TARGETS))
    return 0


@phase
def record_links(stage, number, first, frame, key):
    """Keep whom the agents from `first` on heard in this step."""
    frames = part(stage, FRAMES)
    scratch = part(stage, SCRATCH)
    keep_links(frames, frame, scratch.links, first, part(stage, WORLD).agents)
    return 0


@phase
def move_agents(stage, number, first, batch, key):
    """Move the agents from `first` on as their commands say, within their limits."""
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    radio = part(stage, RADIO)
    tally = part(stage, TALLY)
    scratch = part(stage, SCRATCH)
    last = first + scratch.leader.size
    there = min(last, world.agents)
    command_x, command_y = swarm.command_x[first:last], swarm.command_y[first:last]
    measure_links(tally, Step(number, batch, first), world, swarm, part(stage, TARGETS), scratch)
    if radio.adaptive:
        adapt_degree(swarm, radio, scratch.links, said(radio, swarm, number), first, there, world)
    if world.ordered:
        obey(swarm, world.time_step, first, there)
    if world.inertial:
        limit_maneuver(swarm, first, there, world.time_step)
    limit_speed(command_x, command_y, swarm.max_speed[first:last], world.divide)
    effects = part(stage, NATURE).effects
    if world.disturbed:
        slow_down(command_x, command_y, swarm.max_speed[first:last], effects[first:last].speed)
    if world.powered:
        consume(swarm, world, number, first, there)
    if world.flowing or world.coastal:
        enter(part(stage, PHASES).sail, stage, number, first, batch, key)
    else:
        go(swarm, effects, world, first, last)
    if world.inexact:
        locate(swarm, first, there)
    return 0


@kernel
def go(swarm, effects, world, first, last):
    """Move agents first..last of a sea without currents, wind or land, in place."""
    command_x, command_y = swarm.command_x[first:last], swarm.command_y[first:last]
    x, y, vx, vy = swarm.x[first:last], swarm.y[first:last], swarm.vx[first:last], swarm.vy[first:last]
    if world.disturbed:
        move_adrift(x, vx, command_x, effects[first:last].drift_x, world.clamp_x, world.time_step)
        move_adrift(y, vy, command_y, effects[first:last].drift_y, world.clamp_y, world.time_step)
        note_drift(swarm, effects, world.time_step, first, min(last, world.agents))
    else:
        move(x, vx, command_x, world.clamp_x, world.time_step)
        move(y, vy, command_y, world.clamp_y, world.time_step)


@phase
def measure(stage, number, first, batch, key):
    """Measure where agents head, while the targets are still where they were."""
    tally, world, swarm = part(stage, TALLY), part(stage, WORLD), part(stage, SWARM)
    measure_after_move(tally, Step(number, batch, 0), world, swarm, part(stage, TARGETS), part(stage, SCRATCH))
    return 0


@phase
def move_targets(stage, number, first, batch, key):
    """Targets move by their rules, or as they were recorded; the errors of positions grow as old as the coming step."""
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    if world.inexact:
        age_errors(swarm, key, 0, world.agents)
    targets = part(stage, TARGETS)
    tracks = part(stage, TRACKS)
    sea = part(stage, SEA)
    phases = part(stage, PHASES)
    scratch = part(stage, SCRATCH)
    if world.flowing:
        enter(phases.drift_targets, stage, number, 0, batch, key)
    for j in range(targets.size):
        scratch.a[0], scratch.b[0] = targets[j].x, targets[j].y
        advance_target(targets[j], tracks, swarm, sea, world, number + 1, split(key, TARGET_STREAM + j))
        if world.coastal:
            enter(phases.stop_target, stage, number, j, batch, key)
    return 0


@phase
def come_to_rest(stage, number, first, batch, key):
    """Make the state true between two calls: what nature does, who is there and on target as step `number` will begin.

    Returns 0, or what is not finite: SPOILED_AGENTS, SPOILED_TARGETS, SPOILED_DRIFT.
    """
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    targets = part(stage, TARGETS)
    nature = part(stage, NATURE)
    if world.disturbed:
        enter(part(stage, PHASES).disturb, stage, number, 0, 0, key)
    if world.mortal:
        update_presence(swarm, world, number)
    sense(swarm, targets, nature.effects, part(stage, SEA), world, key)
    if world.inexact:
        locate(swarm, 0, world.agents)
    if nature.clock[1] != 0:
        return SPOILED_DRIFT
    for target in targets:
        if not (np.isfinite(target.x) and np.isfinite(target.y)):
            return SPOILED_TARGETS
    finite = True
    for i in range(world.agents):
        finite &= np.isfinite(swarm.x[i]) & np.isfinite(swarm.y[i])
        finite &= np.isfinite(swarm.vx[i]) & np.isfinite(swarm.vy[i])
    for each in part(stage, TALLY).fluctuation.flat:
        finite &= np.isfinite(each)
    return 0 if finite else SPOILED_AGENTS


def addresses(
    world: World,
    frames: bool = False,
    looking: bool = False,
    collecting: bool = False,
    first: Callable[[], object] | None = None,
) -> Addresses:
    """Compile the phases that a run needs, or load them from the cache; the others are nowhere, at 0.

    Parameters
    ----------
    world : what there is in the run
    frames : whether frames are kept; looking : whether links are, of a step that does not begin
    collecting : whether radios relay or keep reports
    first : compiles what other processes cannot, while these begin with the phases

    Raises
    ------
    PluginError : what an installed package counts or moves cannot be compiled
    """
    at_sea = world.flowing or world.coastal
    link_now, settle_now, look_now = link, settle, look_at_links
    if world.single:
        link_now, settle_now, look_now = link_single, settle_single, look_at_single
    if world.listed:
        link_now, settle_now, look_now = link_many, settle_many, look_at_many
    needed = [
        (sense_all, True),
        (disturb_all, world.disturbed),
        (record_frame, frames),
        (link_now, True),
        (hide, world.coastal),
        (receive, collecting),
        (settle_now, True),
        (record_links, frames),
        (move_agents, True),
        (sail_all, at_sea),
        (measure, True),
        (drift_targets, world.flowing),
        (move_targets, True),
        (stop_target, world.coastal),
        (come_to_rest, True),
        (look_now, looking),
        (launch_agent, world.coastal),
    ]
    parts: list[Part] = [SET_OUT, *(each for each, wanted in needed if wanted)]
    compile_ahead(parts, soon=[record_frame, record_links])
    if first:
        first()
    with plugin_errors():
        compile_all(parts)
        where: list[Any] = [each.address() if wanted else 0 for each, wanted in needed]
    return Addresses(*where)
