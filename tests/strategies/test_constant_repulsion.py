"""Constant repulsion is knn-pso whose repulsion does not adapt."""

from scenarios import scenario
from shoal.run.simulation import Simulation


def after(strategy):
    simulation = Simulation(scenario("oceans2020", {"strategy": strategy}))
    simulation.advance(300)
    return simulation


def test_is_knn_pso_with_a_delta_of_zero_bit_for_bit():
    constant = after({"name": "constant-repulsion", "repulsion": 0.7, "inertia": 0.9})
    adaptive = after({"name": "knn-pso", "repulsion_start": 0.7, "inertia": 0.9, "delta": 0.0})
    assert constant.swarm.x.tobytes() == adaptive.swarm.x.tobytes()
    assert constant.swarm.on_target.any()
