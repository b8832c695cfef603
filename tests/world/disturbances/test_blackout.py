"""Agents of a fleet hear nobody while it lasts; the others hear them."""

import numpy as np

from scenarios import scenario
from shoal.run.simulation import Simulation


def heard_per_step(changes, steps=60):
    """Reports that arrive in each step."""
    simulation = Simulation(scenario(changes={"steps": 60, **changes}))
    heard = []
    for _ in range(steps):
        before = simulation.tally.heard.sum()
        simulation.advance(1)
        heard.append(int(simulation.tally.heard.sum() - before))
    return np.array(heard)


def test_a_fleet_hears_nobody_while_it_lasts():
    blackout = {"kind": "blackout", "fleet": "BoB-1", "since": 2.0, "until": 4.0}
    heard = heard_per_step({"disturbances": [blackout]})
    assert heard[:20].tolist() == heard[40:].tolist() == [50 * 20] * 20
    assert heard[20:40].tolist() == [35 * 20] * 20


def test_everybody_without_a_fleet_and_with_every_network():
    for changes in ({}, {"network.delay": 2, "network.loss": 0.2}, {"motion.update_order": "sequential"}):
        assert heard_per_step({**changes, "disturbances": [{"kind": "blackout"}]}, 10).sum() == 0


def test_one_that_never_begins_moves_no_bit():
    never = [{"kind": "blackout", "since": 1e6}, {"kind": "current", "east": 1.0, "since": 1e6}]
    calm, quiet = (Simulation(scenario(changes=changes)) for changes in ({}, {"disturbances": never}))
    for each in (calm, quiet):
        each.advance(500)
    for name in ("x", "y", "vx", "vy", "command_x", "on_target", "memory"):
        assert getattr(calm.swarm, name).tobytes() == getattr(quiet.swarm, name).tobytes(), name
    for name in calm.tally._fields:
        assert getattr(calm.tally, name).tobytes() == getattr(quiet.tally, name).tobytes(), name
