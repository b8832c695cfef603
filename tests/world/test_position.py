"""Where agents believe to be."""

import numpy as np
import pytest

from scenarios import scenario, small
from shoal.run.simulation import Simulation
from shoal.world.position import aged

SIZE, TIME = 0.8, 2.0


def errors(time_step, seconds, agents=200):
    """Errors (K, agents) once a second."""
    changes = {"fleets.0.position_error": SIZE, "fleets.0.position_error_time": TIME, "time_step": time_step}
    simulation = Simulation(small(agents, 5, {"strategy": "lattice", **changes}))
    kept = []
    for _ in range(seconds):
        kept.append(simulation.swarm.error_x[:agents].copy())
        simulation.advance(round(1 / time_step))
    return np.array(kept)


def test_no_memory_is_a_new_error_and_a_whole_one_the_old():
    assert aged(3.0, 2.0, 0.0, 1.5) == 3.0
    assert aged(3.0, 2.0, 1.0, 1.5) == 3.0
    assert aged(3.0, 2.0, 0.6, 1.0) == pytest.approx(0.6 * 3.0 + 0.8 * 2.0)


@pytest.mark.parametrize("time_step", [0.1, 0.5])
def test_size_and_memory_do_not_depend_on_the_time_step(time_step):
    kept = errors(time_step, 30)
    assert kept.std() == pytest.approx(SIZE, rel=0.06)  # 6,000 errors, correlated over 2 s: some 1,500 independent
    assert kept[0].std() == pytest.approx(SIZE, rel=0.2)  # from the start
    correlation = (kept[1:] * kept[:-1]).mean() / (kept**2).mean()
    assert correlation == pytest.approx(np.exp(-1 / TIME), abs=0.06)


CHANGES = {"fleets.0.position_error": 3.0}


class TestBelief:
    """What is decided on and said is believed; what senses, is stopped and heard is there."""

    def test_is_off_by_the_error(self):
        simulation = Simulation(scenario("oceans2020", CHANGES))
        simulation.advance(5)
        swarm = simulation.swarm
        assert swarm.fix_x[:50].tolist() == (swarm.x[:50] + swarm.error_x[:50]).tolist()
        assert (swarm.error_x[:15] != 0).all()
        assert (swarm.error_x[15:50] == 0).all()  # the other fleet knows

    def test_is_what_neighbors_are_chosen_by(self):
        simulation = Simulation(scenario("oceans2020", {**CHANGES, "network.neighbors": 3}))
        swarm = simulation.swarm
        frame = simulation.look()
        x, y = swarm.fix_x[:50], swarm.fix_y[:50]
        square = (x[:, None] - x) ** 2 + (y[:, None] - y) ** 2
        np.fill_diagonal(square, np.inf)
        heard = np.unpackbits(frame.links[0], axis=1, bitorder="little")[:, :50].astype(bool)
        for i in range(50):
            assert sorted(np.flatnonzero(heard[i])) == sorted(np.argsort(square[i])[:3])

    def test_does_not_reach_farther(self):
        """Range goes by where agents are."""
        changes = {**CHANGES, "network.range": 6.0, "network.neighbors": "all"}
        simulation = Simulation(scenario("oceans2020", changes))
        swarm = simulation.swarm
        heard = np.unpackbits(simulation.look().links[0], axis=1, bitorder="little")[:, :50].astype(bool)
        x, y = swarm.x[:50], swarm.y[:50]
        near = np.hypot(x[:, None] - x, y[:, None] - y) <= 6.0
        np.fill_diagonal(near, False)
        assert (heard == near).all()

    def test_does_not_sense(self):
        simulation = Simulation(scenario("oceans2020", CHANGES))
        swarm, target = simulation.swarm, simulation.targets[0]
        near = np.hypot(swarm.x[:50] - target.x, swarm.y[:50] - target.y) <= 1.0
        assert (swarm.on_target[:50] == near).all()

    def test_where_everybody_knows_it_is_the_place_itself(self):
        swarm = Simulation(scenario("oceans2020")).swarm
        assert np.shares_memory(swarm.fix_x, swarm.x)
