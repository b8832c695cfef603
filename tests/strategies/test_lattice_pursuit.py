"""Pursues what comes near its station, and goes home."""

import numpy as np
import pytest

from staging import put, staged, wanted

HOME = (-4.1, 0.0)  # of the first of two agents: the middle of the western half of +- 8.2 m


def guards(target, place=HOME):
    simulation = staged(("lattice-pursuit", {"reach": 2.0}), [place, (4.1, 0.0)], targets=[target], top=1.0)
    memory = simulation.memories.memory[0]
    first = (memory["station_x"], memory["station_y"])
    assert first in ((pytest.approx(-4.1), 0.0), (pytest.approx(4.1), 0.0))
    if first[0] > 0:  # which of the two has which station does not matter
        put(simulation, [(4.1, 0.0), place])
    return wanted(simulation)[0 if first[0] < 0 else 1]


def test_a_target_within_reach_of_the_station_is_pursued_at_full_speed():
    assert guards((-2.9, 1.59)) == pytest.approx(np.array([1.2, 1.59]) / np.hypot(1.2, 1.59))


def test_one_that_is_farther_is_not():
    assert guards((-2.9, 1.61)) == pytest.approx([0.0, 0.0], abs=1e-9)


def test_the_distance_counts_from_the_station_not_from_the_agent():
    assert guards((-1.0, 0.0), place=(-2.0, 0.0)) == pytest.approx([-1.0, 0.0])


def test_a_target_that_is_not_there_is_not_pursued():
    simulation = staged("lattice-pursuit", [HOME, (4.1, 0.0)], targets=[(-4.1, 1.0)], top=1.0)
    with simulation.edit() as now:
        now.targets["present"] = 0
    put(simulation, [(0.0, 5.0), (0.0, -5.0)])
    memory = simulation.memories.memory[:2]
    home = np.stack([memory["station_x"], memory["station_y"]], axis=1) - [(0.0, 5.0), (0.0, -5.0)]
    assert wanted(simulation) == pytest.approx(home / np.hypot(*home.T)[:, None])
