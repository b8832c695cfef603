"""What figures call things."""

import pytest

from shoal.drawing.words import field_value


@pytest.mark.parametrize(
    ("field", "value", "label"),
    [
        ("neighbors", 20, "k = 20"),
        ("fast", 15, "15 fast agents"),
        ("target_speed", 3, "target speed 3 m/s"),
        ("network.loss", 0.5, "network.loss 0.5"),
        ("strategy", "knn-pso", "knn-pso"),  # says itself what it is
    ],
)
def test_a_value_in_a_legend_says_of_what_it_is(field, value, label):
    assert field_value(field, value) == label
