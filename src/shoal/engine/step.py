"""One time-step: sense, listen, decide, move, measure. Algorithm 2 of the paper."""

from typing import NamedTuple

import numpy as np

from shoal.core.agents import Heard, Own, aligned_zeros_kernel
from shoal.core.draws import TARGET_STREAM, split
from shoal.core.kernel import kernel
from shoal.engine.listen import choose_leaders, sum_influence
from shoal.metrics.heading_bearing import tally_heading_bearing
from shoal.metrics.time_on_target import tally_time_on_target
from shoal.metrics.velocity_fluctuation import tally_velocity_fluctuation
from shoal.strategies import contract
from shoal.world.motion import limit_speed, move
from shoal.world.neighbors import Links, link_nearest, measure_distances, new_links, settle_ties
from shoal.world.sensing import sense
from shoal.world.targets import advance_target


class Scratch(NamedTuple):
    """Working arrays of a rollout; nothing in them outlives a step but the guess in links.reach."""

    links: Links
    leader: np.ndarray
    a: np.ndarray
    b: np.ndarray
    c: np.ndarray


@kernel
def new_scratch(world, lanes):
    """Return scratch for blocks of agents that decide together: all of them, or one in the sequential order."""
    width = 1 if world.sequential else lanes
    return Scratch(
        new_links(world.agents, width),
        np.zeros(width, np.int64),
        aligned_zeros_kernel(lanes),
        aligned_zeros_kernel(lanes),
        aligned_zeros_kernel(lanes),
    )


@kernel
def step(world, swarm, targets, tracks, params, tally, batch, step_key, number, scratch):
    """Advance the world by time-step `number`."""
    engaged = sense(swarm, targets, world.agents)
    present = tally_time_on_target(tally, batch, targets, engaged)
    tally_velocity_fluctuation(tally, batch, swarm, world.agents, scratch.a)

    together = scratch.leader.size
    for first in range(0, world.agents, together):
        act(world, swarm, params, step_key, scratch, first, first + together)

    if present:
        tally_heading_bearing(tally, batch, swarm, world.agents, targets, scratch.a, scratch.b, scratch.c)
    for j in range(targets.size):
        advance_target(targets[j], tracks, world.time_step, number + 1, split(step_key, TARGET_STREAM + j))


@kernel
def act(world, swarm, params, step_key, scratch, first, last):
    """Agents first..last listen, all decide, then all move."""
    x, y = swarm.x[first:last], swarm.y[first:last]
    vx, vy = swarm.vx[first:last], swarm.vy[first:last]
    max_speed = swarm.max_speed[first:last]
    block = (x, y, vx, vy, swarm.on_target[first:last], max_speed)
    command_x, command_y = swarm.command_x[first:last], swarm.command_y[first:last]
    neighbors = swarm.neighbors[first:last]
    links, leader = scratch.links, scratch.leader
    rank, sum_x, sum_y = scratch.a, scratch.b, scratch.c

    measure_distances(links, swarm.x, swarm.y, x, y, first, world.agents)
    link_nearest(links, neighbors, world.agents)
    sum_influence(swarm, block, links, params, first, world.agents, world.time_step, sum_x, sum_y)
    if settle_ties(links, neighbors, world.agents):
        sum_influence(swarm, block, links, params, first, world.agents, world.time_step, sum_x, sum_y)
    choose_leaders(swarm, block, links, params, first, world.agents, world.time_step, leader, rank)

    decide(world, swarm, params, step_key, links.heard, leader, sum_x, sum_y, first, min(last, world.agents))
    limit_speed(command_x, command_y, max_speed, world.divide)
    move(x, vx, command_x, world.clamp_x, world.time_step)
    move(y, vy, command_y, world.clamp_y, world.time_step)


@kernel
def decide(world, swarm, params, step_key, count, leader, sum_x, sum_y, first, last):
    """Every agent asks its strategy for the velocity it wants."""
    for i in range(first, last):
        lane = i - first
        me = own(swarm, i, world.time_step)
        j = leader[lane] if leader[lane] >= 0 else i
        heard = Heard(
            leader[lane] >= 0,
            swarm.x[j],
            swarm.y[j],
            swarm.vx[j],
            swarm.vy[j],
            sum_x[lane],
            sum_y[lane],
            count[lane],
        )
        swarm.command_x[i], swarm.command_y[i] = contract.decide(me, heard, swarm.memory[i], params, split(step_key, i))


@kernel
def own(swarm, i, time_step):
    """What agent i knows of itself."""
    return Own(
        i,
        swarm.x[i],
        swarm.y[i],
        swarm.vx[i],
        swarm.vy[i],
        swarm.on_target[i],
        swarm.max_speed[i],
        time_step,
    )
