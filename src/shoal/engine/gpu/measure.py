"""What is counted in a step, by a block of threads: every agent's share in its own thread, sums by the clerk.

The terms are those of the files of metrics. Whole numbers are added in any order; others are left in scratch arrays
and added by the clerk in the order of the agents, as on the processor. What this file does not name the clerk does.
"""

from typing import Any

import numba.cuda

from shoal.engine.measure import chained
from shoal.metrics.closest import EVERY as EVERY_CLOSEST
from shoal.metrics.contract import MOMENTS
from shoal.metrics.coverage import count_cells, mark_cells
from shoal.metrics.effort import add_effort
from shoal.metrics.graph import EVERY as EVERY_GRAPH
from shoal.metrics.graph import add_graph, join
from shoal.metrics.heading_bearing import any_present, bin_of, correlate, is_stationary
from shoal.metrics.time_on_target import count_step
from shoal.metrics.velocity_fluctuation import deviate

cuda: Any = numba.cuda  # it has no types that mypy sees
_device: Any = cuda.jit(device=True)

SHARED = {
    "messages",
    "time_on_target",
    "velocity_fluctuation",
    "closest",
    "coverage",
    "graph",
    "heading_bearing",
    "effort",
}
_rest_before_move, _rest_linked, _rest_after_move = (chained(moment, SHARED) for moment in MOMENTS)


@_device
def note_mean_velocity(scratch, swarm, world):
    """The mean velocity of all who are there, into scratch.d."""
    x, y, there = 0.0, 0.0, 0
    vx, vy, alive = swarm.vx, swarm.vy, swarm.alive
    j = 0
    while j < world.agents:
        x += vx[j]
        y += vy[j]
        there += 1 if not world.mortal or alive[j] > 0.0 else 0
        j += 1
    scratch.d[0], scratch.d[1] = x / max(there, 1), y / max(there, 1)


@_device
def _add_deviations(tally, step, world, swarm, size):
    """Add |u_i| of every agent, in order, by fleet."""
    alive = swarm.alive
    j = 0
    fleet = 0
    while fleet < swarm.fleet_end.size:
        total, there, end = 0.0, 0, swarm.fleet_end[fleet]
        while j < end:
            total += size[j]
            there += 1 if not world.mortal or alive[j] > 0.0 else 0
            j += 1
        tally.agent_steps[step.batch, fleet] += there
        tally.fluctuation[step.batch, fleet] += total
        fleet += 1


@_device
def look_before_move(tally, step, world, swarm, scratch, i):
    """Agent i's share of what is counted before the move, into scratch.a and scratch.b."""
    mark_cells(tally, step, world, swarm, i, i + 1)
    if step.number % EVERY_CLOSEST == 0:
        scratch.b[i] = _least_before(swarm, i, tally.closest[0])
    deviate(scratch.a, swarm, scratch.d[0], scratch.d[1], i, i + 1)


@_device
def add_before_move(tally, step, world, swarm, targets, scratch, engaged):
    """The clerk's part: the sums."""
    count_step(tally, step, targets, engaged)
    _add_deviations(tally, step, world, swarm, scratch.a)
    count_cells(tally, step)
    if step.number % EVERY_CLOSEST == 0:
        least = tally.closest[0]
        for i in range(world.agents):
            least = scratch.b[i] if scratch.b[i] < least else least
        tally.closest[0] = least
    _rest_before_move(tally, step, world, swarm, targets, scratch)


@_device
def _least_before(swarm, i, least):
    """The least of a square [m^2] and those of the distances from agent i to the present ones before it."""
    x = swarm.x[i]
    y = swarm.y[i]
    for j in range(i):
        dx = swarm.x[j] - x
        dy = swarm.y[j] - y
        square = dx * dx + dy * dy
        if square < least and swarm.alive[i] > 0.0 and swarm.alive[j] > 0.0:
            least = square
    return least


@_device
def look_at_graph(tally, step, world, swarm, scratch, room, i):
    """The network as a graph, where it is looked at. All threads come here."""
    if step.number % EVERY_GRAPH == 0:
        if i < world.agents:
            scratch.a[i] = _clustering_of(room, scratch.links.reach, swarm.alive, world.agents, i)
        cuda.syncthreads()
        if i == cuda.blockDim.x - 1:
            _add_graph(tally, step, world, swarm, scratch, room)
        cuda.syncthreads()


@_device
def _hears(room, reach, agents, j, i):
    """Whether agent i hears j."""
    return room[i * (agents + agents % 2 + 1) + j] <= reach[i]


@_device
def _clustering_of(room, reach, alive, agents, i):
    """Clustering of agent i."""
    count = 0
    pairs = 0
    for one in range(agents):
        if _hears(room, reach, agents, one, i) and alive[one] > 0.0:
            count += 1
            for other in range(one):
                both = _hears(room, reach, agents, other, i) and alive[other] > 0.0
                linked = _hears(room, reach, agents, one, other) or _hears(room, reach, agents, other, one)
                pairs += both and linked
    return 2 * pairs / (count * (count - 1)) if count > 1 else 0.0


@_device
def _add_graph(tally, step, world, swarm, scratch, room):
    """The clerk's part: who is in one part with whom, and the sum of all agents' clustering, which is in scratch.a."""
    reach, alive, part = scratch.links.reach, swarm.alive, scratch.leader
    for i in range(world.agents):
        part[i] = i
    total = 0.0
    for i in range(world.agents):
        total += scratch.a[i]
        for j in range(world.agents):
            if _hears(room, reach, world.agents, j, i) and alive[j] > 0.0:
                join(part, i, j)
    add_graph(tally, step.batch, alive, part, total, world.agents)


@_device
def add_linked(tally, step, world, swarm, targets, scratch):
    """The clerk's part of what is counted when agents have listened."""
    _rest_linked(tally, step, world, swarm, targets, scratch)


@_device
def add_own(tally, step, world, swarm, targets, scratch, i):
    """What agent i adds when it has moved: how many it heard, its effort, and where it heads."""
    if swarm.alive[i] > 0.0:
        cuda.atomic.add(tally.heard, step.batch, float(scratch.links.heard[i]))
    add_effort(tally, step, world, swarm, i, i + 1)
    if any_present(targets):
        correlate(swarm, targets, scratch, i, i + 1)
        if swarm.alive[i] > 0.0:
            fleet = swarm.fleet[i]
            cuda.atomic.add(tally.histogram, (step.batch, fleet, bin_of(scratch.c[i])), 1)
            if is_stationary(swarm.vx[i], swarm.vy[i], swarm.max_speed[i]):
                cuda.atomic.add(tally.stationary, (step.batch, fleet), 1)


@_device
def add_after_move(tally, step, world, swarm, targets, scratch):
    """The clerk's part of what is counted when all have moved."""
    _rest_after_move(tally, step, world, swarm, targets, scratch)
