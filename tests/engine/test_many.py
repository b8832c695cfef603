"""Many agents: whom each hears is found by lists, and no bit of a run tells."""

import numpy as np
import pytest

from shoal.core.errors import ScenarioError
from shoal.run import build
from shoal.run.simulation import Simulation
from shoal.scenario.load import load

CASES = {
    "as it is": {},
    "few agents": {"agents": 64, "network.neighbors": 10},
    "many agents": {"agents": 1000, "steps": 12},
    "short, late and lost": {
        "network.range": 5.0, "network.loss": 0.2, "network.delay": 2, "losses": [{"step": 5, "count": 40}],
        "fleets.BoB-1.position_error": 0.5,
    },
    "piled up, and k adapts": {
        "fleets.BoB-0.start": "corner", "fleets.BoB-1.start": "corner", "fleets.BoB-0.false_alarm_probability": 0.05,
        "network.adaptive": {"fewest": 3, "most": 20, "patience": 2.0},
    },
}  # fmt: skip


def run(monkeypatch, fewest, **changes):
    monkeypatch.setattr(build, "FEWEST_LISTED", fewest)
    scenario = load("oceans2020", **{"agents": 200, "steps": 40, "density": "keep"} | changes)
    simulation = Simulation(scenario)
    return simulation, simulation.advance(scenario.steps, every=1)


@pytest.mark.parametrize("changes", CASES.values(), ids=CASES)
def test_lists_and_distances_give_the_same_bits(monkeypatch, changes):
    pairs, frames = run(monkeypatch, 10**9, **changes)
    lists, listed = run(monkeypatch, 2, **changes)
    assert pairs.world.listed == 0 < lists.world.listed
    for name in ("x", "y", "vx", "vy", "command_x", "engaged", "neighbors", "links"):
        assert np.array_equal(getattr(frames, name), getattr(listed, name)), name
    for name, one, other in zip(pairs.tally._fields, pairs.tally, lists.tally, strict=True):
        assert np.array_equal(one, other), name
    assert np.array_equal(pairs.look().links, lists.look().links)


def test_lists_make_room_when_k_grows(monkeypatch):
    pairs, lists = (run(monkeypatch, fewest, steps=5)[0] for fewest in (10**9, 2))
    for each in (pairs, lists):
        with each.edit() as now:
            now.swarm.neighbors[:200] = 33
    assert np.array_equal(pairs.advance(3, every=1).links, lists.advance(3, every=1).links)


@pytest.mark.parametrize(
    ("changes", "where"),
    [
        ({"motion.update_order": "sequential"}, "motion.update_order"),
        ({"network.hops": 3, "network.range": 5.0}, "network"),
        ({"network.neighbors": 6000}, "network.neighbors"),
        ({"strategy": "global-pso"}, "network.neighbors"),
    ],
)
def test_what_needs_all_distances_has_a_limit(changes, where):
    with pytest.raises(ScenarioError) as error:
        Simulation(load("oceans2020", **{"agents": 20_000, "density": "keep", "steps": 1} | changes))
    assert error.value.args[0] == where
    assert "10,000 agents" in str(error.value)
