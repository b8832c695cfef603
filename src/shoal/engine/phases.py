"""The parts of a step that know no strategy, each compiled once for all of them (see compiler/phase.py).

Every phase takes the address of the stage, the number of the step, the first agent of the block that decides together,
the batch of the sums, and the key of the step's chance; it returns an integer.
"""

from typing import Any

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.compiler.phase import phase
from shoal.compiler.placed import part
from shoal.core.draws import TARGET_STREAM, split
from shoal.core.plugin_errors import plugin_errors
from shoal.engine.frames import keep_frame, keep_links
from shoal.engine.measure import measure_after_move, measure_before_move, measure_links
from shoal.engine.stage import FRAMES, NATURE, RADIO, RUN, SCRATCH, SEA, SWARM, TALLY, TARGETS, TRACKS, WORLD, Addresses
from shoal.metrics.contract import Step
from shoal.world.disturbances.dispatch import disturb
from shoal.world.motion import (
    add_drift,
    limit_maneuver,
    limit_speed,
    move,
    move_adrift,
    note_drift,
    sail,
    sail_coast,
    slow_down,
)
from shoal.world.neighbors import count_heard, link_nearest, measure_distances, rank_heard, settle_ties
from shoal.world.presence import update_presence
from shoal.world.radio import adapt_degree, deafen, limit_links, lose_reports, said, send
from shoal.world.sea.sea import carry, span
from shoal.world.sea.sight import hide_behind_land
from shoal.world.sensing import sense
from shoal.world.targets.dispatch import advance_target

SPOILED_AGENTS, SPOILED_TARGETS, SPOILED_DRIFT = 1, 2, 3  # what a run ends with whose numbers are not finite


@phase
def sense_all(stage, number, first, batch, key):
    """What nature does, who is there, who is on target, and what is said."""
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    radio = part(stage, RADIO)
    targets = part(stage, TARGETS)
    nature = part(stage, NATURE)
    run = part(stage, RUN)
    tally = part(stage, TALLY)
    scratch = part(stage, SCRATCH)
    if world.disturbed:
        disturb(nature, swarm, targets, world, number, split(split(run.seed, 0), run.run))
    if world.mortal:
        update_presence(swarm, world, number)
    sense(swarm, targets, nature.effects, part(stage, SEA), world, key)
    measure_before_move(tally, Step(number, batch, 0), world, swarm, targets, scratch)
    if radio.delay > 0:
        send(radio, swarm, number)
    return 0


@phase
def record_frame(stage, number, frame, batch, key):
    """Keep the state at the start of a step as a frame."""
    keep_frame(part(stage, FRAMES), frame, number, part(stage, WORLD), part(stage, SWARM), part(stage, TARGETS))
    return 0


@phase
def link(stage, number, first, batch, key):
    """Find out whom the agents from `first` on hear."""
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    radio = part(stage, RADIO)
    scratch = part(stage, SCRATCH)
    find_links(scratch, world, swarm, radio, part(stage, NATURE).effects, part(stage, SEA), number, first)
    return 0


@kernel
def find_links(scratch, world, swarm, radio, effects, sea, number, first):
    """Link the agents from `first` on to those whose reports may reach them, ties and losses aside."""
    links = scratch.links
    last = first + links.reach.size
    reports = said(radio, swarm, number)
    measure_distances(links, reports.x, reports.y, swarm.x[first:last], swarm.y[first:last], first, world.agents)
    if world.disturbed:
        deafen(links, effects, first, world.agents)
    if world.coastal:
        hide_behind_land(links, scratch.sight, reports, swarm, sea.land, radio, first, world.agents)
    if radio.limited:
        limit_links(links, swarm, radio, first, world.agents, number)
    if radio.limited or world.coastal:
        link_nearest(links, links.wanted, world.agents)
    else:
        link_nearest(links, swarm.neighbors[first:last], world.agents)
    rank_heard(links, world.agents)


@phase
def settle(stage, number, first, batch, key):
    """Settle ties and lose reports; returns 1 if links changed after their influence was summed."""
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    radio = part(stage, RADIO)
    scratch = part(stage, SCRATCH)
    return 1 if settle_links(scratch.links, world, swarm, radio, first, key) else 0


