"""Meets a known target on its known way."""

import numpy as np
import pytest

from staging import put, staged, wanted

SPEED, REACH = 3.0, 1.0  # of the target [m/s], of the sensor [m]


def intercepting(agent, target, waypoint, near=100.0, top=1.0):
    """Where the first of two agents wants to go to meet a target on its way to a waypoint."""
    moving = {"kind": "waypoint", "radius": REACH, "speed": SPEED, "waypoint_reach": 0.5}
    simulation = staged(("lattice-intercept", {"reach": near}), [agent, (9, 9)], top=top, changes={"targets": [moving]})
    put(simulation, [agent, (9, 9)])
    way = np.subtract(waypoint, target) / np.hypot(*np.subtract(waypoint, target))
    with simulation.edit() as now:
        for name, value in (("", target), ("waypoint_", waypoint), ("heading_", way)):
            now.targets[f"{name}x"][0], now.targets[f"{name}y"][0] = value
    memory = simulation.memories.memory[0]
    return wanted(simulation)[0], way, np.array([memory["station_x"], memory["station_y"]])


@pytest.mark.parametrize("agent", [(2.5, 0.0), (-1.5, 4.0), (1.2, -1.0)])
@pytest.mark.parametrize("top", [1.0, 2.6])
def test_heads_for_the_point_that_it_can_see_just_as_the_target_comes(agent, top):
    """The ray cuts the way at p, and |p - x| = v t + reach with t = |p - target| / u."""
    target, waypoint = (0.0, -5.0), (0.0, 9.0)
    velocity, way, _ = intercepting(agent, target, waypoint, top=top)
    assert np.hypot(*velocity) == pytest.approx(top)
    lengths = np.linalg.solve(np.stack([way, -velocity / top], axis=1), np.subtract(agent, target))
    along, mine = lengths
    assert along > 0
    assert mine == pytest.approx(top * along / SPEED + REACH)


def test_goes_home_if_the_target_cannot_be_met():
    """It has passed already."""
    velocity, _, home = intercepting((2.5, 0.0), (0.0, 3.0), (0.0, 9.0))
    assert velocity == pytest.approx((home - (2.5, 0.0)) / np.hypot(*(home - (2.5, 0.0))))


def test_goes_home_if_the_meeting_point_is_far_from_its_station():
    velocity, _, home = intercepting((2.5, 0.0), (0.0, -5.0), (0.0, 9.0), near=0.1)
    assert velocity == pytest.approx((home - (2.5, 0.0)) / np.hypot(*(home - (2.5, 0.0))))


def test_goes_home_if_the_target_will_turn_before():
    velocity, _, home = intercepting((2.5, 0.0), (0.0, -5.0), (0.0, -4.0))
    assert velocity == pytest.approx((home - (2.5, 0.0)) / np.hypot(*(home - (2.5, 0.0))))
