"""Parker's field of forces."""

import pytest

from staging import staged, wanted

FIELD = {
    "target_near": 1.5, "target_full": 2.5, "target_fade": 4.0, "target_end": 8.0,
    "mate_full": 1.0, "mate_end": 3.0, "mate_weight": 0.5, "target_weight": 0.8,
}  # fmt: skip


def force(distance, target=None, **params):
    """What pushes an agent away from another one at a distance, in units of the force of a target."""
    targets = [(distance, 0.0)] if target else [(1e6, 1e6)]
    simulation = staged(("a-cmommt", {**FIELD, **params}), [(0, 0), (distance, 0)], targets=targets, top=1.0)
    (push, across), _ = wanted(simulation)
    assert across == pytest.approx(0.0, abs=1e-12)
    return -push


@pytest.mark.parametrize(("distance", "push"), [(0.1, 0.5), (1.0, 0.5), (1.5, 0.375), (2.0, 0.25), (2.9, 0.025)])
def test_mates_push_fully_when_near_and_fade_out(distance, push):
    assert force(distance) == pytest.approx(push)


@pytest.mark.parametrize(
    ("distance", "pull"),
    [(1.01, -0.49), (1.4, -0.1), (1.6, 0.1), (2.0, 0.5), (2.5, 1.0), (4.0, 1.0), (6.0, 0.5), (7.5, 0.125)],
)
def test_targets_push_when_too_near_pull_fully_in_between_and_fade_out(distance, pull):
    assert force(distance, target=True, mate_weight=0.0) == pytest.approx(-0.8 * pull)


def test_the_forces_add_up():
    assert force(2.5, target=True) == pytest.approx(0.5 * 0.25 - 0.8)


def test_who_is_on_target_stays_there():
    simulation = staged(("a-cmommt", FIELD), [(0, 0), (9, 9)], targets=[(0, 0.5)], top=1.0)
    assert wanted(simulation)[0].tolist() == [0.0, 0.0]


def test_without_a_force_agents_walk_at_full_speed():
    simulation = staged(("a-cmommt", FIELD), [(-5, 0), (5, 0)], top=1.0)
    assert (wanted(simulation) ** 2).sum(axis=1) == pytest.approx([1.0, 1.0])