@kernel
def settle_links(links, world, swarm, radio, first, key):
    """Settle ties, by how many are heard, and lose reports; return whether links changed."""
    if radio.limited or world.coastal:
        changed = settle_ties(links, links.wanted, world.agents)
    else:
        changed = settle_ties(links, swarm.neighbors[first : first + links.reach.size], world.agents)
    if radio.loss > 0.0:
        lose_reports(links, radio, key, first, world.agents)
        changed = True
    if changed:
        rank_heard(links, world.agents)
    return changed


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
    if world.inertial:
        limit_maneuver(swarm, first, there, world.time_step)
    limit_speed(command_x, command_y, swarm.max_speed[first:last], world.divide)
    effects = part(stage, NATURE).effects
    if world.disturbed:
        slow_down(command_x, command_y, swarm.max_speed[first:last], effects[first:last].speed)
    if world.flowing or world.coastal:
        go_to_sea(swarm, effects, part(stage, SEA), scratch, world, number, first, there)
        return 0
    x, y, vx, vy = swarm.x[first:last], swarm.y[first:last], swarm.vx[first:last], swarm.vy[first:last]
    if world.disturbed:
        move_adrift(x, vx, command_x, effects[first:last].drift_x, world.clamp_x, world.time_step)
        move_adrift(y, vy, command_y, effects[first:last].drift_y, world.clamp_y, world.time_step)
        note_drift(swarm, effects, world.time_step, first, there)
    else:
        move(x, vx, command_x, world.clamp_x, world.time_step)
        move(y, vy, command_y, world.clamp_y, world.time_step)
    return 0


@kernel
def go_to_sea(swarm, effects, sea, scratch, world, number, first, last):
    """Move agents first..last where water and wind carry them, and land stops them."""
    time_step = world.time_step
    drift_x, drift_y = swarm.drift_x, swarm.drift_y
    for i in range(first, last):
        drift_x[i] = 0.0
        drift_y[i] = 0.0
    if world.flowing:
        carry(sea, swarm, scratch, world.windy, span(sea, number, time_step), first, last)
    if world.disturbed:
        add_drift(swarm, effects, time_step, first, last)
    if world.coastal:
        sail_coast(swarm, drift_x, drift_y, sea.shore, world, first, last)
    else:
        x, y, vx, vy = swarm.x[first:last], swarm.y[first:last], swarm.vx[first:last], swarm.vy[first:last]
        sail(x, vx, swarm.command_x[first:last], drift_x[first:last], world.clamp_x, time_step)
        sail(y, vy, swarm.command_y[first:last], drift_y[first:last], world.clamp_y, time_step)


@phase
def measure(stage, number, first, batch, key):
    """Measure where agents head, while the targets are still where they were."""
    tally, world, swarm = part(stage, TALLY), part(stage, WORLD), part(stage, SWARM)
    measure_after_move(tally, Step(number, batch, 0), world, swarm, part(stage, TARGETS), part(stage, SCRATCH))
    return 0


@phase
def move_targets(stage, number, first, batch, key):
    """Targets move by their rules, or as they were recorded."""
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    targets = part(stage, TARGETS)
    tracks = part(stage, TRACKS)
    sea = part(stage, SEA)
    for j in range(targets.size):
        advance_target(targets[j], tracks, swarm, sea, world, number + 1, split(key, TARGET_STREAM + j))
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
    run = part(stage, RUN)
    if world.disturbed:
        disturb(nature, swarm, targets, world, number, split(split(run.seed, 0), run.run))
    if world.mortal:
        update_presence(swarm, world, number)
    sense(swarm, targets, nature.effects, part(stage, SEA), world, key)
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


@phase
def look_at_links(stage, number, first, frame, key):
    """Keep whom the agents from `first` on will hear in the coming step, which does not begin.

    In the sequential order agents move one after the other: of later ones, whom they would hear if they were first.
    """
    frames = part(stage, FRAMES)
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    radio = part(stage, RADIO)
    scratch = part(stage, SCRATCH)
    links = scratch.links
    find_links(scratch, world, swarm, radio, part(stage, NATURE).effects, part(stage, SEA), number, first)
    count_heard(links, world.agents)
    settle_links(links, world, swarm, radio, first, key)
    keep_links(frames, frame, links, first, world.agents)
    return 0


_IN_ORDER = (
    sense_all,
    record_frame,
    link,
    settle,
    record_links,
    move_agents,
    measure,
    move_targets,
    come_to_rest,
    look_at_links,
)


def addresses() -> Addresses:
    """Compile the phases, or load them from the cache.

    Raises
    ------
    PluginError : what an installed package counts or moves cannot be compiled
    """
    with plugin_errors():
        where: list[Any] = [each.address() for each in _IN_ORDER]
    return Addresses(*where)
