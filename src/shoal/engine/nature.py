"""What nature does in a step: phases that only runs with disturbances, a sea, a coast or radios that relay or keep
reports compile, and others call.

See phases.py for what a phase is given.
"""

from shoal.compiler.kernel import kernel
from shoal.compiler.phase import phase
from shoal.compiler.placed import part
from shoal.core.draws import split
from shoal.engine.stage import NATURE, RADIO, RUN, SCRATCH, SEA, SWARM, TARGETS, WORLD
from shoal.world.disturbances.dispatch import disturb
from shoal.world.motion import add_drift, sail, sail_coast
from shoal.world.neighbors import as_single
from shoal.world.placement import launch
from shoal.world.radio import arrival_key, lose_reports, said, spoken
from shoal.world.reception import measure_relayed, recall, relay, want_nearest
from shoal.world.sea.sea import carry, span
from shoal.world.sea.sight import Places, hide_behind_land
from shoal.world.targets.afloat import drift, stop_at_land


@phase
def disturb_all(stage, number, first, batch, key):
    """Disturbances say what they do in the step."""
    run = part(stage, RUN)
    swarm, targets = part(stage, SWARM), part(stage, TARGETS)
    disturb(part(stage, NATURE), swarm, targets, part(stage, WORLD), number, split(split(run.seed, 0), run.run))
    return 0


@phase
def hide(stage, number, first, batch, key):
    """Land hides others from the agents from `first` on: as waves went when the others spoke."""
    world = part(stage, WORLD)
    swarm = part(stage, SWARM)
    radio = part(stage, RADIO)
    scratch = part(stage, SCRATCH)
    reports = said(radio, swarm, number)
    places = Places(reports.x, reports.y, radio.range_square)
    if world.inexact:  # reports tell what is believed; waves go by where all are
        places = Places(swarm.x, swarm.y, radio.range_square)
    land, sight = part(stage, SEA).land, scratch.sight
    if world.single:
        hide_behind_land(as_single(scratch.links), sight, places, land, swarm.neighbors, first, world.agents)
    else:
        hide_behind_land(scratch.links, sight, places, land, swarm.neighbors, first, world.agents)
    return 0


@phase
def receive(stage, number, first, keeps, key):
    """Reports are lost on their way to the agents from `first` on, others are relayed, and older ones kept."""
    agents = part(stage, WORLD).agents
    swarm = part(stage, SWARM)
    radio = part(stage, RADIO)
    scratch = part(stage, SCRATCH)
    links = scratch.links
    if radio.loss > 0.0:
        lose_reports(links, radio, arrival_key(radio, part(stage, RUN), number), first, agents)
    relay(links, scratch.hops, scratch.words, radio.hops, agents)
    measure_relayed(links, scratch.hops, said(radio, swarm, number), swarm, agents)
    if radio.max_age > 0:
        recall(links, radio, swarm, spoken(radio, number), keeps != 0, agents)
    want_nearest(links, swarm.neighbors, agents)
    return 0


@phase
def sail_all(stage, number, first, batch, key):
    """Water and wind carry the agents from `first` on, and land stops them."""
    world = part(stage, WORLD)
    last = min(first + part(stage, SCRATCH).leader.size, world.agents)
    _sail(
        part(stage, SWARM),
        part(stage, NATURE).effects,
        part(stage, SEA),
        part(stage, SCRATCH),
        world,
        number,
        first,
        last,
    )
    return 0


@kernel
def _sail(swarm, effects, sea, scratch, world, number, first, last):
    """Move agents first..last by what they command and by their drift."""
    time_step = world.time_step
    drift_x, drift_y = swarm.drift_x, swarm.drift_y
    if not world.flowing:
        for i in range(first, last):
            drift_x[i] = 0.0
            drift_y[i] = 0.0
    else:
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
def drift_targets(stage, number, first, batch, key):
    """Water and wind add to the coming displacements of targets."""
    world, sea, targets = part(stage, WORLD), part(stage, SEA), part(stage, TARGETS)
    for j in range(targets.size):
        drift(targets[j], sea, world, number)
    return 0


@phase
def stop_target(stage, number, j, batch, key):
    """Land stops target j, which was where scratch says."""
    scratch = part(stage, SCRATCH)
    stop_at_land(part(stage, TARGETS)[j], part(stage, SEA).shore, scratch.a[0], scratch.b[0])
    return 0


@phase
def launch_agent(stage, where, i, batch, key):
    """Put an agent at sea that would start on land; where : index into PLACES."""
    launch(part(stage, SWARM), i, part(stage, SEA).shore, where, part(stage, WORLD), key)
    return 0
