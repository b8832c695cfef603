"""What agents know is what they hear in the coming step, the nearest first."""

import numpy as np
import pytest

from scenarios import scenario
from shoal.core.links import unpacked
from shoal.learn.episodes import Episodes
from shoal.learn.spec import Act, Observe
from shoal.run.simulation import Simulation
from shoal.scenario.crew import crew_of

RADIO = {"neighbors": 9, "range": 6.0, "loss": 0.3}


@pytest.mark.parametrize("network", [{"neighbors": 8}, RADIO], ids=["ideal", "limited"])
def test_reports_are_of_those_that_the_simulation_links(network):
    chosen = scenario("oceans2020", {"steps": 30, "network": network})
    env = Episodes(chosen, 1, Observe(), Act(), {"engaged": 1.0})
    env.reset()
    simulation = Simulation(chosen, crew=crew_of(chosen).puppets())
    rng = np.random.default_rng(3)
    for _ in range(20):
        wanted = rng.uniform(-1, 1, (1, 50, 2)).astype(np.float32)
        env.step(wanted)
        with simulation.edit() as now:
            now.swarm.memory[:50] = simulation.swarm.max_speed[:50, None] * wanted[0].astype(float)
        simulation.advance(1)
    frame = simulation.look()
    links, x, y = unpacked(frame.links[0]), frame.x[0], frame.y[0]
    reports = env.observations[0, :, 6:].reshape(50, -1, 6)
    for i in range(50):
        heard = np.flatnonzero(links[i])
        order = heard[np.argsort((x[heard] - x[i]) ** 2 + (y[heard] - y[i]) ** 2, kind="stable")]
        assert reports[i, :, 0].sum() == len(order)
        mine = reports[i, : len(order)]
        assert mine[:, 1] == pytest.approx((x[order] - x[i]) / 10.0, abs=1e-6)
        assert mine[:, 3] == pytest.approx(frame.vx[0, order] / 2.6, abs=1e-6)
        assert np.array_equal(mine[:, 5] > 0, frame.on_target[0, order])
        assert not reports[i, len(order) :].any()
    own = env.observations[0, :, :6]
    assert own[:, 0] == pytest.approx(x / 10.0, abs=1e-6)
    assert own[:, 5] == pytest.approx(simulation.swarm.max_speed[:50] / 2.6, abs=1e-6)


def test_a_subset_of_the_fields_is_in_the_order_of_their_names():
    chosen = scenario("oceans2020", {"steps": 30, "network.neighbors": 8})
    every, some = (
        Episodes(chosen, 1, observe, Act(), {"engaged": 1.0})
        for observe in (Observe(), Observe(own=("vy", "x"), report=("on_target", "dy"), reports=3))
    )
    every.reset()
    some.reset()
    columns = [every.names.index(name) for name in some.names]
    assert some.names[:4] == ["own.x", "own.vy", "report.0.dy", "report.0.on_target"]
    assert np.array_equal(some.observations, every.observations[..., columns])
