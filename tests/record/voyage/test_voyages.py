"""Where everybody was: places, speeds and courses against PROJ's geodesics, times, and who was away."""

from datetime import UTC, datetime, timedelta, timezone
from types import SimpleNamespace

import numpy as np
import pytest

from scenarios import scenario
from shoal.core.errors import RecordError, ScenarioError
from shoal.record.voyage.anchor import anchor_of, iso_all
from shoal.record.voyage.voyages import KNOT, frames_of, voyages_of
from voyages import ORIGIN, START, UNIX, made_record

pyproj = pytest.importorskip("pyproj")
GEOD = pyproj.Geod(ellps="WGS84")


def voyages(record, **given):
    anchor = anchor_of(record.scenario, **{"start": START, **given})
    return voyages_of(frames_of(record, 0), record.facts, anchor, record.scenario.name)


class TestPlaces:
    """Distance and bearing from the origin are those of the local frame."""

    @pytest.mark.parametrize("origin", [ORIGIN, (179.9999, -16.0), (0.0, 0.0), (25.0, 89.0)])
    def test_are_where_a_geodesic_from_the_origin_leads(self, origin):
        record = made_record(reach=20_000.0, origin=origin)
        frames, found = record.trajectories[0], voyages(record)
        x, y = np.hstack([frames.x, frames.target_x]), np.hstack([frames.y, frames.target_y])
        bearing = np.degrees(np.arctan2(x, y))
        lon, lat, _ = GEOD.fwd(np.full(x.shape, origin[0]), np.full(x.shape, origin[1]), bearing, np.hypot(x, y))
        off = GEOD.inv(lon, lat, found.lon, found.lat)[2]
        assert off.max() < 0.002
        assert found.lon.min() >= -180.0
        assert found.lon.max() < 180.0

    def test_a_given_origin_goes_before_that_of_the_scenario(self):
        assert np.abs(voyages(made_record(), origin=(10.0, 60.0)).lon - 10.0).max() < 0.1

    def test_are_never_at_180_degrees_but_at_their_negative(self):
        record = made_record(origin=(180.0, 0.0))
        record.trajectories[0].x[0, 0] = -1e-4  # 0.1 mm west of it
        assert voyages(record).lon[0, 0] == -180.0

    def test_in_blocks_are_the_same(self, monkeypatch):
        record = made_record(steps=range(7))
        whole = voyages(record)
        monkeypatch.setattr("shoal.record.voyage.voyages.BLOCK", 15)  # two crafts of seven frames
        for one, other in zip(whole[2:], voyages(record)[2:], strict=True):
            np.testing.assert_array_equal(one, other)

    def test_half_around_the_earth_are_refused(self):
        record = made_record()
        record.trajectories[0].x[1, 1] = 1.2e7
        with pytest.raises(ScenarioError, match="reaches 12,000 km from its origin"):
            voyages(record)


class TestMotion:
    """Speed and course are over ground, heading is through the water: they differ in a current."""

    def test_speed_and_course_are_those_of_the_geodesic_from_the_frame_before(self):
        record = made_record(steps=[0, 10, 40], reach=200_000.0, origin=(5.0, 61.0))
        found = voyages(record)
        course, _, way = GEOD.inv(found.lon[:-1], found.lat[:-1], found.lon[1:], found.lat[1:])
        np.testing.assert_allclose(found.speed[1:], way / [[1.0], [3.0]], atol=0.003)
        assert np.abs((found.course[1:] - course + 180.0) % 360.0 - 180.0).max() < 0.3  # of positions to 1 mm
        assert np.isnan(found.speed[0]).all()
        assert np.isnan(found.course[0]).all()

    def test_heading_is_that_of_the_velocity_also_far_from_the_origin(self):
        record = made_record(reach=200_000.0, origin=(5.0, 61.0))
        frames, found = record.trajectories[0], voyages(record)
        frame = anchor_of(record.scenario, start=START).frame
        lon, lat = frame.geographic(frames.x, frames.y)
        heading = GEOD.inv(lon, lat, *frame.geographic(frames.x + frames.vx, frames.y + frames.vy))[0]
        assert np.abs((found.heading[:, :-1] - heading + 180.0) % 360.0 - 180.0).max() < 0.01
        on_paper = np.degrees(np.arctan2(frames.vx, frames.vy))
        assert np.abs((found.heading[:, :-1] - on_paper + 180.0) % 360.0 - 180.0).max() > 1.0  # meridians turn
        assert np.isnan(found.heading[:, -1]).all()  # nobody knows a target's

    def test_who_stands_still_has_a_speed_and_no_direction(self):
        record = made_record()
        frames = record.trajectories[0]
        frames.vx[1, 2] = frames.vy[1, 2] = 0.0
        frames.x[2, 3], frames.y[2, 3] = frames.x[1, 3], frames.y[1, 3]
        found = voyages(record)
        assert np.argwhere(np.isnan(found.heading[:, :-1])).tolist() == [[1, 2]]
        assert np.argwhere(np.isnan(found.course[1:])).tolist() == [[1, 3]]
        assert found.speed[2, 3] == 0.0

    def test_a_knot_is_a_nautical_mile_per_hour(self):
        assert pytest.approx(1852.0) == KNOT * 3600.0


