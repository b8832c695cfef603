"""Where agents believe to be: satellite positions that are off by an error which lasts.

The error of each coordinate is a Gauss-Markov process: normal with the same standard deviation at any time, its
correlation falling as exp(-age / time). Gelb (ed.), Applied Optimal Estimation, MIT Press, 1974, 2.2.
"""

import math

from shoal.compiler.kernel import kernel
from shoal.core.draws import normal, split

_EAST = 1 << 23  # purposes that no strategy draws for
_NORTH = _EAST + 1


@kernel
def aged(error, size, memory, chance):
    """An error [m] one step later; `memory` is the share of it that is left, `chance` standard normal."""
    return memory * error + math.sqrt(1.0 - memory * memory) * size * chance


@kernel
def begin_errors(swarm, world, start_key):
    """Let every error begin as it is at any time."""
    for i in range(world.agents):
        key = split(start_key, i)
        swarm.error_x[i] = aged(0.0, swarm.position_error[i], 0.0, normal(key, _EAST))
        swarm.error_y[i] = aged(0.0, swarm.position_error[i], 0.0, normal(key, _NORTH))


@kernel
def age_errors(swarm, step_key, first, last):
    """Take the errors of agents first..last on by a step."""
    for i in range(first, last):
        key, size, memory = split(step_key, i), swarm.position_error[i], swarm.position_memory[i]
        swarm.error_x[i] = aged(swarm.error_x[i], size, memory, normal(key, _EAST))
        swarm.error_y[i] = aged(swarm.error_y[i], size, memory, normal(key, _NORTH))


@kernel
def locate(swarm, first, last):
    """Let agents first..last believe to be where they are, but for their errors."""
    for i in range(first, last):
        swarm.fix_x[i] = swarm.x[i] + swarm.error_x[i]
        swarm.fix_y[i] = swarm.y[i] + swarm.error_y[i]
