"""A network as a strategy wants, agent by agent, what the network says of the environment's observations."""

import shutil
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from buoys import differences, tape_of
from scenarios import scenario
from shoal.core.errors import StrategyError
from shoal.learn.env import Act, Observe, VectorEnv
from shoal.run.simulation import Simulation

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = ROOT / "examples/learning/network_as_strategy.py"
STEPS = 60


def saved(folder, sizes):
    """The example beside a network with random weights of single precision; its layers."""
    rng = np.random.default_rng(3)
    layers = [
        (rng.normal(0, 2 / np.sqrt(a), (a, b)).astype(np.float32), rng.normal(0, 0.3, b).astype(np.float32))
        for a, b in pairwise(sizes)
    ]
    named = {f"{letter}{n}": part for n, layer in enumerate(layers) for letter, part in zip("wb", layer, strict=True)}
    np.savez(folder / "network_as_strategy.npz", length=10.0, speed=2.6, **named)
    return str(shutil.copy(EXAMPLE, folder)), layers


def outputs(layers, known):
    """What the network says of observations, (..., 54), as whoever trains it has it: in single precision."""
    for weights, bias in layers[:-1]:
        known = np.tanh(known @ weights + bias)
    return np.clip(known @ layers[-1][0] + layers[-1][1], -1.0, 1.0)


def limited(velocity, top):
    """As the engine does: not faster than the top speed."""
    return velocity * np.minimum(1.0, top / np.linalg.norm(velocity, axis=1, keepdims=True))


@pytest.fixture(scope="module")
def network(tmp_path_factory):
    """Compiled once: half a minute."""
    return saved(tmp_path_factory.mktemp("network"), (54, 12, 9, 2))


@pytest.mark.parametrize(
    "changes", [{"network.neighbors": 8, "network.loss": 0.3}, {"network.neighbors": 20}], ids=["few", "many"]
)
def test_every_agent_wants_what_the_network_says_of_its_observation(network, changes):
    file, layers = network
    chosen = scenario("oceans2020", {"steps": STEPS, **changes})
    simulation = Simulation(scenario("oceans2020", {"steps": STEPS, **changes, "strategy": {"file": file}}))
    env = VectorEnv(chosen, 1, observe=Observe(reports=8), act=Act(scaled=False))
    known, _ = env.reset(seed=chosen.seed)
    top = simulation.swarm.max_speed[: chosen.agents, None]
    heard = []
    for _ in range(STEPS):
        simulation.advance(1)
        wanted = np.array([simulation.swarm.command_x, simulation.swarm.command_y])[:, : chosen.agents].T
        np.testing.assert_allclose(wanted, limited(outputs(layers, known[0]) * top, top), rtol=0, atol=2e-5)
        heard.append(known[0, :, 6::6].sum(axis=1))
        known, *_ = env.step(wanted[None])
    assert np.ptp(wanted, axis=0).min() > 1.0  # it does not say the same of all
    few = changes["network.neighbors"] == 8
    assert (np.min(heard) < 4) == few, "reports are missing where some are lost, and nowhere else"
    assert np.max(heard) == 8


@pytest.mark.slow  # compiles what a buoy is: 20 s
def test_a_buoy_decides_as_the_engine_does(network):
    chosen = scenario("oceans2020", {"steps": 20, "network.neighbors": 8, "strategy": {"file": network[0]}})
    assert differences(tape_of(chosen, 20), chosen, (0, 14, 49), apart=1e-12) == []


@pytest.mark.parametrize("sizes", [(30, 4, 2), (54, 4, 3)])
def test_a_network_of_other_inputs_or_outputs_is_refused(sizes, tmp_path):
    file, _ = saved(tmp_path, sizes)
    Path(file).write_text(Path(file).read_text(encoding="utf-8") + f"# {sizes}\n", encoding="utf-8")
    with pytest.raises(StrategyError, match=f"{sizes[0]} inputs and {sizes[-1]} outputs, not 54 and 2"):
        scenario("oceans2020", {"strategy": {"file": file}})


def test_without_weights_it_says_who_writes_them(tmp_path):
    file = shutil.copy(EXAMPLE, tmp_path)
    Path(file).write_text(Path(file).read_text(encoding="utf-8") + "# alone\n", encoding="utf-8")
    with pytest.raises(StrategyError, match=r"network_as_strategy.npz"):
        scenario("oceans2020", {"strategy": {"file": str(file)}})
