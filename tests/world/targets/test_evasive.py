"""A target that flees."""

import numpy as np
import pytest

from target_paths import path_of, turns

EVASIVE = {"kind": "evasive", "speed": 2.0, "sight": 5.0, "wall_sight": 1.0, "max_turn": 180.0}


def first_heading(buoys, start=(0.0, 0.0), heading=0.0, **changes):
    """Where it heads in its first step [rad]."""
    path, _ = path_of({**EVASIVE, **changes}, 2, start=start, heading=heading, buoys=buoys)
    return np.angle(path[1] - path[0])


def escape(start, points):
    """Sum of (x - x_p) / |x - x_p|^2, the plain way."""
    away = np.array([np.subtract(start, point) for point in points])
    total = (away / (away**2).sum(axis=1)[:, None]).sum(axis=0)
    return np.arctan2(total[1], total[0])


class TestEscape:
    """Along the sum of (x - x_p) / |x - x_p|^2 over the buoys within sight."""

    def test_from_one_buoy_straight_away(self):
        assert first_heading([(-3.0, 0.0), (9.0, 9.0)]) == pytest.approx(0.0)
        assert first_heading([(1.0, 1.0), (9.0, 9.0)]) == pytest.approx(-3 * np.pi / 4)

    @pytest.mark.parametrize("seed", range(5))
    def test_from_two_and_more_along_the_sum(self, seed):
        buoys = np.random.default_rng(seed).uniform(-3.0, 3.0, (seed + 2, 2))
        start = (0.5, -0.25)
        assert first_heading(buoys, start) == pytest.approx(escape(start, buoys))

    def test_the_nearer_count_more(self):
        assert first_heading([(1.0, 0.0), (0.0, 2.0)]) == pytest.approx(np.arctan2(-1 / 2, -1.0))

    def test_buoys_beyond_its_sight_do_not_count(self):
        assert first_heading([(3.0, 0.0), (0.0, 5.1)]) == pytest.approx(np.pi)

    def test_a_buoy_on_top_of_it_has_no_direction(self):
        assert first_heading([(0.0, 0.0), (0.0, 4.0)]) == pytest.approx(-np.pi / 2)

    def test_buoys_that_are_lost_do_not_count(self):
        """It turns from two as it leaves them, and keeps its heading once they are gone."""
        target = {**EVASIVE, "persistence": 1e12}
        staying, losing = (
            path_of(target, 6, start=(0, 0), heading=0.0, buoys=[(1.0, 0.0), (0.0, 2.0)], losses=losses)[0]
            for losses in ([], [{"step": 1, "count": 2}])
        )
        assert np.angle(np.diff(losing)) == pytest.approx(np.arctan2(-1 / 2, -1.0), abs=1e-4)
        assert np.ptp(np.angle(np.diff(staying))) > 0.05


class TestWalls:
    """Walls push as a buoy at their nearest point would, within the wall sight."""

    FAR = ((-9.0, -9.0), (-9.0, 9.0))

    def test_one(self):
        assert first_heading(self.FAR, start=(9.5, 0.0)) == pytest.approx(np.pi)

    def test_two_in_a_corner(self):
        """0.5 m from the east, 0.25 m from the north: along (-2, -4)."""
        assert first_heading(self.FAR, start=(9.5, 9.75)) == pytest.approx(np.arctan2(-4.0, -2.0))

    def test_and_buoys_add_up(self):
        start = (9.5, 0.0)
        expected = escape(start, [(8.0, 1.0), (10.0, 0.0)])
        assert first_heading([(8.0, 1.0), (-9.0, 9.0)], start) == pytest.approx(expected)

    def test_opposite_ones_push_by_their_distances(self):
        """In a channel 4 m wide, with a wall sight of 5 m: away from the nearer wall."""
        heading = first_heading(self.FAR, start=(0.0, 0.5), margin=8.0, wall_sight=5.0)
        assert heading == pytest.approx(-np.pi / 2)

    def test_on_the_wall_the_push_is_finite(self):
        assert first_heading(self.FAR, start=(10.0, 0.0)) == pytest.approx(np.pi)

    def test_it_stays_within(self):
        path, _ = path_of({**EVASIVE, "max_turn": 5.0, "speed": 8.0}, 3000)
        assert np.abs([path.real, path.imag]).max() <= 10.0


class TestTurning:
    """At most max_turn in a step; it wanders where nothing is in sight."""

    @pytest.mark.parametrize("most", [2.0, 30.0])
    def test_is_limited_while_it_flees(self, most):
        path, _ = path_of(
            {**EVASIVE, "max_turn": most}, 30, start=(0.0, 0.0), heading=0.0, buoys=[(2.0, 0.1), (9.0, 9.0)]
        )
        angles = np.degrees(np.abs(turns(path)))
        assert angles.max() <= most + 1e-9
        first = np.degrees(np.angle(path[1] - path[0]))
        assert first == pytest.approx(-most)

    def test_wanders_with_its_persistence_else(self):
        wide = {"area.width": 1e5, "area.height": 1e5}
        path, _ = path_of(
            {**EVASIVE, "persistence": 2.0}, 20_000, start=(0.0, 0.0), buoys=[(4e4, 4e4), (4e4, -4e4)], **wide
        )
        assert turns(path).std() == pytest.approx(np.sqrt(2 * 0.1 / 2.0), rel=0.03)

    def test_keeps_its_speed(self):
        path, _ = path_of(EVASIVE, 500, start=(0.0, 0.0), buoys=[(2.0, 0.0), (-2.0, 1.0)])
        inside = np.maximum(np.abs(path.real), np.abs(path.imag))[1:] < 9.7
        assert np.abs(np.diff(path))[inside] == pytest.approx(0.2)
