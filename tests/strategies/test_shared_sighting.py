"""The freshest sighting, passed on from agent to agent."""

import numpy as np
import pytest

from staging import DT, chance, memory_of, put, staged, wanted

STILL = {"inertia": 0.0, "social": 0.0, "repulsion_step": 0.0}


def chain(**changes):
    """Six agents in a row who hear only those beside them; the first is on target."""
    row = [(2.0 * i - 5.0, 0.0) for i in range(6)]
    return staged(("shared-sighting", STILL), row, targets=[(-5, 0)], changes={"network.range": 2.5, **changes})


def tell(simulation, agent, x, y, time):
    """Let an agent know of a sighting."""
    memory, told = memory_of(simulation), simulation._swarm.told
    memory["sighting_x"][agent], memory["sighting_y"][agent], memory["sighting_time"][agent] = x, y, time
    told[agent] = simulation.swarm.memory[agent, : told.shape[1]]


def test_it_spreads_by_one_hop_in_a_step():
    simulation = chain()
    for number in range(1, 6):
        simulation.advance(1)
        knows = simulation.memories.memory["sighting_time"][:6] >= 0
        assert knows.tolist() == [True] * (number + 1) + [False] * (5 - number)


def test_all_know_the_place_and_when_it_was_true():
    simulation = chain()
    simulation.advance(9)
    memory = simulation.memories.memory[:6]
    assert (memory["sighting_x"] == [-5, *[-5] * 5]).all()
    np.testing.assert_allclose(memory["sighting_time"], DT * np.array([8, 8, 7, 6, 5, 4]))


def test_the_newest_wins_though_it_is_farther():
    simulation = staged(("shared-sighting", {**STILL, "max_age": 100.0}), [(0, 0), (1, 0), (9, 0)])
    simulation.advance(20)
    tell(simulation, 1, 1.0, 1.0, 1.2)
    tell(simulation, 2, 2.0, 2.0, 1.3)
    simulation.advance(1)
    assert simulation.memories.memory["sighting_x"][:3].tolist() == [2.0, 2.0, 2.0]


def test_who_is_on_target_for_the_first_time_beats_every_memory():
    simulation = staged(("shared-sighting", STILL), [(0, 0), (1, 0), (9, 0)], targets=[(9, 0)])
    put(simulation, [(0, 0), (1, 0), (0, 9)])
    simulation.advance(20)
    tell(simulation, 1, 1.0, 1.0, 1.9)
    put(simulation, [(0, 0), (1, 0), (9, 0)])
    simulation.advance(1)
    assert simulation.memories.memory["sighting_x"][:3].tolist() == [9.0, 9.0, 9.0]


def test_it_pulls_while_it_is_young():
    params = {**STILL, "social": 0.5, "max_age": 0.3}
    simulation = staged(("shared-sighting", params), [(0, 0), (0, 1)])
    tell(simulation, 0, 6.0, 8.0, 0.0)
    tell(simulation, 1, 6.0, 8.0, 0.0)
    for pulls in (True, True, True, False):
        put(simulation, [(0, 0), (0, 1)])
        share = 0.5 * chance(simulation, 0, 0) if pulls else 0.0
        assert wanted(simulation)[0] == pytest.approx([share * 6 / DT, share * 8 / DT])