class TestTimes:
    def test_are_the_start_and_the_seconds_since_to_the_microsecond(self):
        found = voyages(made_record(steps=[0, 1, 3, 100_000]))
        assert found.times.tolist() == [UNIX * 10**6 + each for each in (0, 100_000, 300_000, 10**10)]

    def test_have_as_many_digits_as_the_finest_needs(self):
        assert iso_all(np.array([0, 10**6])) == ["1970-01-01T00:00:00Z", "1970-01-01T00:00:01Z"]
        assert iso_all(np.array([0, 10**5])) == ["1970-01-01T00:00:00.000Z", "1970-01-01T00:00:00.100Z"]
        assert iso_all(np.array([1])) == ["1970-01-01T00:00:00.000001Z"]

    @pytest.mark.parametrize(
        "start", [START, "2015-11-16T07:00+01:00", datetime(2015, 11, 16, 7, tzinfo=timezone(timedelta(hours=1)))]
    )
    def test_a_start_may_be_in_any_zone(self, start):
        assert anchor_of(scenario(), origin=ORIGIN, start=start).start == datetime(2015, 11, 16, 6, tzinfo=UTC)

    def test_the_sea_of_a_scenario_says_when(self):
        start = datetime(2015, 11, 16, 6, tzinfo=UTC)
        chosen = SimpleNamespace(name="s", area=SimpleNamespace(origin=ORIGIN), sea=SimpleNamespace(start=start))
        assert anchor_of(chosen).start == start

    def test_or_else_its_recorded_track(self, tmp_path):
        file = tmp_path / "track.csv"
        file.write_text("time,lat,lon\n2015-11-16T06:00:00Z,50.8,-1.3\n2015-11-16T06:01:00Z,50.8001,-1.3\n")
        chosen = scenario(changes={"area.origin": list(ORIGIN), "targets": [track(file)]})
        assert anchor_of(chosen).start == datetime(2015, 11, 16, 6, tzinfo=UTC)
        file.unlink()
        with pytest.raises(ScenarioError, match=r"no such file, and it says when the run begins\n  fix: .*--start"):
            anchor_of(chosen)


def track(file):
    return {"kind": "track", "file": str(file), "radius": 10.0}


class TestAway:
    """Who was lost, had not joined or was under water has no place, least of all (0, 0)."""

    def test_has_no_number_at_all(self):
        record = made_record()
        record.trajectories[0].alive[1, 3] = False
        record.trajectories[0].target_present[2, 0] = False
        found = voyages(record)
        for values in (found.lon, found.lat, found.speed, found.course, found.heading):
            assert np.isnan(values[1, 3])
            assert np.isnan(values[2, 5])
        assert np.isfinite(found.lon).sum() == found.there.sum() == 3 * 6 - 2

    def test_cuts_a_voyage_into_pieces(self):
        record = made_record(steps=range(6))
        record.trajectories[0].alive[[0, 2, 3], 3] = False
        record.trajectories[0].alive[:, 4] = False
        found = voyages(record)
        assert found.pieces(3) == [slice(1, 2), slice(4, 6)]
        assert [craft.id for _, craft in found.known()] == ["agent-0", "agent-1", "agent-2", "agent-3", "target-0"]

    def test_a_target_is_as_slow_as_unknown_after_it_was_away(self):
        record = made_record(steps=range(4))
        record.trajectories[0].target_present[1, 0] = False
        assert np.isnan(voyages(record).speed[:, -1]).tolist() == [True, True, True, False]


class TestFrames:
    def test_every_takes_the_multiples(self):
        record = made_record(steps=[0, 5, 10, 11, 12])
        assert frames_of(record, 0, every=5).step.tolist() == [0, 5, 10]
        with pytest.raises(RecordError, match="keeps no frame of a step that is a multiple of 7"):
            frames_of(made_record(steps=[1, 2]), 0, every=7)
        with pytest.raises(ScenarioError, match="every: is 0"):
            frames_of(record, 0, every=0)

    def test_of_a_run_that_kept_none_say_which_did(self):
        with pytest.raises(RecordError, match=r"run 3: keeps no frames\n  fix: there are frames of run 0"):
            frames_of(made_record(), 3)


class TestRefusals:
    """One error: where, what, how to fix."""

    @pytest.mark.parametrize(
        ("given", "words"),
        [
            ({"origin": None}, "has no place on Earth .*\n  fix: .*--origin LON,LAT"),
            ({"start": None}, "says not when .*\n  fix: .*--start 2015"),
            ({"start": "2015-11-16T06:00:00"}, "has no time zone\n  fix: end it with Z"),
            ({"start": "yesterday"}, "yesterday: is not a date"),
            ({"start": 1447653600}, "is not a date"),
            ({"start": "0001-01-01T00:00:00+23:00"}, "is not a date"),
            ({"origin": (200.0, 95.0)}, "is not a place on Earth"),
            ({"origin": (float("nan"), 1.0)}, "is not a place on Earth"),
            ({"origin": (1.0,)}, "is not a place on Earth"),
            ({"origin": "north"}, "is not a place on Earth"),
        ],
    )
    def test_of_what_is_no_place_or_time(self, given, words):
        with pytest.raises(ScenarioError, match=words):
            anchor_of(scenario(), **{"origin": ORIGIN, "start": START, **given})

    def test_of_a_run_beyond_the_year_9999(self):
        with pytest.raises(ScenarioError, match="after the year 9999"):
            voyages(made_record(steps=[0, 100]), start="9999-12-31T23:59:59Z")
