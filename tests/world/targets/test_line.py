"""Straight lines with reflection."""

import numpy as np
import pytest

from target_paths import folded, path_of

LINE = {"kind": "line", "speed": 3.0}


class TestLine:
    """Angle of incidence = angle of reflection."""

    @pytest.mark.parametrize("heading", [0.0, 0.3, 1.2, np.pi / 2, 2.5, -2.0])
    @pytest.mark.parametrize("margin", [0.0, 4.0])
    def test_is_a_straight_line_folded_at_the_edges(self, heading, margin):
        path, _ = path_of({**LINE, "margin": margin}, 1500, start=(1.0, -2.0), heading=heading, **{"area.width": 30.0})
        way = 0.3 * np.arange(1500)
        assert path.real == pytest.approx(folded(1.0 + way * np.cos(heading), 15.0 - margin), abs=1e-6)
        assert path.imag == pytest.approx(folded(-2.0 + way * np.sin(heading), 10.0 - margin), abs=1e-6)

    def test_in_a_corner_it_comes_back_the_way_it_came(self):
        path, _ = path_of(LINE, 100, start=(9.0, 9.0), heading=np.pi / 4)
        assert path.real == pytest.approx(path.imag)
        assert path[-1].real < 0

    def test_stays_in_its_box_however_fast_it_is(self):
        path, _ = path_of({**LINE, "speed": 1e5, "margin": 3.0}, 500)
        assert np.abs([path.real, path.imag]).max() <= 7.0

    def test_starts_anywhere_and_heads_anywhere(self):
        starts, headings = [], []
        for seed in range(200):
            path, _ = path_of(LINE, 2, seed=seed)
            starts.append(path[0])
            headings.append(np.diff(path)[0] / 0.3)
        for values in (np.real(starts) / 10, np.imag(starts) / 10, np.angle(headings) / np.pi):
            ordered = np.sort((values + 1) / 2)
            assert np.abs(ordered - np.arange(200) / 200).max() < 1.95 / np.sqrt(200)  # Kolmogorov-Smirnov, 0.1 %
