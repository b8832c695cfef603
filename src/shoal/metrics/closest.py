"""How close agents come to each other: does repulsion keep them from colliding?"""

from shoal.compiler.kernel import kernel

EVERY = 25  # steps between two looks: a hundredth of the time of a run


@kernel
def tally_closest(tally, swarm, agents, number):
    """Keep the smallest squared distance [m^2] between two agents that are there, at the start of every 25th step."""
    if number % EVERY != 0:
        return
    least = tally.closest[0]
    for i in range(agents):
        x = swarm.x[i]
        y = swarm.y[i]
        if swarm.alive[i] > 0.0:
            for j in range(i):
                dx = swarm.x[j] - x
                dy = swarm.y[j] - y
                square = dx * dx + dy * dy
                if square < least and swarm.alive[j] > 0.0:
                    least = square
    tally.closest[0] = least
