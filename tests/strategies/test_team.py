"""Strategies of single fleets."""

import numpy as np
import pytest

from shoal.core.errors import ScenarioError
from shoal.run.simulation import Simulation
from shoal.scenario.crew import crew_of
from shoal.scenario.load import read_table, scenario_from


def team(fast=None, slow=None, **changes):
    table = {**read_table("oceans2020"), "steps": 300, **changes}
    for fleet, chosen in zip(table["fleets"], (fast, slow), strict=True):
        if chosen:
            fleet["strategy"] = chosen
    return scenario_from(table)


def after(scenario, steps=300):
    simulation = Simulation(scenario)
    simulation.advance(steps)
    return simulation


def test_two_equal_strategies_are_one():
    plain = {**read_table("oceans2020")["strategy"]}
    assert crew_of(team(plain, plain)).params == crew_of(team()).params
    assert after(team(plain, plain)).swarm.x.tobytes() == after(team()).swarm.x.tobytes()


def test_two_equal_halves_of_a_team_move_as_one_would():
    """c differs by a number that changes nothing: repulsion_max, which a_R never reaches within 50 steps."""
    other = {**read_table("oceans2020")["strategy"], "repulsion_max": 1.4}
    mixed = after(team(None, other), 50)
    assert crew_of(mixed.scenario).params._fields == ("first", "rest", "until")
    assert mixed.swarm.x.tobytes() == after(team(), 50).swarm.x.tobytes()


def test_scouts_walk_as_they_would_alone_and_the_others_stand():
    mixed = after(team("random-walk", "lattice"))
    walking = after(team("random-walk", "random-walk"))
    standing = after(team("lattice", "lattice"))
    assert mixed.swarm.x[:15].tobytes() == walking.swarm.x[:15].tobytes()
    np.testing.assert_array_equal(mixed.swarm.x[15:50], standing.swarm.x[15:50])


def test_three_and_more_walk_as_each_would_alone():
    alone = ("random-walk", "lattice", "levy-walk")
    makes = [{"name": name, "count": 10, "max_speed": 1.0} for name in alone]

    def together(*names):
        fleets = [{**make, "strategy": name} for make, name in zip(makes, names, strict=True)]
        return after(scenario_from({**read_table("oceans2020"), "fleets": fleets}), 100).swarm.x[:30]

    mixed = together(*alone)
    for number, name in enumerate(alone):
        mine = slice(10 * number, 10 * number + 10)
        assert mixed[mine].tobytes() == together(name, name, name)[mine].tobytes(), name


def test_more_than_eight_in_turn_are_refused():
    makes = [
        {"name": str(number), "count": 1, "max_speed": 1.0, "strategy": ("lattice", "knn-pso")[number % 2]}
        for number in range(9)
    ]
    chosen = scenario_from({**read_table("oceans2020"), "fleets": makes, "network": {"neighbors": 1}})
    with pytest.raises(ScenarioError, match="more than 7 times"):
        crew_of(chosen)


def test_each_follows_whom_its_own_strategy_follows_and_remembers_its_own():
    mixed = after(team("encircle", "knn-pso"))
    memory = mixed.memories.memory
    assert (memory["speed"][:15] > 0).all()
    assert (memory["repulsion"][15:50] > 0).all()
    assert not memory["repulsion"][:15].any()
    assert not memory["speed"][15:50].any()


def test_a_wrong_parameter_is_named_with_its_fleet():
    with pytest.raises(ScenarioError, match=r"fleets\.1\.strategy\.socia"):
        team(None, {"name": "knn-pso", "socia": 1.0})
