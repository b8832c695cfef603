"""Which agents are present: some are lost or join during a run."""

import math

from shoal.compiler.kernel import kernel
from shoal.core.draws import START_STEP, split, uniform

_LIFETIME_DRAW = 1 << 22  # purposes that no strategy draws for
_LOSS_DRAW = _LIFETIME_DRAW + 1


@kernel
def is_there(number, joins, leaves):
    """Whether an agent that joins and leaves at these steps is present at step `number`."""
    return joins <= number < leaves


@kernel
def lifetime(chance, mean):
    """An exponential lifetime by inversion, in the unit of its mean; `chance` is uniform in [0, 1)."""
    return -mean * math.log(1.0 - chance)


@kernel
def draw_lifetimes(swarm, world, lifetimes, run_key):
    """Let agents of fleets with a mean lifetime fail at a constant rate: set the step at which each leaves.

    lifetimes : (F,) mean of each fleet [s], 0 for none; run_key : of all chance of the run
    """
    for i in range(world.agents):
        mean = lifetimes[swarm.fleet[i]]
        if mean > 0.0:
            chance = uniform(split(split(run_key, START_STEP), i), _LIFETIME_DRAW)
            steps = lifetime(chance, mean) / world.time_step
            swarm.leaves[i] = swarm.joins[i] + 1 + int(min(steps, 1e15))


@kernel
def draw_losses(swarm, world, number, fleet, count, run_key):
    """Let `count` agents of a fleet (of all for -1) leave at step `number`: those there with the lowest lots."""
    for _ in range(count):
        chosen = -1
        lowest = 2.0
        for i in range(world.agents):
            lot = uniform(split(split(run_key, START_STEP), i), _LOSS_DRAW + number)
            there = is_there(number, swarm.joins[i], swarm.leaves[i])
            if there and (fleet == -1 or swarm.fleet[i] == fleet) and lot < lowest:
                chosen = i
                lowest = lot
        if chosen >= 0:
            swarm.leaves[chosen] = number


@kernel
def lose(swarm, number, agent):
    """Let an agent leave at step `number`, unless it left before."""
    swarm.leaves[agent] = min(swarm.leaves[agent], number)


@kernel
def update_presence(swarm, world, number):
    """Set which agents are alive at step `number` and return how many; the others lie still."""
    active = 0
    for i in range(world.agents):
        there = is_there(number, swarm.joins[i], swarm.leaves[i])
        swarm.alive[i] = 1.0 if there else 0.0
        active += there
        if not there:
            swarm.vx[i] = 0.0
            swarm.vy[i] = 0.0
    return active
