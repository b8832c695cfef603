"""A persistent random walk."""

import numpy as np
import pytest

from target_paths import path_of, turns

WIDE = {"area.width": 1e5, "area.height": 1e5}


class TestWalk:
    """The heading diffuses: the mean cosine of the turn in a time t is exp(-t / persistence)."""

    @pytest.mark.parametrize("persistence", [0.5, 5.0])
    def test_forgets_its_heading_as_it_should(self, persistence):
        path, _ = path_of({"kind": "walk", "speed": 2.0, "persistence": persistence}, 40_000, **WIDE)
        steps = np.diff(path) / 0.2
        for lag in (1, 5, 20):
            along = (steps[lag:] * steps[:-lag].conj()).real
            error = 5 * np.sqrt(2 * persistence / 0.1 / steps.size)  # of some that many independent ones
            assert abs(along.mean() - np.exp(-0.1 * lag / persistence)) < max(
                error * (1 - np.exp(-0.1 * lag / persistence)), 1e-3
            )

    def test_has_one_speed_and_turns_as_far_to_the_left_as_to_the_right(self):
        path, _ = path_of({"kind": "walk", "speed": 2.0, "persistence": 2.0}, 20_000, **WIDE)
        assert np.abs(np.diff(path)) == pytest.approx(0.2, rel=1e-6)
        angles = turns(path)
        assert abs(angles.mean()) < 5 * angles.std() / np.sqrt(angles.size)
        assert angles.std() == pytest.approx(np.sqrt(2 * 0.1 / 2.0), rel=0.03)

    def test_stays_in_its_box(self):
        path, _ = path_of({"kind": "walk", "speed": 5.0, "margin": 2.0}, 5000)
        assert np.abs([path.real, path.imag]).max() <= 8.0

    def test_of_endless_persistence_is_a_line(self):
        path, _ = path_of({"kind": "walk", "speed": 2.0, "persistence": 1e12}, 100, **WIDE)
        assert np.abs(turns(path)).max() < 1e-5
