"""Every strategy on every kind of target, on every network, with 2 to 200 agents."""

from itertools import combinations, product
from pathlib import Path

import numpy as np
import pytest

from scenarios import fleets, scenario
from shoal.run.simulation import Simulation
from shoal.strategies import CATALOGUE

STEPS = 40
MARGIN = 1.5
MOVING = {"radius": 1.0, "speed": 3.0}
TARGETS = {
    "waypoint": {"kind": "waypoint", **MOVING, "margin": 2.0, "waypoint_reach": 1.5},
    "line": {"kind": "line", **MOVING},
    "walk": {"kind": "walk", **MOVING},
    "levy": {"kind": "levy", **MOVING, "shortest": 1.0, "longest": 20.0},
    "evasive": {"kind": "evasive", **MOVING, "sight": 3.0, "wall_sight": 2.0},
    "drift": {"kind": "drift", "radius": 1.0, "speed": 0.5, "current_x": 1.0, "current_y": -0.5},
    "still": {"kind": "still", "radius": 1.0},
    "diving": {"kind": "line", **MOVING, "surface_time": 1.0, "dive_time": 1.0},
}
NETWORKS = {
    "k nearest": {},
    "range": {"range": 4.0},
    "range and loss": {"range": 6.0, "loss": 0.3},
    "delay": {"delay": 3},
    "all to all": {"neighbors": "all"},
    "adaptive k": {"adaptive": {"fewest": 1, "most": 6}},
    "loss and delay": {"loss": 0.3, "delay": 2},
}
SIZES = (2, 7, 50, 200)
STRATEGIES = sorted(name for name, known in CATALOGUE.items() if known.builtin)


def cases(strategy):
    """Every target once, with networks and sizes in turn: (target, network, agents)."""
    s = STRATEGIES.index(strategy)
    for t, target in enumerate(TARGETS):
        yield target, list(NETWORKS)[(t + s) % len(NETWORKS)], SIZES[(t - s) % len(SIZES)]


def made(strategy, target, network, agents, **changes):
    """Half of the agents are fast."""
    options = {"neighbors": min(5, agents - 1), **NETWORKS[network]}
    if "adaptive" in options:
        options["adaptive"] = {"fewest": 1, "most": min(6, agents - 1)}
    return scenario(
        "oceans2020",
        {
            "strategy": strategy,
            "fleets": fleets((agents // 2, 2.6), (agents - agents // 2, 1.0)),
            "network": options,
            "targets": [TARGETS[target]],
            "steps": STEPS,
            **changes,
        },
    )


def run(chosen):
    """The state at every step, and after the last."""
    simulation = Simulation(chosen)
    frames = simulation.advance(STEPS, every=1)
    return simulation, frames


def bits(simulation):
    """All that the run has come to, but for the network's memory."""
    return b"".join(part.tobytes() for part in (*simulation.swarm, *simulation.tally)) + simulation.targets.tobytes()


def assert_moves_as_it_may(simulation, frames):
    agents, swarm = simulation.scenario.agents, simulation.swarm
    top = swarm.max_speed[:agents]
    x, y = (np.vstack([old, new[:agents]]) for old, new in ((frames.x, swarm.x), (frames.y, swarm.y)))
    assert np.isfinite([x, y]).all()
    assert all(np.isfinite(field).all() for field in frames.memory.values())
    assert np.abs(x[1:]).max() <= 10.0 - MARGIN
    assert np.abs(y[1:]).max() <= 10.0 - MARGIN
    ways = np.hypot(np.diff(x[1:], axis=0), np.diff(y[1:], axis=0))  # the first step brings all inside
    assert (ways <= top * 0.1 * (1 + 1e-9)).all()
    assert (np.hypot(swarm.command_x, swarm.command_y)[:agents] <= top * (1 + 1e-12)).all()


def test_the_cases_pair_every_strategy_target_network_and_size_with_every_other():
    rows = [(strategy, *case) for strategy in STRATEGIES for case in cases(strategy)]
    parts = (STRATEGIES, TARGETS, NETWORKS, SIZES)
    for a, b in combinations(range(4), 2):
        assert {(row[a], row[b]) for row in rows} == set(product(parts[a], parts[b]))


@pytest.mark.parametrize("strategy", STRATEGIES)
class TestEveryStrategy:
    """Whatever the catalogue holds."""

    def test_moves_as_it_may_and_repeats_its_bits_whatever_ran_before(self, strategy):
        ends = {}
        for case in cases(strategy):
            simulation, frames = run(made(strategy, *case))
            assert_moves_as_it_may(simulation, frames)
            ends[case] = bits(simulation)
        for case in reversed(ends):
            assert bits(run(made(strategy, *case))[0]) == ends[case]

    def test_copes_with_targets_of_all_kinds_at_once(self, strategy):
        several = {"targets": list(TARGETS.values())}
        simulation, frames = run(made(strategy, "still", "k nearest", 50, **several))
        assert_moves_as_it_may(simulation, frames)
        assert frames.target_x.shape == (STEPS, len(TARGETS))

    def test_may_be_cut_into_pieces(self, strategy):
        whole, _ = run(made(strategy, "waypoint", "loss and delay", 16))
        cut = Simulation(made(strategy, "waypoint", "loss and delay", 16))
        for steps in (1, STEPS - 1):
            cut.advance(steps)
        assert bits(cut) == bits(whole)

    def test_says_what_it_is_and_where_it_comes_from(self, strategy):
        known = CATALOGUE[strategy]
        assert known.summary
        assert known.reference
        assert Path(known.source).is_file()
        assert all(known.memory.values())
