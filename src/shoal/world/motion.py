"""The one place where positions change: speed limit, step, walls."""

import math

from shoal.compiler.kernel import kernel


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
def limit_maneuver(swarm, first, last, time_step):
    """Limit how far the wanted velocity of agents first..last turns in a step, then how much it changes, in place."""
    for i in range(first, last):
        vx, vy = swarm.vx[i], swarm.vy[i]
        wanted_x, wanted_y = swarm.command_x[i], swarm.command_y[i]
        angle = math.atan2(vx * wanted_y - vy * wanted_x, vx * wanted_x + vy * wanted_y)
        most = swarm.max_turn_rate[i] * time_step
        if abs(angle) > most and vx * vx + vy * vy > 0.0:
            heading = math.atan2(vy, vx) + (most if angle > 0.0 else -most)
            speed = math.sqrt(wanted_x * wanted_x + wanted_y * wanted_y)
            wanted_x = speed * math.cos(heading)
            wanted_y = speed * math.sin(heading)
        change_x = wanted_x - vx
        change_y = wanted_y - vy
        change = math.sqrt(change_x * change_x + change_y * change_y)
        most = swarm.max_acceleration[i] * time_step
        limited = change > most
        swarm.command_x[i] = vx + most / change * change_x if limited else wanted_x
        swarm.command_y[i] = vy + most / change * change_y if limited else wanted_y


@kernel
def move(position, velocity, command, clamp, time_step):
    """Advance one axis by a time-step and stop at the wall, where the velocity becomes the displacement really made.

    An agent that starts outside the wall is put inside, which is no motion of its own: it counts from the wall on.
    """
    for i in range(position.size):
        here = position[i]
        free = here + command[i] * time_step
        there = min(max(free, -clamp), clamp)
        inside = min(max(here, -clamp), clamp)
        velocity[i] = command[i] if there == free else (there - inside) / time_step
        position[i] = there
