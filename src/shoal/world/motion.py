"""The one place where positions change: speed limit, step, walls; each a function of numbers, and a loop."""

import math

from shoal.compiler.kernel import kernel

NO_DRIFT = -0.0  # adds nothing, not even to the sign of a zero


@kernel
def limited(vx, vy, max_speed, divide):
    """Scale a velocity above the top speed down to it [m/s].

    With `divide`, do what Algorithm 2 of the paper prints instead: v <- v / vmax for every agent, which never limits a
    1 m/s buoy and slows the others.
    """
    scale = speed_scale(vx, vy, max_speed, divide)
    return vx * scale, vy * scale


@kernel
def maneuvered(vx, vy, wanted_x, wanted_y, turn, change):
    """Limit how far a wanted velocity turns from the present one, then how much it changes.

    vx, vy, wanted_x, wanted_y [m/s]; turn : the most in a step [rad]; change : the most in a step [m/s]
    """
    angle = math.atan2(vx * wanted_y - vy * wanted_x, vx * wanted_x + vy * wanted_y)
    if abs(angle) > turn and vx * vx + vy * vy > 0.0:
        heading = math.atan2(vy, vx) + (turn if angle > 0.0 else -turn)
        speed = math.sqrt(wanted_x * wanted_x + wanted_y * wanted_y)
        wanted_x = speed * math.cos(heading)
        wanted_y = speed * math.sin(heading)
    change_x = wanted_x - vx
    change_y = wanted_y - vy
    size = math.sqrt(change_x * change_x + change_y * change_y)
    too_much = size > change
    return (
        vx + change / size * change_x if too_much else wanted_x,
        vy + change / size * change_y if too_much else wanted_y,
    )


@kernel
def moved(place, command, drift, clamp, time_step):
    """Advance along one axis by a time-step, Eq. 3, and stop at the wall: place [m] and velocity [m/s] after it.

    The displacement is the sum of what the agent commands and of what nature adds, `drift` [m]; its velocity stays the
    one through the water. At the wall it becomes the displacement really made, at most what it commands. An agent that
    starts outside the wall is put inside, which is not its own motion: it counts from the wall on.
    """
    free = place + (command * time_step + drift)
    there = min(max(free, -clamp), clamp)
    inside = min(max(place, -clamp), clamp)
    made = (there - inside) / time_step
    if drift != 0.0:
        made = min(max(made, -abs(command)), abs(command))
    return there, command if there == free else made


@kernel
def limit_speed(command_x, command_y, max_speed, divide):
    """Limit the velocities (B,) of a block of agents, in place."""
    for i in range(command_x.size):
        command_x[i], command_y[i] = limited(command_x[i], command_y[i], max_speed[i], divide)


@kernel
def speed_scale(vx, vy, max_speed, divide):
    """By what a wanted velocity is multiplied: 1 within the top speed [m/s], 1 / top speed with `divide`."""
    speed = math.sqrt(vx * vx + vy * vy)
    return 1.0 / max_speed if divide else max_speed / (speed if speed > max_speed else max_speed)


@kernel
def limit_maneuver(swarm, first, last, time_step):
    """Limit the maneuvers of agents first..last, in place."""
    for i in range(first, last):
        turn, change = swarm.max_turn_rate[i] * time_step, swarm.max_acceleration[i] * time_step
        swarm.command_x[i], swarm.command_y[i] = maneuvered(
            swarm.vx[i], swarm.vy[i], swarm.command_x[i], swarm.command_y[i], turn, change
        )


@kernel
def move(position, velocity, command, clamp, time_step):
    """Move a block of agents (B,) along one axis, in place, where nothing adds to what they command."""
    for i in range(position.size):
        position[i], velocity[i] = moved(position[i], command[i], NO_DRIFT, clamp, time_step)


@kernel
def move_adrift(position, velocity, command, drift, clamp, time_step):
    """Move a block of agents (B,) along one axis, in place, by what they command and by a drift (B,) [m]."""
    for i in range(position.size):
        position[i], velocity[i] = moved(position[i], command[i], drift[i], clamp, time_step)


@kernel
def slow_down(command_x, command_y, max_speed, share):
    """Limit the velocities (B,) of a block of agents to a share (B,) of their top speeds, in place."""
    for i in range(command_x.size):
        top = max_speed[i] * share[i]
        if top <= 0.0:
            command_x[i] = 0.0
            command_y[i] = 0.0
        elif share[i] < 1.0:
            command_x[i], command_y[i] = limited(command_x[i], command_y[i], top, False)
