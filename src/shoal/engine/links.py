"""The phases of a step that find out who hears whom, by the distances of all pairs, in double and single precision."""

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.compiler.phase import enter, phase
from shoal.compiler.placed import part
from shoal.engine.frames import keep_links
from shoal.engine.stage import FRAMES, NATURE, PHASES, RADIO, RUN, SCRATCH, SWARM, WORLD
from shoal.world.neighbors import as_single, count_heard, link_nearest, measure_distances, rank_heard, settle_ties
from shoal.world.radio import arrival_key, deafen, hide_far_away, limit_links, lose_reports, said
from shoal.world.reception import collects


@phase
def link(stage, number, first, batch, key):
    """Find out whom the agents from `first` on hear."""
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    radio = part(stage, RADIO)
    links = part(stage, SCRATCH).links
    find_links(stage, links, world, swarm, radio, number, first, True)
    return 0


@kernel
def find_links(stage, links, world, swarm, radio, number, first, keeps):
    """Link the agents from `first` on to those whose reports may reach them, ties and losses aside.

    keeps : whether agents remember what they hear now; else this is but a look
    """
    phases = part(stage, PHASES)
    last = first + links.reach.size
    for lane in range(links.reach.size):
        links.wanted[lane] = swarm.neighbors[first + lane]  # one by one: numba would compile text for an array's error
    reports = said(radio, swarm, number)
    measure_distances(
        links, reports.x, reports.y, swarm.fix_x[first:last], swarm.fix_y[first:last], first, world.agents
    )
    if world.disturbed:
        deafen(links, part(stage, NATURE).effects, first, world.agents)
    range_square = radio.range_square
    if world.inexact:
        hide_far_away(links, swarm, range_square, first, world.agents)
        range_square = np.inf
    if world.coastal:
        enter(phases.hide, stage, number, first, 0, 0)
    if radio.limited:
        limit_links(links, swarm, radio, first, world.agents, number, range_square)
    if collects(radio):
        enter(phases.receive, stage, number, first, 1 if keeps else 0, 0)
    link_nearest(links, world.agents)
    rank_heard(links, world.agents)


@phase
def settle(stage, number, first, batch, key):
    """Settle ties and lose reports; returns 1 if links changed after their influence was summed."""
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    radio = part(stage, RADIO)
    scratch = part(stage, SCRATCH)
    return 1 if settle_links(scratch.links, world, swarm, radio, part(stage, RUN), number, first) else 0


@kernel
def settle_links(links, world, swarm, radio, run, number, first):
    """Settle ties, by how many are heard, and lose reports; return whether links changed."""
    changed = settle_ties(links, world.agents)
    if radio.loss > 0.0 and not collects(radio):
        lose_reports(links, radio, arrival_key(radio, run, number), first, world.agents)
        changed = True
    if changed:
        rank_heard(links, world.agents)
    return changed


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
    find_links(stage, links, world, swarm, radio, number, first, False)
    count_heard(links, world.agents)
    settle_links(links, world, swarm, radio, part(stage, RUN), number, first)
    keep_links(frames, frame, links, first, world.agents)
    return 0


@phase
def link_single(stage, number, first, batch, key):
    """The same in single precision."""
    links = as_single(part(stage, SCRATCH).links)
    find_links(stage, links, part(stage, WORLD), part(stage, SWARM), part(stage, RADIO), number, first, True)
    return 0


@phase
def settle_single(stage, number, first, batch, key):
    """The same in single precision."""
    links, run = as_single(part(stage, SCRATCH).links), part(stage, RUN)
    changed = settle_links(links, part(stage, WORLD), part(stage, SWARM), part(stage, RADIO), run, number, first)
    return 1 if changed else 0


@phase
def look_at_single(stage, number, first, frame, key):
    """The same in single precision."""
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    radio = part(stage, RADIO)
    links = as_single(part(stage, SCRATCH).links)
    find_links(stage, links, world, swarm, radio, number, first, False)
    count_heard(links, world.agents)
    settle_links(links, world, swarm, radio, part(stage, RUN), number, first)
    keep_links(part(stage, FRAMES), frame, part(stage, SCRATCH).links, first, world.agents)
    return 0
