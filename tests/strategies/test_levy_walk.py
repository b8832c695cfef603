"""Straight legs of power-law length."""

import numpy as np
import pytest

from scenarios import fleets, scenario
from shoal.run.simulation import Simulation


def walkers(count, **params):
    return Simulation(
        scenario(
            "oceans2020",
            {
                "strategy": {"name": "levy-walk", **params},
                "fleets": fleets((count, 1.0)),
                "area.width": 1000.0,
                "area.height": 1000.0,
                "area.agent_margin": 0.0,
            },
        )
    )


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0, 3.0])
def test_lengths_of_legs_follow_the_power_law_between_their_bounds(exponent):
    """Kolmogorov-Smirnov against P(l) ~ l^-mu on [1, 20] at the 1 % level."""
    count = 2000
    legs = np.sort(walkers(count, exponent=exponent, shortest=1.0, longest=20.0).memories.memory["leg"][:count])
    if exponent == 1.0:
        expected = np.log(legs) / np.log(20.0)
    else:
        expected = (legs ** (1 - exponent) - 1) / (20.0 ** (1 - exponent) - 1)
    ranks = np.arange(count)
    distance = max((expected - ranks / count).max(), ((ranks + 1) / count - expected).max())
    assert distance * np.sqrt(count) < 1.63


def test_a_leg_is_straight_and_as_long_as_drawn():
    simulation = walkers(40, shortest=0.4, longest=20.0)
    first = np.ceil(simulation.memories.memory["leg"][:40] / 0.1 - 1e-9)  # steps of 0.1 m
    frames = simulation.advance(300, every=1)
    turned = np.abs(np.diff(frames.memory["heading"], axis=0)) > 0
    for i in range(40):
        turns = np.flatnonzero(turned[:, i])
        assert turns[:1].tolist() == ([first[i]] if first[i] < 299 else [])
    speeds = np.hypot(frames.vx, frames.vy)[1:]
    assert speeds == pytest.approx(np.ones_like(speeds))
