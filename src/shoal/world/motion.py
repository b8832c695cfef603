"""The one place where positions change: speed limit, step, walls; each a function of numbers, and a loop."""

import math

from shoal.compiler.kernel import kernel
from shoal.world.sea.land import clearance, sailed

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
    one through the water, see `made`.
    """
    free = place + (command * time_step + drift)
    there = min(max(free, -clamp), clamp)
    return there, made(place, command, drift, free, there, clamp, time_step)


@kernel
def made(place, command, drift, free, there, clamp, time_step):
    """Velocity along one axis [m/s] of an agent that went from `place` to `there`, and had gone to `free` [m].

    It is what the agent commands, through the water; where a wall or land stopped it, the displacement really made, at
    most what it commands. An agent that starts outside the wall is put inside, which is not its own motion: it counts
    from the wall on.
    """
    inside = min(max(place, -clamp), clamp)
    velocity = (there - inside) / time_step
    if drift != 0.0:
        velocity = min(max(velocity, -abs(command)), abs(command))
    return command if there == free else velocity


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
def sail_coast(swarm, drift_x, drift_y, shore, world, first, last):
    """Move agents first..last, in place, by what they command and by a drift (N,) [m/s], where land may stop them."""
    time_step = world.time_step
    for i in range(first, last):
        x, y, command_x, command_y = swarm.x[i], swarm.y[i], swarm.command_x[i], swarm.command_y[i]
        carried_x, carried_y = drift_x[i] * time_step, drift_y[i] * time_step
        free_x = x + (command_x * time_step + carried_x)
        free_y = y + (command_y * time_step + carried_y)
        there_x, there_y = sailed(shore, x, y, free_x, free_y)
        swarm.aground[i] = there_x != free_x or there_y != free_y
        walled_x = min(max(there_x, -world.clamp_x), world.clamp_x)
        walled_y = min(max(there_y, -world.clamp_y), world.clamp_y)
        if (walled_x != there_x or walled_y != there_y) and clearance(shore, walled_x, walled_y) < 0.0:
            walled_x, walled_y = x, y  # the wall would put it on land
        swarm.vx[i] = made(x, command_x, carried_x, free_x, walled_x, world.clamp_x, time_step)
        swarm.vy[i] = made(y, command_y, carried_y, free_y, walled_y, world.clamp_y, time_step)
        swarm.x[i], swarm.y[i] = walled_x, walled_y


@kernel
def add_drift(swarm, effects, time_step, first, last):
    """Add what disturbances do to the drift of agents first..last [m/s], in place."""
    for i in range(first, last):
        swarm.drift_x[i] += effects[i].drift_x / time_step
        swarm.drift_y[i] += effects[i].drift_y / time_step


@kernel
def sail(position, velocity, command, drift, clamp, time_step):
    """Move a block of agents (B,) along one axis, in place, by what they command and by a drift (B,) [m/s]."""
    for i in range(position.size):
        position[i], velocity[i] = moved(position[i], command[i], drift[i] * time_step, clamp, time_step)


@kernel
def note_drift(swarm, effects, time_step, first, last):
    """Let agents first..last know what disturbances added to their velocities [m/s], in place."""
    for i in range(first, last):
        swarm.drift_x[i] = effects[i].drift_x / time_step
        swarm.drift_y[i] = effects[i].drift_y / time_step


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
