"""Peaks are found where they are, as surely as their intervals say."""

import numpy as np
import pytest

from shoal.paper.peaks import tops

pytest.importorskip("scipy.interpolate", reason="scipy is not installed")

from bench_peaks import difference_coverage, place_coverage

CURVES, DRAWS = 500, 500
SHAPES = ("mixed, 3 m/s", "all slow, 3 m/s", "mixed, 5 m/s")


@pytest.mark.slow
class TestCoverage:
    """Of 500 made-up curves with a known peak, at least 93 % of the 95 % intervals hold it, and none is idle."""

    @pytest.mark.parametrize("shape", SHAPES)
    @pytest.mark.parametrize(("places", "widest", "seeds"), [("full", 2.0, 5), ("quick", 2.5, 3)])
    def test_of_a_place(self, shape, places, widest, seeds):
        known = place_coverage(shape, places, seeds, CURVES, DRAWS)
        assert known.share >= 0.93
        assert known.width < widest

    @pytest.mark.parametrize("seeds", [3, 5])
    def test_of_a_difference(self, seeds):
        known = difference_coverage("all slow, 3 m/s", "mixed, 3 m/s", "full", seeds, CURVES // 2, DRAWS)
        assert known.share >= 0.93
        assert known.width < 1.2


class TestTops:
    X = np.arange(10.0, 31.0)

    def tops(self, mean, error=1e-3, draws=400):
        rng = np.random.default_rng(3)
        return tops(self.X, mean, error, error * rng.normal(size=(draws, self.X.size)), rng)

    def test_between_two_points_it_is_found_between_them(self):
        found = self.tops(1 - 0.002 * (self.X - 20.4) ** 2)
        assert found.place == pytest.approx(20.4, abs=0.05)
        assert found.height == pytest.approx(1.0, abs=1e-3)

    def test_draws_lie_around_it_and_more_widely_where_points_are_noisier(self):
        widths = [np.std(self.tops(1 - 0.002 * (self.X - 20.4) ** 2, error).places) for error in (1e-4, 1e-3, 1e-2)]
        assert widths[0] < widths[1] < widths[2]
        assert widths[1] < 0.5

    def test_a_line_is_highest_at_its_end(self):
        assert self.tops(0.01 * self.X).place == 30.0
        assert self.tops(-0.01 * self.X).place == 10.0

    def test_of_noise_alone_anything_can_be_the_top(self):
        found = self.tops(1e-3 * np.random.default_rng(1).normal(size=self.X.size))
        assert np.quantile(found.places, 0.9) - np.quantile(found.places, 0.1) > 8

    def test_two_equal_tops_are_both_drawn(self):
        found = self.tops(np.exp(-((self.X - 14) ** 2) / 8) + np.exp(-((self.X - 26) ** 2) / 8), error=0.01)
        assert 0.2 < np.mean(found.places < 20) < 0.8

    def test_its_level_does_not_matter(self):
        curve = 1 - 0.002 * (self.X - 20.4) ** 2
        one, other = self.tops(curve), self.tops(curve + 100)
        assert other.places == pytest.approx(one.places, abs=1e-6)
        assert other.heights == pytest.approx(one.heights + 100, abs=1e-6)
