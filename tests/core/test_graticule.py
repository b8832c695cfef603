"""Meridians and parallels at round degrees."""

import numpy as np
import pytest

pytest.importorskip("pyproj", reason="pyproj is not installed")

from shoal.core.geodesy import Frame
from shoal.core.graticule import degrees_text, graticule, round_degrees


class TestGraticule:
    @pytest.mark.parametrize("origin", [(-30.0, 45.0), (179.99, -60.0), (5.3, 78.2)])
    def test_lines_are_where_they_say_they_are(self, origin):
        frame = Frame(origin)
        lines = graticule(frame, 20_000.0, 10_000.0)
        assert len({line.meridian for line in lines}) == 2
        for line in lines:
            lon, lat = frame.geographic(line.x, line.y)
            degree = lon if line.meridian else lat
            assert np.ptp(np.unwrap(degree, period=360.0)) < 1e-5
            assert degrees_text(float(degree[0].round(6)), "EW" if line.meridian else "NS") == line.words

    def test_they_go_from_edge_to_edge(self):
        for line in graticule(Frame((0.0, 50.0)), 3000.0, 2000.0):
            along, half = (line.y, 2000.0) if line.meridian else (line.x, 3000.0)
            if line.x.size == 41:
                assert (along[0], along[-1]) == (-half, half)


def test_round_degrees_are_three_to_a_handful():
    assert round_degrees(44.99, 45.02) == pytest.approx([44.9916667, 45.0, 45.0083333, 45.0166667], abs=1e-6)


@pytest.mark.parametrize(("degree", "words"), [(4.6, "4°36′E"), (-30.0, "30°W"), (185.0, "175°W")])
def test_degrees_are_written_as_charts_do(degree, words):
    assert degrees_text(degree, "EW") == words
