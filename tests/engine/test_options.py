"""An option that is there but changes nothing leaves every bit as it is without it."""

import pytest

from scenarios import scenario
from shoal.run.simulation import Simulation

STEPS = 200
SEED = 3  # no two start so near each other that one wants to be faster than any limit
FLEETS = ("fleets.0", "fleets.1")
NEUTRAL = {
    "a range beyond the arena": {"network.range": 1e4},
    "a loss that never happens": {"network.loss": 1e-300},
    "a false alarm that never happens": {f"{fleet}.false_alarm_probability": 1e-300 for fleet in FLEETS},
    "a loss of agents after the end": {"losses": [{"step": STEPS + 1, "count": 10}]},
    "a lifetime beyond the end": {f"{fleet}.mean_lifetime": 1e12 for fleet in FLEETS},
    "limits beyond what agents do": {f"{fleet}.max_acceleration": 1e12 for fleet in FLEETS}
    | {f"{fleet}.max_turn_rate": 1e12 for fleet in FLEETS},
    "the swarm's k for each fleet": {f"{fleet}.neighbors": 20 for fleet in FLEETS},
    "a degree that adapts from 20 to 20": {"network.adaptive": {"fewest": 20, "most": 20}},
    "the swarm's strategy for each fleet": {f"{fleet}.strategy": "knn-pso" for fleet in FLEETS},
}


def bits(changes):
    """Places, velocities, targets and what the paper's metrics are made of, after a run."""
    simulation = Simulation(scenario("oceans2020", {"steps": STEPS, "seed": SEED, **changes}))
    simulation.advance(STEPS)
    swarm, tally = simulation.swarm, simulation.tally
    parts = [getattr(swarm, name)[:50] for name in ("x", "y", "vx", "vy", "memory")]
    parts += [getattr(tally, name) for name in ("on_target", "fluctuation", "histogram", "stationary", "watched")]
    return [part.tobytes() for part in (*parts, simulation.targets)]


@pytest.fixture(scope="module")
def plain():
    return bits({})


@pytest.mark.parametrize("order", ["synchronous", "sequential"])
@pytest.mark.parametrize("option", NEUTRAL)
def test_leaves_every_bit(option, order, plain):
    sequential = {"motion.update_order": order} if order == "sequential" else {}
    expected = bits(sequential) if sequential else plain
    assert bits({**NEUTRAL[option], **sequential}) == expected


def test_an_option_that_acts_does_not(plain):
    assert bits({"network.loss": 0.1}) != plain
