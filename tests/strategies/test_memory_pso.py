"""PSO with a personal best of limited age."""

import pytest

from staging import DT, chance, places, put, staged, wanted


def lonely(**params):
    """Two agents that do not push each other and have no inertia."""
    return "memory-pso", {"inertia": 0.0, "repulsion_step": 0.0, **params}


def test_the_best_is_where_the_agent_itself_was_last_on_target():
    simulation = staged(lonely(social=0.0), [(3, 4), (-9, -9)], targets=[(3, 4.5)])
    simulation.advance(1)
    memory = simulation.memories.memory[0]
    assert (memory["best_x"], memory["best_y"], memory["best_time"]) == (3.0, 4.0, 0.0)


def test_it_pulls_by_a_random_share_of_the_way():
    simulation = staged(lonely(cognitive=0.4, social=0.0), [(3, 4), (-9, -9)], targets=[(3, 4.5)])
    simulation.advance(1)
    put(simulation, [(0, 0), (-9, -9)])
    share = 0.4 * chance(simulation, 0, 0)
    assert wanted(simulation)[0] == pytest.approx([share * 3 / DT, share * 4 / DT])


def test_it_expires_at_its_maximum_age():
    simulation = staged(lonely(max_age=0.5, social=0.0), [(3, 4), (-9, -9)], targets=[(3, 4.5)])
    simulation.advance(1)  # the best is of time 0
    pulled = []
    for _ in range(1, 8):
        put(simulation, [(0, 0), (-9, -9)])
        pulled.append(bool(wanted(simulation)[0].any()))
    assert pulled == [True] * 4 + [False] * 3  # at 0.1 to 0.4 s, not from 0.5 s on


def test_neighbors_on_target_pull_too():
    simulation = staged(lonely(social=0.6), [(0, 0), (5, 0)], targets=[(5, 0)])
    share = 0.6 * chance(simulation, 0, 1)
    assert wanted(simulation)[0] == pytest.approx([share * 5 / DT, 0.0])
    assert places(simulation)[1] == pytest.approx([5, 0])
