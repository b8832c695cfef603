"""An even cover, and no motion once it is there."""

import numpy as np
import pytest

from scenarios import fleets, scenario
from shoal.run.simulation import Simulation


def covering(*makes, **params):
    """Fleets that go to their places in an area of 20 m x 20 m."""
    changes = {"strategy": {"name": "lattice", **params}, "fleets": fleets(*makes), "area.agent_margin": 0.0}
    return Simulation(scenario("oceans2020", {**changes, "network.neighbors": 1}))


def stations(simulation):
    memory = simulation.memories.memory[: simulation.scenario.agents]
    return np.stack([memory["station_x"], memory["station_y"]], axis=1)


def test_a_square_number_of_agents_stands_in_the_middles_of_equal_squares():
    simulation = covering((16, 1.0), spread=0.8)
    middles = [-6.0, -2.0, 2.0, 6.0]  # of 16 squares of 4 m in +- 8 m
    assert sorted(np.round(stations(simulation), 9).tolist()) == [[x, y] for x in middles for y in middles]


@pytest.mark.parametrize("agents", [2, 3, 7, 50, 199])
def test_all_places_differ_and_every_row_is_even(agents):
    simulation = covering((agents, 1.0), spread=1.0)
    rows = {}
    for x, y in np.round(stations(simulation), 9).tolist():
        rows.setdefault(y, []).append(x)
    counts = [len(row) for row in rows.values()]
    assert sum(len(set(row)) for row in rows.values()) == agents
    assert max(counts) - min(counts) <= 1
    for row in rows.values():
        cells = np.linspace(-10, 10, len(row) + 1)
        np.testing.assert_allclose(sorted(row), (cells[1:] + cells[:-1]) / 2, atol=1e-8)
    cells = np.linspace(-10, 10, len(rows) + 1)
    np.testing.assert_allclose(sorted(rows), (cells[1:] + cells[:-1]) / 2, atol=1e-8)


def test_fleets_are_spread_over_the_whole_area():
    """No quarter is without fast agents, and none has more than its share and a half."""
    fast = stations(covering((16, 2.6), (48, 1.0)))[:16]
    quarters = np.unique(fast > 0, axis=0, return_counts=True)[1]
    assert quarters.size == 4
    assert quarters.max() <= 6


def test_everybody_arrives_and_stays():
    simulation = covering((10, 1.0))
    simulation.advance(300)  # 30 m at 1 m/s: more than the diagonal
    place = np.stack([simulation.swarm.x[:10], simulation.swarm.y[:10]], axis=1)
    np.testing.assert_allclose(place, stations(simulation), atol=1e-12)
    simulation.advance(1)
    assert np.abs(simulation.swarm.command_x[:10]).max() < 1e-12
