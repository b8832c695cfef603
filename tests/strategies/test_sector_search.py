"""Three triangles through a datum, turned by 30 degrees each time."""

import numpy as np
import pytest

from shoal.strategies.sector_search import corner
from staging import plain, staged


def courses(legs):
    """Courses of the legs between way points [deg], clockwise from north, and their lengths."""
    way = np.diff([plain(corner)(float(leg)) for leg in range(legs + 1)], axis=0)
    return np.degrees(np.arctan2(way[:, 0], way[:, 1])) % 360, np.hypot(way[:, 0], way[:, 1])


def test_all_legs_are_one_radius_long():
    assert courses(107)[1] == pytest.approx(np.ones(107))


def test_every_turn_is_one_of_120_degrees_to_the_right_but_at_the_datum():
    course = courses(9)[0]
    assert course == pytest.approx([0, 120, 240, 240, 0, 120, 120, 240, 0], abs=1e-9) or course == pytest.approx(
        [0, 120, 240, 240, 360, 120, 120, 240, 360], abs=1e-9
    )


def test_the_next_pattern_is_turned_by_30_degrees():
    first, second = courses(18)[0].reshape(2, 9)
    assert np.cos(np.radians(second - first)) == pytest.approx(np.full(9, np.cos(np.pi / 6)))
    assert (np.sin(np.radians(second - first)) > 0).all()


def test_the_disc_is_as_large_as_the_part():
    """The faster of two has three quarters of 20 m x 20 m; the way points of its pattern lie on the disc's rim."""
    simulation = staged("sector-search", [(0, 0), (0, 0)], top=[1.0, 3.0])
    datum = np.array([simulation.memories.memory["datum_x"][1], simulation.memories.memory["datum_y"][1]])
    assert datum == pytest.approx([2.5, 0.0])
    frames = simulation.advance(1500, every=1)
    leg = frames.memory["leg"][:, 1]
    reached = np.flatnonzero(np.diff(leg)) + 1
    radius = np.sqrt(300 / np.pi)
    for step in reached[:9]:
        rim = np.clip(datum + radius * np.array(plain(corner)(leg[step] - 1)), -10, 10)
        assert np.hypot(frames.x[step - 1, 1] - rim[0], frames.y[step - 1, 1] - rim[1]) <= 0.3 + 1e-9
