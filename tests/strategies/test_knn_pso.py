"""The paper's strategy: repulsion by distance, attraction to who is on target, repulsion that adapts."""

import numpy as np
import pytest

from staging import DT, chance, staged, wanted


def knn(**params):
    return "knn-pso", params


@pytest.mark.parametrize("exponent", [6.0, 2.0])
def test_two_agents_push_each_other_by_a_power_of_their_distance(exponent):
    """Eq. 4: (a_R / r)^d, with a_R one delta larger than at the start."""
    simulation = staged(knn(repulsion_start=0.5, delta=0.1, repulsion_exponent=exponent), [(0, 0), (0.8, 0.6)])
    push = (0.6 / 1.0) ** exponent / DT
    assert wanted(simulation) == pytest.approx(push * np.array([[-0.8, -0.6], [0.8, 0.6]]))


def test_who_hears_of_a_contact_goes_a_random_share_of_the_way_there():
    """Eq. 2: c r (Nbest - x), and nothing for the one on target."""
    simulation = staged(knn(social=0.5, repulsion_step=0.0), [(-4, 0), (5, 3)], targets=[(5, 3)])
    share = 0.5 * chance(simulation, 0, 0)
    assert wanted(simulation).tolist() == [pytest.approx([share * 9 / DT, share * 3 / DT]), [0.0, 0.0]]


@pytest.mark.parametrize(("follow", "leader"), [("nearest", (1, 4)), ("lowest-index", (0, -6))])
def test_of_several_on_target_one_is_followed(follow, leader):
    target = [(0, -6), (1, 4)]
    simulation = staged(knn(follow=follow, repulsion_step=0.0), [(0, -6), (0, 0), (1, 4)], targets=target)
    vx, vy = wanted(simulation)[1]
    assert vx * leader[1] == pytest.approx(vy * leader[0], abs=1e-9)
    assert vy * leader[1] > 0


def test_repulsion_grows_alone_and_shrinks_in_company_of_a_contact():
    """Algorithm 1 to the letter: test, then step."""
    params = {"repulsion_start": 0.5, "repulsion_min": 0.35, "repulsion_max": 0.65, "delta": 0.1, "social": 0.0}
    for targets, then in (([(9, 9)], [0.6, 0.7, 0.7]), ([(0, 0)], [0.4, 0.3, 0.3])):
        simulation = staged(knn(**params, repulsion_step=0.0), [(0, 0), (5, 0)], targets=targets)
        seen = []
        for _ in then:
            simulation.advance(1)
            seen.append(simulation.memories.memory["repulsion"][:2].tolist())
        assert seen == [pytest.approx([a, a]) for a in then]
