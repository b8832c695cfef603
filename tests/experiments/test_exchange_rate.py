import numpy as np
import pytest

from shoal.experiments.exchange_rate import exchange_rates
from shoal.experiments.surrogate import halton

COUNTS = np.floor(halton(90, 0, 3)[:, :2] * [30, 45] + [0, 1])
K = 4 + np.floor(halton(90, 0, 3)[:, 2:] * 36)


def worth(fast, noise):
    """A value that saturates, a best k, and noise."""
    strength = COUNTS[:, 1] + fast * COUNTS[:, 0]
    value = 1 - np.exp(-strength / 40) - 0.0002 * (K[:, 0] - 20) ** 2
    return value + np.random.default_rng(5).normal(0, noise, 90)


@pytest.mark.parametrize("fast", [0.4, 1.0, 2.3])
def test_the_rate_is_found_and_its_interval_holds_it(fast):
    (rate,) = exchange_rates(COUNTS, K, worth(fast, 0.01), base=1)
    assert rate.fleet == 0
    assert rate.worth == pytest.approx(fast, rel=0.15)
    assert rate.low < fast < rate.high


def test_more_noise_makes_the_interval_wider():
    (calm,), (noisy,) = (exchange_rates(COUNTS, K, worth(2.3, noise), base=1) for noise in (0.003, 0.05))
    assert np.log(noisy.high / noisy.low) > 5 * np.log(calm.high / calm.low)


def test_of_three_fleets():
    counts = np.column_stack([COUNTS, np.floor(20 * halton(90, 500, 5)[:, 4])])
    strength = 2.0 * counts[:, 0] + counts[:, 1] + 0.5 * counts[:, 2]
    one, other = exchange_rates(counts, np.empty((90, 0)), np.log(strength), base=1)
    assert (one.worth, other.worth) == pytest.approx((2.0, 0.5), rel=0.05)


def test_what_was_not_tried_has_none():
    alike = np.column_stack([np.full(90, 5), COUNTS[:, 1]])
    assert exchange_rates(alike, K, worth(1.0, 0.01), base=1) == []
    assert exchange_rates(COUNTS[:8], K[:8], worth(1.0, 0.01)[:8], base=1) == []
    assert exchange_rates(COUNTS, K, np.full(90, 0.5), base=1) == []
    chance = np.random.default_rng(2).normal(0, 1, 90)
    assert exchange_rates(COUNTS, K, chance, base=1) == []
