"""Charges: Coulomb's push from the core to the limit of perception."""

import pytest

from staging import DT, staged, wanted

CHARGE, CORE, PERCEPTION = 0.6, 0.5, 4.0


@pytest.mark.parametrize(
    ("distance", "push"),
    [
        (0.2, CHARGE**3 / CORE**2),  # no stronger than at the core
        (CORE, CHARGE**3 / CORE**2),
        (CHARGE, CHARGE),
        (2.0, CHARGE**3 / 4.0),
        (3.999, CHARGE**3 / 3.999**2),
        (4.001, 0.0),
    ],
)
def test_two_charges_push_each_other_by_the_inverse_square_of_their_distance(distance, push):
    params = {"charge": CHARGE, "core": CORE, "perception": PERCEPTION}
    simulation = staged(("charged-pso", params), [(0, 0), (0.6 * distance, 0.8 * distance)])
    velocity = push / DT
    assert wanted(simulation).tolist() == [
        pytest.approx([-0.6 * velocity, -0.8 * velocity]),
        pytest.approx([0.6 * velocity, 0.8 * velocity]),
    ]


def test_charges_at_one_place_have_no_direction_to_push():
    assert wanted(staged("charged-pso", [(1, 1), (1, 1)])).tolist() == [[0, 0], [0, 0]]


def test_who_is_on_target_follows_nobody():
    simulation = staged(("charged-pso", {"charge": 0.0}), [(0, 0), (0.5, 0), (4, 0)], targets=[(0, 0)])
    first, second, third = wanted(simulation).tolist()
    assert (first, second) == ([0, 0], [0, 0])
    assert third[0] < 0.0
