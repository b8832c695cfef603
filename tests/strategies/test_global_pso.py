"""Plain global-best PSO."""

import numpy as np
import pytest

from scenarios import scenario
from shoal.run.simulation import Simulation
from staging import DT, chance, staged, wanted


def test_is_the_social_term_of_knn_pso_among_all_without_repulsion():
    ends = []
    for strategy in ({"name": "global-pso"}, {"name": "knn-pso", "repulsion_step": 0.0}):
        simulation = Simulation(scenario("oceans2020", {"strategy": strategy, "network.neighbors": "all"}))
        simulation.advance(50)
        ends.append(simulation.swarm)
    np.testing.assert_allclose(ends[0].x, ends[1].x, rtol=1e-9)
    assert np.ptp(ends[0].vx[:50]) > 0


def test_hears_all_whatever_k_is():
    """The one on target is the farthest of all."""
    simulation = staged("global-pso", [(-9, 0), (-8, 0), (9, 0)], targets=[(9, 0)], changes={"network.neighbors": 1})
    share = 0.5 * chance(simulation, 0, 0)
    assert wanted(simulation)[0] == pytest.approx([share * 18 / DT, 0.0])
