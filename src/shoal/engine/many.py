"""The phases of a step that differ where there are many agents: whom each hears is in lists, see world/lists.py."""

from shoal.compiler.kernel import kernel
from shoal.compiler.phase import phase
from shoal.compiler.placed import part
from shoal.engine.frames import keep_links
from shoal.engine.stage import FRAMES, NATURE, RADIO, RUN, SCRATCH, SWARM, WORLD
from shoal.world.lists import Reception, list_nearest
from shoal.world.radio import arrival_key, said, spoken


@phase
def link_many(stage, number, first, batch, key):
    """Find out whom all agents hear, ties and losses settled."""
    _find(
        part(stage, SCRATCH).links,
        part(stage, WORLD),
        part(stage, SWARM),
        part(stage, RADIO),
        part(stage, NATURE).effects,
        part(stage, RUN),
        number,
    )
    return 0


@kernel
def _find(links, world, swarm, radio, effects, run, number):
    then = spoken(radio, number)
    most = links.lists.most[0]
    for i in range(world.agents):
        deaf = (world.disturbed and effects[i].hears <= 0.0) or (radio.limited and swarm.alive[i] <= 0.0)
        links.wanted[i] = 0 if deaf else min(swarm.neighbors[i], most)
        links.silent[i] = radio.limited and (then < swarm.joins[i] or then >= swarm.leaves[i])
    reception = Reception(radio.range_square, world.inexact, world.single, radio.loss, arrival_key(radio, run, number))
    list_nearest(links, said(radio, swarm, number), swarm, reception, world.agents)


@phase
def settle_many(stage, number, first, batch, key):
    """Nothing is left to settle."""
    return 0


@phase
def look_at_many(stage, number, first, frame, key):
    """Keep whom agents will hear in the coming step, which does not begin."""
    world = part(stage, WORLD)
    links = part(stage, SCRATCH).links
    _find(
        links,
        world,
        part(stage, SWARM),
        part(stage, RADIO),
        part(stage, NATURE).effects,
        part(stage, RUN),
        number,
    )
    keep_links(part(stage, FRAMES), frame, links, 0, world.agents)
    return 0
