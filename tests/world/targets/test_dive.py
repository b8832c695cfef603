"""A target that surfaces and dives."""

import numpy as np
import pytest

from target_paths import path_of

LINE = {"kind": "line", "speed": 1.0}


class TestDive:
    """Up for surface_time, down for dive_time, in turn."""

    @pytest.mark.parametrize(("up", "down"), [(3.0, 1.0), (0.7, 2.3)])
    def test_is_there_for_its_share_of_the_time(self, up, down):
        _, present = path_of({**LINE, "surface_time": up, "dive_time": down}, 8000)
        assert present.mean() == pytest.approx(up / (up + down), abs=0.01)

    def test_each_time_as_long_as_the_other(self):
        _, present = path_of({**LINE, "surface_time": 2.0, "dive_time": 3.0}, 2000)
        changes = np.flatnonzero(np.diff(present.astype(int)))
        lengths = np.diff(changes)
        up = lengths[0::2] if not present[changes[0]] else lengths[1::2]
        down = lengths[1::2] if not present[changes[0]] else lengths[0::2]
        assert set(up.tolist()) <= {19, 20, 21}
        assert set(down.tolist()) <= {29, 30, 31}

    def test_begins_anywhere_in_its_cycle(self):
        present = [path_of({**LINE, "surface_time": 1.0, "dive_time": 3.0}, 1, seed=seed)[1][0] for seed in range(400)]
        assert abs(np.mean(present) - 0.25) < 5 * np.sqrt(0.25 * 0.75 / 400)

    def test_goes_on_its_way_while_it_is_down(self):
        path, _ = path_of({**LINE, "surface_time": 1.0, "dive_time": 3.0}, 500)
        plain, there = path_of(LINE, 500)
        assert path.tolist() == plain.tolist()
        assert there.all()
