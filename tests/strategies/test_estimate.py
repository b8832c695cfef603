"""The estimate is one for all that share it; its corrections are tested with encircle, in test_encircle.py."""

import pytest

from staging import memory_of, staged

FIELDS = ("x", "y", "vx", "vy", "speed", "contact", "was_on")
PLACES, TARGET = [(0.0, 0.0), (8.0, 8.0)], (0.5, 0.0)


def believed(strategy, x, velocity=0.0, **params):
    """What the first agent believes a step after it believed the target at (x, 4), which it is on."""
    simulation = staged((strategy, params), PLACES, targets=[TARGET])
    memory = memory_of(simulation)
    memory["x"][0], memory["y"][0], memory["vx"][0], memory["speed"][0] = x, 4.0, velocity, abs(velocity) or 1.0
    memory["contact"][0] = 0.0
    simulation.advance(1)
    return [float(memory_of(simulation)[field][0]) for field in FIELDS]


def test_encircle_and_cordon_believe_the_same():
    believed_by = [believed(each, 3.0, 2.0, learn=0.05) for each in ("encircle", "cordon")]
    assert believed_by[0] == believed_by[1]


@pytest.mark.parametrize("beyond", [0.0, 2.0])
def test_cordon_lets_it_go_beyond_where_agents_may_go(beyond):
    simulation = staged(("cordon", {"beyond": beyond}), [(0.0, 0.0), (8.0, 8.0)])
    memory = memory_of(simulation)
    memory["x"][0], memory["y"][0], memory["vx"][0], memory["speed"][0] = 9.9, 0.0, 30.0, 30.0
    memory["contact"][0] = 0.0
    simulation.advance(1)
    assert memory_of(simulation)["x"][0] == pytest.approx(10.0 + beyond)
