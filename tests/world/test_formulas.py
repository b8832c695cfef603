"""The formulas of the world are functions of numbers: of one buoy, of one thread, and of every lane of the engine."""

import math

import numpy as np
import pytest

from shoal.world.motion import NO_DRIFT, limited, maneuvered, move, moved
from shoal.world.placement import PLACES, start
from shoal.world.presence import is_there, lifetime
from shoal.world.radio import adapted, degree_of
from shoal.world.sensing import within_reach


def test_a_velocity_above_the_top_speed_is_scaled_down_to_it():
    assert limited(3.0, 4.0, 2.5, False) == (1.5, 2.0)
    assert limited(0.3, 0.4, 2.5, False) == (0.3, 0.4)
    assert limited(3.0, 4.0, 2.5, True) == pytest.approx((1.2, 1.6))


def test_a_turn_is_limited_first_and_then_the_change():
    assert maneuvered(1.0, 0.0, 0.0, 1.0, math.pi, math.inf) == (0.0, 1.0)
    turned = maneuvered(1.0, 0.0, 0.0, 1.0, math.radians(30), math.inf)
    assert turned == pytest.approx((math.cos(math.radians(30)), 0.5))
    assert maneuvered(1.0, 0.0, 3.0, 0.0, math.pi, 0.5) == (1.5, 0.0)
    assert maneuvered(0.0, 0.0, 0.0, 1.0, 0.1, math.inf) == (0.0, 1.0)  # at rest any heading is free


def test_a_wall_makes_the_velocity_the_displacement_really_made():
    assert moved(1.0, 2.0, NO_DRIFT, 8.5, 0.5) == (2.0, 2.0)
    assert moved(8.0, 2.0, NO_DRIFT, 8.5, 0.5) == (8.5, 1.0)
    assert moved(10.0, 0.0, NO_DRIFT, 8.5, 0.5) == (8.5, 0.0)  # being put inside is not motion


def test_a_drift_adds_to_the_displacement_and_not_to_the_velocity_through_the_water():
    assert moved(1.0, 2.0, 0.25, 8.5, 0.5) == (2.25, 2.0)
    assert moved(8.0, 0.0, 1.0, 8.5, 0.5) == (8.5, 0.0)  # the wall stops the sum; what carries it is not its own motion
    assert moved(8.0, 0.5, 1.0, 8.5, 0.5) == (8.5, 0.5)


@pytest.mark.parametrize("place", [0.0, -0.0])
@pytest.mark.parametrize("command", [0.0, -0.0])
def test_no_drift_moves_no_bit(place, command):
    position, velocity = np.array([place]), np.zeros(1)
    move(position, velocity, np.array([command]), 8.5, 0.5)
    assert math.copysign(1.0, position[0]) == math.copysign(1.0, place + command * 0.5)


def test_the_rim_of_the_reach_is_within_it():
    assert within_reach(3.0, 4.0, 5.0)
    assert not within_reach(3.0, 4.0, np.nextafter(5.0, 0.0))


@pytest.mark.parametrize(
    ("place", "low", "high"), [("uniform", -1, 1), ("arena", -1, 1), ("center", -0.1, 0.1), ("corner", -1, -0.8)]
)
def test_starts_fill_their_part_of_the_arena(place, low, high):
    assert start(PLACES.index(place), -1.0, 1.0) == pytest.approx((low, high))


def test_an_agent_is_there_from_its_first_step_to_before_the_one_it_leaves_at():
    assert [is_there(number, 3, 5) for number in range(2, 7)] == [False, True, True, False, False]


def test_half_of_all_lifetimes_are_shorter_than_the_median():
    assert lifetime(0.5, 10.0) == pytest.approx(10.0 * math.log(2.0))


def test_k_follows_the_contact():
    assert adapted(0.5, 1, 0.1) == pytest.approx(0.55)
    assert [degree_of(contact, 10, 25) for contact in (0.0, 0.5, 1.0)] == [10, 18, 25]
