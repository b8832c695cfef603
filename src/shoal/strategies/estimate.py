"""An estimate of a target, that single bits correct: what `encircle` and `cordon` share.

The memory holds its place x, y [m], its velocity vx, vy and its speed [m/s]. Whoever is on target has the target within
reach, whoever is not has it outside: the estimate moves along the line to the agent as little as makes it agree.
"""

import math

from shoal.compiler.kernel import kernel


@kernel
def start(memory, x, y):
    """Begin an estimate at a place, with no heading."""
    memory.x = x
    memory.y = y
    memory.vx = 0.0
    memory.vy = 0.0


@kernel
def move_on(me, memory, beyond):
    """Move the estimate by a step; this far beyond where agents may go [m] it stays."""
    memory.x += memory.vx * me.time_step
    memory.y += memory.vy * me.time_step
    half_x = me.briefing.half_x + beyond
    half_y = me.briefing.half_y + beyond
    if abs(memory.x) > half_x:
        memory.x = math.copysign(half_x, memory.x)
        memory.vx = 0.0
    if abs(memory.y) > half_y:
        memory.y = math.copysign(half_y, memory.y)
        memory.vy = 0.0


@kernel
def correct(me, memory, x, y, wanted, learn):
    """Move the estimate along the line from (x, y) until it is `wanted` away [m]; turn its velocity, learn its speed.

    learn : share of a correction along the path that goes into the speed
    """
    distance = distance_to(memory, x, y)
    if distance < so_near(me) or wanted == distance:
        return
    change_x = (memory.x - x) * (wanted / distance - 1.0)
    change_y = (memory.y - y) * (wanted / distance - 1.0)
    speed = math.sqrt(memory.vx * memory.vx + memory.vy * memory.vy)
    along = (change_x * memory.vx + change_y * memory.vy) / max(speed, 1e-9)
    memory.speed = max(memory.speed + learn * along / me.time_step, _SLOWEST)
    memory.x += change_x
    memory.y += change_y
    memory.vx += change_x / me.time_step
    memory.vy += change_y / me.time_step
    speed = math.sqrt(memory.vx * memory.vx + memory.vy * memory.vy)
    if speed > 1e-9:
        memory.vx *= memory.speed / speed
        memory.vy *= memory.speed / speed


@kernel
def distance_to(memory, x, y):
    """From the estimate to a place [m]."""
    dx = memory.x - x
    dy = memory.y - y
    return math.sqrt(dx * dx + dy * dy)


@kernel
def so_near(me):
    """So near that there is no direction [m], above zero where nothing is reached, too."""
    return 1e-9 * me.briefing.reach + 1e-30


@kernel
def hear(me, heard, memory, known, learn):
    """Correct the estimate by what the leader and the agent itself sense; begin one if none is `known`."""
    reach = me.briefing.reach
    if me.on_target:
        if not known:
            start(memory, me.x, me.y)
        distance = distance_to(memory, me.x, me.y)
        correct(me, memory, me.x, me.y, reach if memory.was_on == 0.0 else min(distance, reach), learn)
        memory.contact = me.time
    elif known or heard.found:
        if heard.found:
            if not known:
                start(memory, heard.x, heard.y)
            within = min(distance_to(memory, heard.x, heard.y), reach)
            correct(me, memory, heard.x, heard.y, within, learn)
            memory.contact = me.time
        correct(me, memory, me.x, me.y, max(distance_to(memory, me.x, me.y), reach), learn)
    memory.was_on = 1.0 if me.on_target else 0.0


_SLOWEST = 0.01  # [m/s]
