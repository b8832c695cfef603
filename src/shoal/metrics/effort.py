"""Effort: the way that agents make, and a proxy of the energy it takes."""

import math

from shoal.compiler.kernel import kernel


@kernel
def tally_effort(tally, batch, world, swarm):
    """Add the way of every agent in this step [m], and the cube of its speed times the step [m^3/s^2].

    Drag grows like the square of the speed, so the power to overcome it grows like the cube: the proxy compares fleets
    and strategies, it is not joules.
    """
    for i in range(world.agents):
        square = swarm.vx[i] * swarm.vx[i] + swarm.vy[i] * swarm.vy[i]
        speed = swarm.alive[i] * math.sqrt(square)
        tally.distance[batch, i] += speed * world.time_step
        tally.cubes[batch, i] += speed * square * world.time_step
