"""Parallel tracks over the whole area, shared by speed."""

import numpy as np
import pytest

from staging import staged

REACH = 1.0


def sweeping(tops, steps, **params):
    """Frames of agents with these top speeds in an area of 20 m x 20 m."""
    corner = [(-10, -10)] * len(tops)
    return staged(("parallel-track", params), corner, top=tops).advance(steps, every=1)


def assert_tracks(frames, agent, expected):
    """North and south it goes along these, a step to the side at most, and along each of them."""
    steep = np.abs(frames.vy[:, agent]) > 5 * np.abs(frames.vx[:, agent])
    away = np.abs(frames.x[steep, agent][:, None] - expected)
    assert away.min(axis=1).max() <= 0.3
    assert away.min(axis=0).max() <= 0.3


def test_parts_are_as_wide_as_speeds_and_tracks_lie_evenly_in_them():
    """Two agents share one row: 5 m and 15 m of 20 m, with tracks at most 2 m apart."""
    frames = sweeping([1.0, 3.0], 3000)
    assert_tracks(frames, 0, -10 + 5 * (np.arange(3) + 0.5) / 3)
    assert_tracks(frames, 1, -5 + 15 * (np.arange(8) + 0.5) / 8)


def test_a_larger_spacing_makes_fewer_tracks():
    assert_tracks(sweeping([1.0, 3.0], 3000, spacing=2.0), 1, -5 + 15 * (np.arange(4) + 0.5) / 4)


@pytest.mark.parametrize("tops", [[1.0, 1.0], [1.0, 2.6, 1.0, 2.6, 1.0], [0.5] * 4 + [3.0]])
def test_no_point_of_the_area_is_farther_from_a_track_than_the_sensor_sees(tops):
    """Half a spacing across the tracks, a reach beyond their ends."""
    frames = sweeping(tops, 4000)
    been = np.stack([frames.x.ravel(), frames.y.ravel()], axis=1)
    grid = np.linspace(-9.99, 9.99, 41)
    for x in grid:
        for y in grid:
            assert (np.abs(been - (x, y)).max(axis=1) <= REACH + 0.3).any()  # 0.3 m: what the fastest does in a step


def test_all_finish_a_sweep_in_nearly_the_same_time():
    """Parts as large as speeds: without turns, exactly; here the ways between tracks count too."""
    frames = sweeping([1.0, 3.0], 6000)
    times = [np.flatnonzero(np.diff(frames.memory["leg"][:, agent]) < 0)[0] for agent in (0, 1)]
    assert times[0] == pytest.approx(times[1], rel=0.15)
