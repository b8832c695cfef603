"""Between the Earth and the arena's frame, judged by geodesics on WGS 84."""

import math

import pytest

pytest.importorskip("pyproj", reason="pyproj is not installed: pip install '.[maritime]'")

from pyproj import Geod

from shoal.buoy.ground import GroundFrame, in_frame, over_ground
from shoal.buoy.mavlink import Fix
from shoal.core.geodesy import Frame

EARTH = Geod(ellps="WGS84")
ORIGINS = [(5.3, 60.4), (-122.4, 37.8), (0.0, 0.0), (174.8, -36.8), (-68.3, -54.8), (15.6, 78.2), (106.0, -77.8)]
DATELINE = [(179.995, 51.9), (-179.995, -16.8), (180.0, 0.0)]
PLACES = [(0.0, 0.0), (700.0, -300.0), (-20e3, 15e3), (40e3, 60e3)]


def at(frame, x, y, east=0.0, north=0.0):
    lon, lat = frame.geographic(x, y)
    return Fix(1, float(lon), float(lat), east, north, 0.0)


@pytest.mark.parametrize("origin", ORIGINS + DATELINE)
@pytest.mark.parametrize(("x", "y"), PLACES)
class TestAgainstGeodesics:
    def test_a_place_is_at_its_distance_and_bearing_from_the_origin(self, origin, x, y):
        bearing, _, distance = EARTH.inv(*origin, *at(GroundFrame(origin), x, y)[1:3])
        seen_x, seen_y, _, _ = in_frame(GroundFrame(origin), at(GroundFrame(origin), x, y))
        turned = math.radians(bearing)
        assert (seen_x, seen_y) == pytest.approx((distance * math.sin(turned), distance * math.cos(turned)), abs=1e-3)

    def test_it_is_the_frame_of_tracks_and_records(self, origin, x, y):
        ours, frame = GroundFrame(origin), Frame(origin)
        lon, lat = frame.geographic(x, y)
        assert ours.geographic(x, y) == pytest.approx((float(lon), float(lat)), abs=1e-11)  # [deg]: a micrometer
        assert ours.local(lon, lat) == pytest.approx((x, y), abs=1e-6)

    def test_a_velocity_is_how_fast_the_place_changes(self, origin, x, y):
        frame = GroundFrame(origin)
        fix = at(frame, x, y, east=1.2, north=-1.6)
        lon, lat, _ = EARTH.fwd(fix.lon, fix.lat, math.degrees(math.atan2(1.2, -1.6)), 2.0)  # a second later
        later_x, later_y = frame.local(lon, lat)
        x, y, vx, vy = in_frame(frame, fix)
        assert (vx, vy) == pytest.approx((later_x - x, later_y - y), abs=1e-5)

    def test_who_is_told_where_to_go_on_the_earth_goes_there_in_the_frame(self, origin, x, y):
        frame = GroundFrame(origin)
        fix = at(frame, x, y)
        east, north = over_ground(frame, fix, -0.9, 1.3)
        lon, lat, _ = EARTH.fwd(fix.lon, fix.lat, math.degrees(math.atan2(east, north)), math.hypot(east, north))
        later_x, later_y = frame.local(lon, lat)
        x, y, _, _ = in_frame(frame, fix)
        assert (later_x - x, later_y - y) == pytest.approx((-0.9, 1.3), abs=1e-5)


def test_north_of_the_frame_is_east_of_true_north_where_one_is_east_of_the_origin():
    east, north = over_ground(GroundFrame((5.3, 60.4)), at(GroundFrame((5.3, 60.4)), 65e3, 0.0), 0.0, 1.0)
    assert math.degrees(math.atan2(east, north)) == pytest.approx(1.03, abs=0.01)


@pytest.mark.parametrize("origin", [*ORIGINS, (0.0, 90.0), (0.0, -90.0)])
@pytest.mark.parametrize("place", [(0.0, 90.0), (0.0, -90.0), (179.9, 0.1), (-180.0, 0.0), (5.3, 60.4), (180.0, -60.4)])
def test_wherever_a_receiver_says_that_it_is_there_is_a_place(origin, place):
    x, y = GroundFrame(origin).local(*place)
    assert math.hypot(x, y) < 2.01e7
