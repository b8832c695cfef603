"""A target that drifts."""

import numpy as np
import pytest

from target_paths import path_of


def wrapped(place, half):
    return (place + half) % (2 * half) - half


class TestDrift:
    """Current times time, modulo the box."""

    @pytest.mark.parametrize("margin", [0.0, 3.0])
    def test_goes_with_the_current(self, margin):
        target = {"kind": "drift", "current_x": 0.7, "current_y": -1.3, "margin": margin}
        path, _ = path_of(target, 2000, start=(1.0, 2.0), **{"area.width": 30.0})
        time = 0.1 * np.arange(2000)
        for place, free, half in ((path.real, 1.0 + 0.7 * time, 15.0), (path.imag, 2.0 - 1.3 * time, 10.0)):
            apart = np.abs(place - wrapped(free, half - margin))
            assert np.minimum(apart, 2 * (half - margin) - apart).max() < 1e-8
            assert np.abs(place).max() <= half - margin

    def test_without_a_current_and_a_speed_stays(self):
        path, _ = path_of({"kind": "drift"}, 50, start=(1.0, 2.0))
        assert set(path.tolist()) == {1.0 + 2.0j}

    def test_its_own_way_wanders_on_top(self):
        target = {"kind": "drift", "speed": 1.0, "current_x": 3.0, "persistence": 2.0}
        path, _ = path_of(target, 20_000, **{"area.width": 1e6, "area.height": 1e6})
        own = np.diff(path) / 0.1 - 3.0
        assert np.abs(own) == pytest.approx(1.0, rel=1e-4)
        assert np.angle(own[1:] * own[:-1].conj()).std() == pytest.approx(np.sqrt(0.1), rel=0.03)

    def test_stays_in_its_box_however_fast_the_current(self):
        path, _ = path_of({"kind": "drift", "current_x": 1e12, "current_y": -1e12}, 200)
        assert np.abs([path.real, path.imag]).max() <= 10.0
