"""A square spiral around a datum, again and again."""

import numpy as np
import pytest

from shoal.strategies.expanding_square import corner, rounds
from staging import plain, staged


def test_legs_grow_by_a_spacing_after_every_second_right_turn():
    corners = np.array([plain(corner)(float(leg)) for leg in range(13)])
    legs = np.diff(corners, axis=0)
    assert np.hypot(*legs.T).tolist() == [1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6]
    turns = legs[:-1, 0] * legs[1:, 1] - legs[:-1, 1] * legs[1:, 0]
    assert (turns < 0).all()  # to the right
    assert (legs[:-1] * legs[1:]).sum(axis=1).tolist() == [0] * 11


@pytest.mark.parametrize("side", [1.0, 2.9, 3.0, 3.1, 9.0, 20.0])
def test_rounds_are_the_fewest_that_cover_the_part(side):
    """m rounds of tracks 1 m apart cover a square of 2 m + 1."""
    m = plain(rounds)(side, 1.0)
    assert 2 * m + 1 >= side
    assert m == 1 or 2 * (m - 1) + 1 < side


def test_the_way_leads_through_all_corners_and_starts_again():
    """The slow one of two has a quarter of 20 m x 20 m: 10 m, two rounds of tracks 2 m apart cover it."""
    simulation = staged("expanding-square", [(0, 0), (0, 0)], top=[1.0, 3.0])
    datum = np.array([simulation.memories.memory["datum_x"][0], simulation.memories.memory["datum_y"][0]])
    assert datum == pytest.approx([-7.5, 0.0])  # the middle of the first quarter
    frames = simulation.advance(2000, every=1)
    leg = frames.memory["leg"][:, 0]
    reached = np.flatnonzero(np.diff(leg)) + 1  # the leg changes where a corner is reached
    assert leg[reached].tolist()[:12] == [1, 2, 3, 4, 5, 6, 7, 8, 9, 0, 1, 2]
    inside = [np.clip(datum + 2.0 * np.array(plain(corner)(number)), -10, 10) for number in [*range(10), *range(2)]]
    place = np.stack([frames.x[reached - 1, 0], frames.y[reached - 1, 0]], axis=1)
    assert np.hypot(*(place[:12] - inside).T).max() <= 0.1 + 1e-9
