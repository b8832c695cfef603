import numpy as np
import pytest

from shoal.experiments.surrogate import halton, surrogate


def test_a_plane_is_met_exactly():
    places = halton(12, 0, 2)
    values = 3 + 2 * places[:, 0] - places[:, 1]
    found = surrogate(places, values)
    elsewhere = halton(5, 100, 2)
    assert found(elsewhere) == pytest.approx(3 + 2 * elsewhere[:, 0] - elsewhere[:, 1])


def test_a_curve_is_found_behind_noise():
    places = halton(80, 0, 2)
    noise = np.random.default_rng(1).normal(0, 0.05, 80)

    def curve(at):
        return 1 - np.exp(-3 * at[:, 0]) + 0.3 * np.sin(3 * at[:, 1])

    elsewhere = 0.1 + 0.8 * halton(50, 1000, 2)
    error = surrogate(places, curve(places) + noise)(elsewhere) - curve(elsewhere)
    assert np.sqrt((error**2).mean()) < 0.03  # less than the noise of one


def test_halton_mirrors_the_digits_behind_the_point():
    assert halton(3, 0, 2) == pytest.approx(np.array([[1 / 2, 1 / 3], [1 / 4, 2 / 3], [3 / 4, 1 / 9]]))
    assert halton(1, 2, 1) == pytest.approx(np.array([[3 / 4]]))
