"""The one place where positions change: speed limit, step, walls."""

import math

from shoal.core.kernel import kernel


@kernel
def limit_speed(command_x, command_y, max_speed, divide):
    """Scale velocities above an agent's top speed down to it, in place.

    With `divide`, do what Algorithm 2 of the paper prints instead: v <- v / vmax for every agent, which never limits a
    1 m/s buoy and slows the others.
    """
    for i in range(command_x.size):
        limit = max_speed[i]
        speed = math.sqrt(command_x[i] * command_x[i] + command_y[i] * command_y[i])
        scale = 1.0 / limit if divide else limit / (speed if speed > limit else limit)
        command_x[i] *= scale
        command_y[i] *= scale


@kernel
def move(position, velocity, command, clamp, time_step):
    """Advance one axis by a time-step and stop at the wall, where the velocity becomes the displacement really made."""
    for i in range(position.size):
        here = position[i]
        free = here + command[i] * time_step
        there = min(max(free, -clamp), clamp)
        velocity[i] = command[i] if there == free else (there - here) / time_step
        position[i] = there
