"""A heading that diffuses."""

import numpy as np
import pytest

from scenarios import fleets, scenario
from shoal.run.simulation import Simulation


@pytest.mark.parametrize("persistence", [2.0, 8.0])
def test_the_mean_cosine_of_the_turn_falls_exponentially(persistence):
    """exp(-t / persistence), within four standard errors."""
    count = 1000
    changes = {"fleets": fleets((count, 1.0)), "area.width": 1e5, "area.height": 1e5}
    chosen = {"strategy": {"name": "random-walk", "persistence": persistence}, **changes}
    simulation = Simulation(scenario("oceans2020", chosen))
    start = simulation.memories.memory["heading"][:count].copy()
    for time in (1.0, 2.0, 4.0):
        simulation.advance(round(10 * time) - simulation.number)
        cosines = np.cos(simulation.memories.memory["heading"][:count] - start)
        assert cosines.mean() == pytest.approx(np.exp(-time / persistence), abs=4 * cosines.std() / np.sqrt(count))


def test_agents_start_in_all_directions():
    count = 1000
    simulation = Simulation(scenario("oceans2020", {"strategy": "random-walk", "fleets": fleets((count, 1.0))}))
    heading = simulation.memories.memory["heading"][:count]
    assert abs(np.exp(1j * heading).mean()) < 3 / np.sqrt(count)
