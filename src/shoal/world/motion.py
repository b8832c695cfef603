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
        scale = speed_scale(command_x[i], command_y[i], max_speed[i], divide)
        command_x[i] *= scale
        command_y[i] *= scale


@kernel
def speed_scale(vx, vy, max_speed, divide):
    """By what a wanted velocity is multiplied: 1 within the top speed [m/s], 1 / top speed with `divide`."""
    speed = math.sqrt(vx * vx + vy * vy)
    return 1.0 / max_speed if divide else max_speed / (speed if speed > max_speed else max_speed)


@kernel
def limit_maneuver(swarm, first, last, time_step):
    """Limit how far the wanted velocity of agents first..last turns in a step, then how much it changes, in place."""
    for i in range(first, last):
        turn, change = swarm.max_turn_rate[i] * time_step, swarm.max_acceleration[i] * time_step
        swarm.command_x[i], swarm.command_y[i] = maneuvered(
            swarm.vx[i], swarm.vy[i], swarm.command_x[i], swarm.command_y[i], turn, change
        )


@kernel
def maneuvered(vx, vy, wanted_x, wanted_y, most_turn, most_change):
    """The velocity wanted, turned from the present one by `most_turn` [rad] at most, changed by `most_change` [m/s]."""
    angle = math.atan2(vx * wanted_y - vy * wanted_x, vx * wanted_x + vy * wanted_y)
    if abs(angle) > most_turn and vx * vx + vy * vy > 0.0:
        heading = math.atan2(vy, vx) + (most_turn if angle > 0.0 else -most_turn)
        speed = math.sqrt(wanted_x * wanted_x + wanted_y * wanted_y)
        wanted_x = speed * math.cos(heading)
        wanted_y = speed * math.sin(heading)
    change_x = wanted_x - vx
    change_y = wanted_y - vy
    change = math.sqrt(change_x * change_x + change_y * change_y)
    if change > most_change:
        return vx + most_change / change * change_x, vy + most_change / change * change_y
    return wanted_x, wanted_y


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
