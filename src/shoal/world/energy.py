"""What agents draw from their batteries; whose battery is empty is lost.

Power = hotel load + drag x speed^3 + curve(speed), at the speed through the water that an agent commands, after its
limits. Drag grows as the square of the speed, the power against it as the cube.
"""

import math

from shoal.compiler.kernel import kernel


@kernel
def between(points, values, at):
    """Value at a point [m/s], on straight lines between rising points; the outermost values beyond them."""
    last = points.size - 1
    if at >= points[last]:
        return values[last]
    for n in range(1, last + 1):
        if at < points[n]:
            share = (at - points[n - 1]) / (points[n] - points[n - 1])
            return values[n - 1] + max(share, 0.0) * (values[n] - values[n - 1])
    return values[last]


@kernel
def drawn(speed, hotel, drag, curve):
    """Power [W] at a speed [m/s]; curve : (2, P) speeds [m/s] and powers [W]."""
    return hotel + drag * speed * speed * speed + between(curve[0], curve[1], speed)


@kernel
def consume(swarm, world, number, first, last):
    """Take what a step costs from the batteries of agents first..last; whoever has no more leaves with the next."""
    for i in range(first, last):
        if swarm.alive[i] > 0.0:
            vx, vy = swarm.command_x[i], swarm.command_y[i]
            power = drawn(math.sqrt(vx * vx + vy * vy), swarm.hotel[i], swarm.drag[i], swarm.curve[swarm.fleet[i]])
            swarm.spent[i] = min(swarm.spent[i] + power * world.time_step, swarm.capacity[i])
            if swarm.spent[i] >= swarm.capacity[i]:
                swarm.leaves[i] = min(swarm.leaves[i], number + 1)
