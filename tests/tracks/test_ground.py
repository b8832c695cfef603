"""Specification of the projection to local meters."""

import numpy as np
import pytest

from shoal.tracks.read import read_track
from track_files import DEGREE, csv_file, eastward, refusal


class TestProjection:
    """Azimuthal equidistant on WGS84: distances and bearings from origin are true."""

    def test_the_origin_is_the_center_of_the_bounding_box(self, tmp_path):
        path = csv_file(tmp_path, "0,10,20", "36000,10.5,20.5", "72000,10.25,21")
        track = read_track(path)
        assert track.origin == (20.5, 10.25)
        assert (track.x[1], track.y[2]) == pytest.approx((0.0, 0.0), abs=200.0)

    def test_a_given_origin_is_local_zero(self, tmp_path):
        track = read_track(eastward(tmp_path, [2.0, 2.001]), origin=(2.0, 0.0))
        assert track.origin == (2.0, 0.0)
        assert (track.x[0], track.y[0]) == (0.0, 0.0)

    def test_x_grows_east_and_y_grows_north(self, tmp_path):
        track = read_track(csv_file(tmp_path, "0,50,-1", "600,50.01,-0.99"))
        assert track.x[1] > track.x[0]
        assert track.y[1] > track.y[0]

    def test_distance_from_origin_is_the_geodesic(self, tmp_path):
        pyproj = pytest.importorskip("pyproj")
        track = read_track(csv_file(tmp_path, "0,50,-1", "90000,51,1"), origin=(-1.0, 50.0))
        geodesic = pyproj.Geod(ellps="WGS84").inv(-1, 50, 1, 51)[2]
        assert np.hypot(track.x[1], track.y[1]) == pytest.approx(geodesic, abs=0.01)

    @pytest.mark.parametrize("lons", [[179.9, -179.9], [179.9, 180.1], [-179.9, 179.9]])
    def test_a_track_across_the_antimeridian_is_short(self, tmp_path, lons):
        track = read_track(eastward(tmp_path, lons, seconds_apart=3600))
        assert abs(track.x[1] - track.x[0]) == pytest.approx(0.2 * DEGREE, rel=1e-6)
        assert abs(track.origin[0]) == 180.0

    def test_longitudes_up_to_360_are_the_same_places(self, tmp_path):
        west = read_track(eastward(tmp_path, [-10.0, -9.99]))
        east = read_track(eastward(tmp_path, [350.0, 350.01]))
        assert east.origin == west.origin
        assert east.x == pytest.approx(west.x, abs=1e-3)

    def test_an_origin_beyond_a_quarter_of_the_earth_is_refused(self, tmp_path):
        path = eastward(tmp_path, [0.0, 0.001])
        assert "local meters mean nothing" in refusal(path, origin=(180.0, 0.0))[1]
        assert "local meters mean nothing" in refusal(path, origin=(100.0, 0.0))[1]

    def test_a_far_origin_is_noted_with_its_stretch(self, tmp_path):
        track = read_track(eastward(tmp_path, [0.0, 0.001]), origin=(18.0, 0.0))
        assert "2004 km from its origin, where local meters are up to 1.7% too long" in (track.notes[-1])
