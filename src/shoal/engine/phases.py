"""The parts of a step that know no strategy, each compiled once for all of them (see compiler/phase.py).

Every phase takes where the stage is, two integers and a key, and returns an integer.
"""

from typing import Any, NamedTuple

from shoal.compiler.phase import part, phase
from shoal.core.draws import TARGET_STREAM, split
from shoal.engine.frames import keep_frame
from shoal.engine.measure import measure_after_move, measure_before_move, measure_links
from shoal.engine.stage import FRAMES, RADIO, SCRATCH, SWARM, TALLY, TARGETS, TRACKS, WORLD
from shoal.world.motion import limit_maneuver, limit_speed, move
from shoal.world.neighbors import link_nearest, measure_distances, rank_heard, settle_ties
from shoal.world.presence import update_presence
from shoal.world.radio import adapt_degree, limit_links, lose_reports, said, send
from shoal.world.sensing import sense
from shoal.world.targets import advance_target


class Addresses(NamedTuple):
    """Where the machine code of each phase is."""

    look: Any
    perceive: Any
    link: Any
    settle: Any
    go: Any
    conclude: Any


@phase
def look(here, number, frame, step_key):
    """Keep the state at the start of a step as a frame."""
    world = part(here, WORLD)
    swarm = part(here, SWARM)
    targets = part(here, TARGETS)
    frames = part(here, FRAMES)
    if world.mortal:
        update_presence(swarm, world, number)
    sense(swarm, targets, world, step_key)
    keep_frame(frames, frame, number, world, swarm, targets)
    return 0


@phase
def perceive(here, number, batch, step_key):
    """Who is there, who is on target, and what is said."""
    world = part(here, WORLD)
    swarm = part(here, SWARM)
    radio = part(here, RADIO)
    targets = part(here, TARGETS)
    tally = part(here, TALLY)
    scratch = part(here, SCRATCH)
    active = update_presence(swarm, world, number) if world.mortal else world.agents
    engaged = sense(swarm, targets, world, step_key)
    measure_before_move(tally, batch, world, swarm, targets, engaged, active, number, scratch)
    if radio.delay > 0:
        send(radio, swarm, number)
    return 0


@phase
def link(here, number, first, step_key):
    """Find out whom the agents from `first` on hear."""
    world = part(here, WORLD)
    swarm = part(here, SWARM)
    radio = part(here, RADIO)
    scratch = part(here, SCRATCH)
    links = scratch.links
    last = first + links.reach.size
    reports = said(radio, swarm, number)
    measure_distances(links, reports.x, reports.y, swarm.x[first:last], swarm.y[first:last], first, world.agents)
    if radio.limited:
        limit_links(links, swarm, radio, first, world.agents, number)
        link_nearest(links, links.wanted, world.agents)
    else:
        link_nearest(links, swarm.neighbors[first:last], world.agents)
    rank_heard(links, world.agents)
    return 0


@phase
def settle(here, number, first, step_key):
    """Settle ties and lose reports; returns 1 if links changed after their influence was summed."""
    world = part(here, WORLD)
    swarm = part(here, SWARM)
    radio = part(here, RADIO)
    scratch = part(here, SCRATCH)
    links = scratch.links
    if radio.limited:
        changed = settle_ties(links, links.wanted, world.agents)
    else:
        changed = settle_ties(links, swarm.neighbors[first : first + links.reach.size], world.agents)
    if radio.loss > 0.0:
        lose_reports(links, radio, step_key, first, world.agents)
        changed = True
    if changed:
        rank_heard(links, world.agents)
    return 1 if changed else 0


@phase
def go(here, number, batch_first, step_key):
    """Move the agents from `first` on as their commands say, within their limits."""
    world = part(here, WORLD)
    swarm = part(here, SWARM)
    radio = part(here, RADIO)
    tally = part(here, TALLY)
    scratch = part(here, SCRATCH)
    first = batch_first & 0xFFFFFFFF
    batch = batch_first >> 32
    last = first + scratch.leader.size
    there = min(last, world.agents)
    command_x, command_y = swarm.command_x[first:last], swarm.command_y[first:last]
    measure_links(tally, batch, world, swarm, scratch, first, number)
    if radio.adaptive:
        adapt_degree(swarm, radio, scratch.links, said(radio, swarm, number), first, there, world)
    if world.inertial:
        limit_maneuver(swarm, first, there, world.time_step)
    limit_speed(command_x, command_y, swarm.max_speed[first:last], world.divide)
    move(swarm.x[first:last], swarm.vx[first:last], command_x, world.clamp_x, world.time_step)
    move(swarm.y[first:last], swarm.vy[first:last], command_y, world.clamp_y, world.time_step)
    return 0


@phase
def conclude(here, number, batch, step_key):
    """Measure where agents head; targets move."""
    world = part(here, WORLD)
    swarm = part(here, SWARM)
    targets = part(here, TARGETS)
    tracks = part(here, TRACKS)
    tally = part(here, TALLY)
    scratch = part(here, SCRATCH)
    measure_after_move(tally, batch, world, swarm, targets, scratch)
    for j in range(targets.size):
        advance_target(targets[j], tracks, swarm, world, number + 1, split(step_key, TARGET_STREAM + j))
    return 0


PHASES = Addresses(look, perceive, link, settle, go, conclude)
