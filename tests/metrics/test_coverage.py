"""What agents pass through, on a grid of 32 x 32."""

import numpy as np
import pytest

from coasting import coasting
from scenarios import scenario, small
from shoal.metrics.coverage import CELLS, WINDOW, reachable
from shoal.metrics.summary import evaluate
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation


def metrics_of(simulation):
    """coverage [1], coverage_rate [m^2/s]"""
    facts = facts_of(simulation.scenario)
    return tuple(evaluate(name, simulation.tally, facts)[0] for name in ("coverage", "coverage_rate"))


def lattice(side):
    """side x side places, evenly over an arena of 20 m x 20 m."""
    across = 20.0 * ((np.arange(side) + 0.5) / side - 0.5)
    return [(x, y) for x in across for y in across]


class TestStill:
    """Agents that stay cover the cells that they are in, and nothing new."""

    @pytest.mark.parametrize("side", [2, 4, 8, 16])
    def test_a_lattice_covers_a_cell_each(self, side):
        simulation = coasting(lattice(side), np.zeros((side * side, 2)), steps=WINDOW)
        simulation.advance(WINDOW)
        assert metrics_of(simulation) == (side * side / CELLS**2, 0.0)

    def test_one_in_every_cell_covers_all(self):
        simulation = coasting(lattice(CELLS), np.zeros((CELLS**2, 2)), steps=WINDOW)
        simulation.advance(WINDOW)
        assert metrics_of(simulation)[0] == 1.0

    def test_many_in_one_cell_cover_it_once(self):
        simulation = coasting([(0.1, 0.1)] * 5, np.zeros((5, 2)), steps=WINDOW)
        simulation.advance(WINDOW)
        assert metrics_of(simulation)[0] == 1 / CELLS**2

    def test_the_range_of_sensors_does_not_count(self):
        changes = {"fleets.0.sensor_radius": 30.0}
        simulation = coasting(lattice(4), np.zeros((16, 2)), steps=WINDOW, **changes)
        simulation.advance(WINDOW)
        assert metrics_of(simulation)[0] == 16 / CELLS**2


class TestMoving:
    """A cell is covered by whoever is in it at the start of a step."""

    def test_a_straight_line_covers_its_cells(self):
        """Two buoys at 0.2 m/s over 1,000 steps of 0.1 s: one along 20 m, the other stays; 32 cells and one."""
        simulation = coasting([(-10.0, 0.3), (5.0, 5.0)], [(0.2, 0.0), (0.0, 0.0)], steps=WINDOW)
        simulation.advance(WINDOW)
        assert metrics_of(simulation)[0] == 33 / CELLS**2

    def test_the_rate_is_new_area_per_second(self):
        """In 100 steps of 0.1 s at 1 m/s: 10 m, 16 cells of 0.625 m x 0.625 m beyond the first."""
        simulation = coasting([(-9.99, 0.3), (5.0, 5.0)], [(1.0, 0.0), (0.0, 0.0)], steps=WINDOW)
        simulation.advance(WINDOW)
        assert metrics_of(simulation)[1] == pytest.approx(16 * 0.625**2 / 10.0)

    def test_the_fastest_of_the_paper_skip_no_cell(self):
        """26 cm a step."""
        places, velocities = [(-10.0, 0.3), (5.0, 5.0)], [(2.6, 0.0), (0.0, 0.0)]
        simulation = coasting(places, velocities, steps=WINDOW, makes=[(2, 2.6)])
        simulation.advance(WINDOW)
        assert metrics_of(simulation)[0] == 33 / CELLS**2

    def test_every_window_begins_anew(self):
        """In the first window a buoy crosses the arena, in the second it stays at the wall."""
        simulation = coasting([(-10.0, 0.3), (5.0, 5.0)], [(1.0, 0.0), (0.0, 0.0)], steps=2 * WINDOW)
        simulation.advance(2 * WINDOW)
        assert metrics_of(simulation)[0] == pytest.approx((33 + 2) / 2 / CELLS**2)

    def test_is_what_counting_the_frames_says(self):
        simulation = Simulation(scenario("oceans2020", {"steps": 2 * WINDOW}))
        frames = simulation.advance(2 * WINDOW, every=1)
        column, row = (np.clip((place + 10.0) // 0.625, 0, 31) for place in (frames.x, frames.y))
        cell = (32 * row + column).reshape(2, WINDOW, -1)
        covered = [np.unique(window).size for window in cell]
        fresh = [np.unique(window[:101]).size - np.unique(window[0]).size for window in cell]
        share, rate = metrics_of(simulation)
        assert share == np.mean(covered) / CELLS**2
        assert rate == pytest.approx(np.mean(fresh) / CELLS**2 * 400.0 / 10.0)


class TestAbsent:
    """Agents that are not there cover nothing."""

    def test_a_lost_one_covers_what_it_covered_before(self):
        simulation = Simulation(small(4, 1, {"losses": [{"step": 1, "count": 4}], "steps": WINDOW}))
        simulation.advance(WINDOW)
        assert metrics_of(simulation)[0] <= 4 / CELLS**2

    def test_short_runs_have_no_coverage(self):
        simulation = coasting([(0, 0), (5, 5)], np.zeros((2, 2)), steps=WINDOW - 1)
        simulation.advance(WINDOW - 1)
        assert np.isnan(metrics_of(simulation)[0])


class TestReachable:
    """The share of cells that agents can be in."""

    def test_without_a_margin_is_all(self):
        assert reachable(20.0, 30.0, 0.0) == 1.0

    def test_of_the_paper_is_28_of_32_along_each_side(self):
        assert reachable(20.0, 20.0, 1.5) == (28 / 32) ** 2

    def test_is_what_a_long_run_covers_at_most(self):
        simulation = Simulation(scenario("oceans2020", {"steps": 4 * WINDOW, "seed": 3}))
        simulation.advance(4 * WINDOW)
        covered = simulation.tally.covered[simulation.tally.windows > 0]
        assert covered.max() <= (28 / 32) ** 2
        assert covered.max() > 0.99 * (28 / 32) ** 2
