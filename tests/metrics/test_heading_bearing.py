"""phi: who moves toward the target, and who does not move."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from coasting import coasting
from shoal.metrics.heading_bearing import CENTERS, bin_of, is_stationary, which_stationary

FAR = (9.0, 9.0)


def bins_of(simulation, fleet=0):
    """Which bins hold agents after one step."""
    simulation.advance(1)
    return np.repeat(np.arange(11), simulation.tally.histogram.sum(axis=0)[fleet]).tolist()


def bin_of_one(place, velocity, **options):
    """The bin of one agent; another, of a fleet of its own, stands aside."""
    return bins_of(coasting([place, FAR], [velocity, (0, 0)], makes=[(1, 1.0), (1, 1.0)], **options))


class TestBins:
    """11 bins centered at -1, -0.8, ..., 1, the outer two half as wide."""

    def test_centers(self):
        assert pytest.approx(np.arange(-5, 6) / 5) == CENTERS
        assert [bin_of(phi) for phi in CENTERS] == list(range(11))

    @pytest.mark.parametrize("edge", range(10))
    def test_edges_lie_midway(self, edge):
        phi = -0.9 + 0.2 * edge
        assert (bin_of(phi - 1e-9), bin_of(phi + 1e-9)) == (edge, edge + 1)

    @given(phi=st.floats(-1.0, 1.0))
    def test_are_the_nearest_center(self, phi):
        assert abs(CENTERS[bin_of(phi)] - phi) <= 0.1 + 1e-12

    @pytest.mark.parametrize(("phi", "index"), [(-1.0 - 1e-15, 0), (1.0 + 1e-15, 10), (-2.0, 0), (2.0, 10)])
    def test_rounding_beyond_one_falls_into_the_outer_ones(self, phi, index):
        assert bin_of(phi) == index


class TestPhi:
    """cos(heading, bearing), positions after the move."""

    @pytest.mark.parametrize(
        ("velocity", "index"), [((-1, 0), 10), ((1, 0), 0), ((0, 1), 5), ((-0.5, 0.3), 9), ((0.6, -0.8), 2)]
    )
    def test_toward_away_and_across(self, velocity, index):
        assert bin_of_one((5.0, 0.0), velocity) == [index]

    @pytest.mark.parametrize("degrees", range(3, 180, 10))
    def test_at_any_angle(self, degrees):
        angle = math.radians(degrees)
        phi = math.cos(angle)
        velocity = (-math.cos(angle), math.sin(angle))
        assert bin_of_one((1e6, 0.0), velocity, **{"area.width": 1e7}) == [int((phi + 1.1) / 0.2)]

    def test_an_agent_that_passes_the_target_in_this_step_moves_away_from_it(self):
        assert bin_of_one((0.04, 0.0), (-1, 0)) == [0]

    def test_an_agent_exactly_at_the_target_has_no_bearing(self):
        simulation = coasting([(0.0, 0.0), FAR], [(1, 0), (0, 0)], makes=[(1, 1.0), (1, 1.0)], targets=[(0.1, 0.0)])
        assert bins_of(simulation) == [5]
        assert simulation.tally.stationary.sum(axis=0)[0] == 0

    def test_the_heading_is_the_one_before_the_wall(self):
        """Pressing north-east on the east wall, sliding north."""
        assert bin_of_one((10.0, 0.0), (0.6, 0.6), targets=[(10.0, 9.0)]) == [9]

    def test_the_speed_limit_does_not_turn_the_heading(self):
        assert bin_of_one((5.0, 0.0), (-50, 30)) == [9]

    def test_the_nearest_target_counts(self):
        assert bin_of_one((5.0, 0.0), (-1, 0), targets=[(0.0, 0.0), (7.0, 0.0)]) == [0]
        assert bin_of_one((5.0, 0.0), (-1, 0), targets=[(9.0, 0.0), (2.0, 0.0)]) == [10]

    def test_a_target_that_is_not_there_does_not_count(self):
        simulation = coasting([(5.0, 0.0), FAR], [(-1, 0), (0, 0)], [(0, 0), (6, 0)], makes=[(1, 1.0), (1, 1.0)])
        with simulation.edit() as now:
            now.targets["present"] = [1, 0]
        assert bins_of(simulation) == [10]

    def test_without_any_target_nothing_is_counted(self):
        simulation = coasting([(5.0, 0.0), FAR], [(-1, 0), (0, 0)])
        with simulation.edit() as now:
            now.targets["present"] = 0
        assert bins_of(simulation) == []
        assert simulation.tally.stationary.sum() == 0

    def test_each_agent_counts_in_its_fleet(self):
        places, velocities = [(5, 0), (5, 1), (-5, 0)], [(-1, 0), (-1, 0), (-1, 0)]
        simulation = coasting(places, velocities, makes=[(2, 1.0), (1, 1.0)])
        assert bins_of(simulation) == [10, 10]
        assert simulation.tally.histogram.sum(axis=0)[1].tolist() == [1] + [0] * 10


class TestStationary:
    """Slower than a tenth of one's own top speed: phi = 0."""

    @pytest.mark.parametrize(("speed", "still"), [(0.0, 1), (0.0999, 1), (0.1001, 0), (1.0, 0)])
    def test_is_below_a_tenth(self, speed, still):
        simulation = coasting([(5.0, 0.0), FAR], [(-speed, 0), (1, 0)], makes=[(1, 1.0), (1, 1.0)])
        assert bins_of(simulation) == [5 if still else 10]
        assert simulation.tally.stationary.sum(axis=0).tolist() == [still, 0]

    @pytest.mark.parametrize("max_speed", [1.0, 2.6, 0.3])
    def test_exactly_a_tenth_moves(self, max_speed):
        assert not is_stationary(0.1 * max_speed, 0.0, max_speed)
        assert is_stationary(np.nextafter(0.1 * max_speed, 0.0) * (1 - 1e-12), 0.0, max_speed)

    def test_is_of_ones_own_top_speed(self):
        simulation = coasting([(5, 0), (5, 3)], [(-0.2, 0), (-0.2, 0)], makes=[(1, 1.0), (1, 2.6)])
        assert bins_of(simulation) == [10]
        assert simulation.tally.stationary.sum(axis=0).tolist() == [0, 1]

    def test_an_agent_pressing_on_the_wall_is(self):
        simulation = coasting([(10.0, 0.0), FAR], [(1, 0), (1, 0)], makes=[(1, 1.0), (1, 1.0)])
        assert bins_of(simulation) == [5]
        assert simulation.swarm.vx[0] == 0.0
        assert simulation.tally.stationary.sum(axis=0).tolist() == [1, 0]

    def test_an_agent_sliding_along_the_wall_heads_where_it_wanted(self):
        """Its heading is the velocity before the wall, though it moves along it."""
        simulation = coasting([(10.0, 0.0), FAR], [(0.8, 0.6), (1, 0)], makes=[(1, 1.0), (1, 1.0)])
        assert bins_of(simulation) == [1]  # phi = -0.8 or so
        assert (simulation.swarm.vx[0], simulation.swarm.vy[0]) == pytest.approx((0.0, 0.6))
        assert simulation.tally.stationary.sum() == 0

    def test_frames_are_judged_by_the_same_rule(self):
        vx = np.array([[0.0, 0.0999, 0.1001], [0.26, 0.0, 1.0]])
        still = which_stationary(vx, np.zeros((2, 3)), np.array([1.0, 1.0, 1.0]))
        assert still.tolist() == [[True, True, False], [False, True, False]]
