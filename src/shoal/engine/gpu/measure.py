"""What is counted in a step, by a block of threads: every agent's share in its own thread, sums by the clerk.

The terms are those of the files of metrics. Whole numbers are added in any order; others are left in scratch arrays
and added by the clerk in the order of the agents, as on the processor. What this file does not name the clerk does.
"""

from typing import Any

import numba.cuda

from shoal.engine.measure import chained
from shoal.metrics.catalogue import MEASUREMENTS
from shoal.metrics.closest import EVERY as EVERY_CLOSEST
from shoal.metrics.closest import least_square
from shoal.metrics.coverage import count_cells, mark_cells
from shoal.metrics.effort import add_effort
from shoal.metrics.graph import EVERY as EVERY_GRAPH
from shoal.metrics.graph import add_graph, clustering_of
from shoal.metrics.heading_bearing import any_present, bin_of, correlate, is_stationary
from shoal.metrics.time_on_target import count_step
from shoal.metrics.velocity_fluctuation import add_deviations, deviate, mean_velocity

cuda: Any = numba.cuda  # it has no types that mypy sees
_device: Any = cuda.jit(device=True)

SHARED = {"time_on_target", "velocity_fluctuation", "closest", "coverage", "graph", "heading_bearing", "effort"}
_rest = [each for each in MEASUREMENTS if each.name not in SHARED]
_rest_before_move = chained(each.before_move for each in _rest)
_rest_linked = chained(each.linked for each in _rest)
_rest_after_move = chained(each.after_move for each in _rest)


@_device
def look_before_move(tally, step, world, swarm, scratch, i, agent, clerk):
    """Every agent's share of what is counted before the move, into scratch.a and scratch.b. All threads come here."""
    if clerk:
        scratch.d[0], scratch.d[1] = mean_velocity(swarm, world.agents)
    if agent:
        mark_cells(tally, step, world, swarm, i, i + 1)
        if step.number % EVERY_CLOSEST == 0:
            scratch.b[i] = least_square(swarm, i, tally.closest[0])
    cuda.syncthreads()
    if agent:
        deviate(scratch.a, swarm, scratch.d[0], scratch.d[1], i, i + 1)
    cuda.syncthreads()


@_device
def add_before_move(tally, step, world, swarm, targets, scratch, engaged):
    """The clerk's part: the sums."""
    count_step(tally, step, targets, engaged)
    add_deviations(tally, step, swarm, scratch.a)
    count_cells(tally, step)
    if step.number % EVERY_CLOSEST == 0:
        least = tally.closest[0]
        for i in range(world.agents):
            least = scratch.b[i] if scratch.b[i] < least else least
        tally.closest[0] = least
    _rest_before_move(tally, step, world, swarm, targets, scratch)


@_device
def look_at_graph(tally, step, world, swarm, scratch, i, agent, clerk):
    """The network as a graph, where it is looked at. All threads come here."""
    if step.number % EVERY_GRAPH == 0:
        if agent:
            scratch.a[i] = clustering_of(scratch.links, swarm.alive, world.agents, i)
        cuda.syncthreads()
        if clerk:
            add_graph(tally, step, world, swarm, scratch)
        cuda.syncthreads()


@_device
def add_linked(tally, step, world, swarm, targets, scratch):
    """The clerk's part of what is counted when agents have listened."""
    _rest_linked(tally, step, world, swarm, targets, scratch)


@_device
def add_own(tally, step, world, swarm, targets, scratch, i):
    """What agent i adds when it has moved: its effort, and where it heads."""
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
