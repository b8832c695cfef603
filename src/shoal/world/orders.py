"""Orders that agents are under: to hold, or to come back to where they set out. What they want then."""

import math

from shoal.compiler.kernel import kernel

ORDERS = ("resume", "hold", "recall")  # by their numbers in Swarm.order; whoever resumes is under none
HOLD, RECALL = 1, 2


@kernel
def homeward(away_x, away_y, top, change, turn, time_step):
    """Velocity toward home [m/s]: at top speed, near it so slow that it arrives; none at home.

    The speed is at most what covers the distance in a step, what brakes to a stop within it, v = sqrt(2 a d), and what
    turns on a circle that is no wider than it, v = w d / 2.

    away_x, away_y : from the agent to its home [m]; top : speed [m/s]
    change : largest acceleration [m/s^2], turn : largest turn rate [rad/s]; inf for none
    """
    distance = math.sqrt(away_x * away_x + away_y * away_y)
    if distance == 0.0:
        return 0.0, 0.0
    speed = min(min(top, distance / time_step), min(math.sqrt(2.0 * change * distance), 0.5 * turn * distance))
    return speed / distance * away_x, speed / distance * away_y


@kernel
def obey(swarm, time_step, first, last):
    """Let agents first..last that are there want what their orders say, in place."""
    for i in range(first, last):
        if swarm.order[i] == HOLD:
            swarm.command_x[i] = 0.0
            swarm.command_y[i] = 0.0
        elif swarm.order[i] == RECALL and swarm.alive[i] > 0.0:
            swarm.command_x[i], swarm.command_y[i] = homeward(
                swarm.home_x[i] - swarm.fix_x[i],
                swarm.home_y[i] - swarm.fix_y[i],
                swarm.max_speed[i],
                swarm.max_acceleration[i],
                swarm.max_turn_rate[i],
                time_step,
            )
