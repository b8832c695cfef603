"""What agents want that are to come home: top speed, and to arrive."""

import math

import pytest

from shoal.compiler.kernel import plain
from shoal.world.motion import maneuvered
from shoal.world.orders import homeward

homeward, maneuvered = plain(homeward), plain(maneuvered)
FREE = (math.inf, math.inf)  # no limit of acceleration, none of turn
STEP = 0.1


def test_far_away_it_is_top_speed_straight_home():
    assert homeward(30.0, -40.0, 2.0, *FREE, STEP) == pytest.approx((1.2, -1.6))


def test_the_last_step_ends_at_home_and_there_nothing_is_wanted():
    vx, vy = homeward(0.06, 0.08, 2.0, *FREE, STEP)
    assert (vx * STEP, vy * STEP) == pytest.approx((0.06, 0.08))
    assert homeward(0.0, -0.0, 2.0, *FREE, STEP) == (0.0, 0.0)
    assert homeward(0.0, 0.0, 2.0, 1.0, 1.0, STEP) == (0.0, 0.0)


@pytest.mark.parametrize("turn", [math.inf, 0.5])
@pytest.mark.parametrize("change", [math.inf, 0.4])
def test_whoever_can_neither_turn_nor_brake_at_once_arrives_too(turn, change):
    x, y, vx, vy = -3.0, 1.0, 0.0, 2.0
    for _ in range(600):
        wanted = homeward(-x, -y, 2.0, change, turn, STEP)
        vx, vy = maneuvered(vx, vy, *wanted, turn * STEP, change * STEP)
        x, y = x + vx * STEP, y + vy * STEP
    assert math.hypot(x, y) < 2.0 * STEP  # within one step of it
