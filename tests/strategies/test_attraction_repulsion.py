"""Attraction beyond the equilibrium distance, repulsion within."""

import pytest

from staging import DT, staged, wanted

R_EQ = 2.4


def outward(distance, **params):
    """Velocity away from the other of two agents at a distance [m/s]."""
    simulation = staged(("attraction-repulsion", {"equilibrium": R_EQ, **params}), [(0, 0), (distance, 0)])
    left, right = wanted(simulation)
    assert left.tolist() == pytest.approx((-right).tolist())
    return right[0]


@pytest.mark.parametrize("params", [{}, {"attraction": 0.01, "repulsion": 0.3}])
def test_at_the_equilibrium_two_agents_leave_each_other_alone(params):
    assert outward(R_EQ, **params) == pytest.approx(0.0, abs=1e-12)
    assert outward(0.99 * R_EQ, **params) > 0
    assert outward(1.01 * R_EQ, **params) < 0


def test_far_ones_attract_by_a_share_of_the_distance():
    """The limit: -a r."""
    assert outward(18.0, attraction=0.002, repulsion=0.005) == pytest.approx(-0.002 * 18.0 / DT, rel=1e-2)


def test_near_ones_repel_by_a_share_of_it():
    """The limit: (b - a) r."""
    assert outward(1e-3, attraction=0.002, repulsion=0.5) == pytest.approx(0.498 * 1e-3 / DT, rel=1e-4)


def test_two_agents_come_to_rest_at_the_equilibrium():
    simulation = staged(("attraction-repulsion", {"equilibrium": R_EQ}), [(0, 0), (0.5, 0)], top=1.0)
    simulation.advance(2000)
    x = simulation.swarm.x[:2]
    assert x[1] - x[0] == pytest.approx(R_EQ, rel=1e-3)
