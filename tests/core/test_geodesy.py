"""Specification of the local frame."""

import pickle

import numpy as np
import pytest

from shoal.core.geodesy import Frame, meters_per_degree, near

pyproj = pytest.importorskip("pyproj")
GEOD = pyproj.Geod(ellps="WGS84")
ORIGINS = [(5.0, 60.0), (-73.5, -39.8), (179.9, 10.0), (0.0, 0.0)]


@pytest.mark.parametrize("origin", ORIGINS)
class TestFrame:
    """Azimuthal equidistant on WGS84."""

    def test_back_and_forth(self, origin):
        frame = Frame(origin)
        x, y = np.array([-3e5, 0.0, 1e3]), np.array([2e5, 0.0, -4e5])
        lon, lat = frame.geographic(x, y)
        assert np.all((lon >= -180.0) & (lon < 180.0))
        np.testing.assert_allclose(frame.local(lon, lat), (x, y), atol=1e-6)

    @pytest.mark.parametrize("azimuth", [0.0, 90.0, 200.0])
    @pytest.mark.parametrize("away", [(0.0, 0.0), (2.0, 1.0), (-4.0, -3.0)])
    def test_a_velocity_is_where_a_second_takes_it(self, origin, azimuth, away):
        frame = Frame(origin)
        lon, lat = origin[0] + away[0], origin[1] + away[1]
        ahead = GEOD.fwd(lon, lat, azimuth, 5.0)[:2]
        behind = GEOD.fwd(lon, lat, azimuth, -5.0)[:2]
        speed = np.subtract(frame.local(*ahead), frame.local(*behind)) / 10.0
        east, north = np.sin(np.radians(azimuth)), np.cos(np.radians(azimuth))
        assert frame.turned(lon, lat, east, north) == pytest.approx(speed, abs=1e-7)


def test_arrays_of_velocities_take_arrays_of_places():
    lon, lat = np.meshgrid([4.9, 5.0, 5.1], [59.9, 60.0])
    u, v = Frame((5.0, 60.0)).turned(lon, lat, np.ones((4, 2, 3)), np.zeros((4, 2, 3)))
    assert u.shape == v.shape == (4, 2, 3)
    assert u[0, 1, 1] == pytest.approx(1.0, abs=1e-9)


def test_nothing_is_nowhere():
    lon, lat = Frame((5.0, 60.0)).geographic(np.nan, 0.0)
    assert np.isnan(lon)
    assert np.isnan(lat)


def test_the_antimeridian_is_west():
    assert Frame((179.0, 0.0)).geographic(meters_per_degree(0.0)[0], 0.0)[0] == pytest.approx(-180.0)
    assert Frame((180.0, 0.0)).geographic(0.0, 0.0)[0] == -180.0


def test_a_frame_can_be_sent_to_another_process():
    frame = pickle.loads(pickle.dumps(Frame((5.0, 60.0))))
    assert frame.local(5.1, 60.0) == Frame((5.0, 60.0)).local(5.1, 60.0)


@pytest.mark.parametrize(("lon", "middle", "found"), [(-179.0, 179.0, 181.0), (359.0, 0.0, -1.0), (5.0, 5.0, 5.0)])
def test_longitudes_near_a_place(lon, middle, found):
    assert near(lon, middle) == found
