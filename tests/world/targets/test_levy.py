"""A Levy walk."""

import numpy as np
import pytest

from target_paths import path_of, turns

WIDE = {"area.width": 1e7, "area.height": 1e7}


def legs_of(exponent, shortest, longest, steps=60_000):
    """Lengths of the whole legs of a path, in steps of 0.1 m."""
    target = {"kind": "levy", "speed": 1.0, "exponent": exponent, "shortest": shortest, "longest": longest}
    path, _ = path_of(target, steps, **WIDE)
    ends = np.flatnonzero(np.abs(turns(path)) > 1e-4)
    return np.diff(ends)


def truncated_exponent(lengths, low, high):
    """Maximum likelihood of mu for P(l) ~ l^-mu between two bounds, by bisection of the score."""
    mean = np.log(lengths).mean()

    def expected(mu):
        grid = np.linspace(np.log(low), np.log(high), 4001)
        weight = np.exp((1 - mu) * grid)
        return (weight * grid).sum() / weight.sum()

    below, above = 0.0, 8.0
    for _ in range(60):
        middle = 0.5 * (below + above)
        below, above = (middle, above) if expected(middle) > mean else (below, middle)
    return below


class TestLevy:
    """Legs with P(l) ~ l^-mu between two bounds, in any direction."""

    @pytest.mark.parametrize("exponent", [1.0, 1.0 + 1e-13, 1.5, 2.0, 3.0])
    def test_has_its_exponent(self, exponent):
        """A leg of l ends with the step in which it is done: a length of n steps means l in (n - 1, n] of them."""
        legs = legs_of(exponent, 2.0, 200.0)
        estimate = truncated_exponent(0.1 * (legs - 0.5), 2.0, 200.0)
        spread = np.log(0.1 * (legs - 0.5)).std() * np.sqrt(legs.size)
        assert abs(estimate - exponent) < 5 / spread + 0.03
        assert legs.size > 50

    def test_stays_between_its_bounds(self):
        legs = legs_of(1.5, 1.0, 5.0)
        assert legs.min() >= 10
        assert legs.max() <= 51

    def test_of_one_length_only(self):
        legs = legs_of(2.0, 3.0, 3.0, 5000)
        assert set(legs.tolist()) <= {30, 31}

    @pytest.mark.parametrize(("shortest", "longest"), [(1e-12, 1e12), (1e-29, 1e-28), (1e11, 1e12)])
    @pytest.mark.parametrize("exponent", [1.0, 2.0, 5.0])
    def test_bounds_beyond_all_reason_still_make_a_walk(self, shortest, longest, exponent):
        target = {"kind": "levy", "speed": 1.0, "exponent": exponent, "shortest": shortest, "longest": longest}
        path, _ = path_of(target, 200)
        assert np.isfinite(path).all()
        assert np.abs([path.real, path.imag]).max() <= 10.0

    def test_has_one_speed(self):
        target = {"kind": "levy", "speed": 2.0, "shortest": 0.5, "longest": 50.0}
        path, _ = path_of(target, 3000, **WIDE)
        assert np.abs(np.diff(path)) == pytest.approx(0.2, rel=1e-4)

    def test_a_new_leg_heads_anywhere(self):
        path, _ = path_of({"kind": "levy", "speed": 1.0, "shortest": 0.05, "longest": 0.1}, 5000, **WIDE)
        counts, _ = np.histogram(turns(path), bins=8, range=(-np.pi, np.pi))
        expected = counts.sum() / 8
        assert ((counts - expected) ** 2 / expected).sum() < 24.3  # 99.9 % of 7 degrees of freedom
