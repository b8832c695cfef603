"""The smallest distance between two agents of a run, looked at every 25 steps."""

import math

import numpy as np
import pytest

from coasting import coasting
from scenarios import small
from shoal.metrics.closest import EVERY
from shoal.metrics.summary import evaluate
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation


def closest(simulation):
    """[m]"""
    return evaluate("closest", simulation.tally, facts_of(simulation.scenario))[0]


def test_of_agents_at_rest_it_is_the_distance_of_the_nearest_two():
    simulation = coasting([(0.0, 0.0), (3.0, 4.0), (-6.0, 0.0)], np.zeros((3, 2)), steps=1)
    simulation.advance(1)
    assert closest(simulation) == pytest.approx(5.0)


def test_two_at_one_place_have_none():
    simulation = coasting([(1.0, 1.0), (1.0, 1.0)], np.zeros((2, 2)), steps=1)
    simulation.advance(1)
    assert closest(simulation) == 0.0


def test_it_is_the_least_of_the_whole_run():
    """One passes the other at 0.5 m in step 50, 5 m before and after."""
    simulation = coasting([(0.0, 0.5), (-5.0, 0.0)], [(0.0, 0.0), (1.0, 0.0)], steps=101)
    simulation.advance(101)
    assert closest(simulation) == pytest.approx(0.5, abs=1e-6)


def test_only_every_25th_step_is_looked_at():
    """Between two looks the distance goes from 0.5 to -0.5 m along x: the least seen is at the looks."""
    speed = 1.0 / (0.1 * EVERY)
    simulation = coasting([(0.0, 0.0), (-0.5, 0.0)], [(0.0, 0.0), (speed, 0.0)], steps=EVERY + 1)
    simulation.advance(EVERY + 1)
    assert closest(simulation) == pytest.approx(0.5)


def test_those_who_are_not_there_count_in_none():
    """One of the two is lost before they meet."""
    losses = [{"step": 1, "count": 1}]
    simulation = coasting([(0.0, 0.5), (-5.0, 0.0)], [(0.0, 0.0), (1.0, 0.0)], steps=101, losses=losses)
    simulation.advance(101)
    assert closest(simulation) == pytest.approx(math.hypot(5.0, 0.5))


def test_halves_of_a_run_put_together_give_the_whole():
    whole, halves = (Simulation(small(20, 5, {"steps": 200})) for _ in range(2))
    whole.advance(200)
    halves.advance(70)
    halves.advance(130)
    assert closest(whole) == closest(halves) > 0.0
