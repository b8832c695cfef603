"""Specification of reading a recorded track: bad files are refused, good ones become meters."""

import sys
from pathlib import Path

import numpy as np
import pytest

from shoal.core.errors import MissingExtraError, TrackError
from shoal.scenario.tracks import Track, position_at, read_track

DATA = Path(__file__).resolve().parents[2] / ".." / "shared" / "data"
SOLENT = DATA / "solent" / "solent_ais_2016-01-12.csv"
DRIFTERS = DATA / "mab" / "mab_drifters_uscg_sldmb.csv"
MAB_AIS = DATA / "mab" / "mab_ais_2022-01-03.csv"
CURRENTS = DATA / "mab" / "mab_currents_hfradar_2019-01-01.nc"
FERRY, SHIP = "mmsi=235069877", "mmsi=247007000"
DRIFTER, GLITCHING_VESSEL = "drifter_id=8213480", "mmsi=338415278"

DEGREE = 111_319.49  # [m] of longitude on the equator of WGS84
YEAR_ONE_TO_2020 = (737_424 + 2) * 86_400  # [s]; CF's year 1 is Julian, 2 days earlier


def real(path):
    if not path.is_file():
        pytest.skip(f"the real data file {path.name} is not beside this repository")
    return path


def write(folder, name, *lines):
    path = folder / name
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def csv_file(folder, *lines, header="time,lat,lon"):
    return write(folder, "track.csv", header, *lines)


def eastward(folder, lons, *, seconds_apart=60, lat=0.0):
    """A csv track along a parallel."""
    rows = (f"{1_600_000_000 + i * seconds_apart},{lat},{lon}" for i, lon in enumerate(lons))
    return csv_file(folder, *rows)


def refusal(path, **options):
    """(where, problem, fix) of the error that reading `path` raises."""
    with pytest.raises(TrackError) as caught:
        read_track(path, **options)
    return caught.value.args


class TestCsv:
    """Columns time, lat, lon under their usual names; the rest is ignored."""

    def test_one_degree_of_longitude_on_the_equator_is_its_known_length(self, tmp_path):
        track = read_track(eastward(tmp_path, [0.0, 1.0], seconds_apart=3600))
        assert track.x[1] - track.x[0] == pytest.approx(DEGREE, rel=1e-6)
        assert track.y == pytest.approx([0.0, 0.0])

    def test_time_counts_seconds_from_the_first_fix(self, tmp_path):
        path = csv_file(tmp_path, "2020-01-01T00:00:10.125Z,0,0", "2020-01-01T00:01:10.25Z,0,0")
        track = read_track(path)
        assert track.time.tolist() == [0.0, 60.125]
        assert track.start == "2020-01-01T00:00:10.125000Z"

    @pytest.mark.parametrize(
        "header",
        ["TIME,Lat,LON", "timestamp,latitude,longitude", "datetime, Latitude ,lng",
         "BaseDateTime,LAT,LON"],
    )  # fmt: skip
    def test_usual_column_names_are_accepted_in_any_case(self, tmp_path, header):
        path = csv_file(tmp_path, "0,1,2", "60,1,2", header=header)
        assert read_track(path).origin == (2.0, 1.0)

    def test_other_columns_may_stand_anywhere_and_hold_anything(self, tmp_path):
        path = csv_file(tmp_path, "?,0,1,2,", ",60,1,2,nan", header="a,time,lat,lon,b")
        assert len(read_track(path).time) == 2

    def test_a_byte_order_mark_and_blank_lines_do_no_harm(self, tmp_path):
        path = csv_file(tmp_path, "0,1,2", "", "60,1,2", header="\ufefftime,lat,lon")
        assert len(read_track(path).time) == 2

    def test_a_time_zone_is_honored(self, tmp_path):
        path = csv_file(tmp_path, "2020-01-01T02:00:00+02:00,0,0", "2020-01-01T00:01:00Z,0,0")
        track = read_track(path)
        assert track.start == "2020-01-01T00:00:00Z"
        assert track.time.tolist() == [0.0, 60.0]
        assert track.notes == ()

    def test_naive_times_are_taken_as_utc_and_noted_once(self, tmp_path):
        path = csv_file(tmp_path, "2020-01-01T00:00:00,0,0", "2020-01-01 00:01:00,0,0")
        track = read_track(path)
        assert track.start == "2020-01-01T00:00:00Z"
        assert track.notes == ("Times without a time zone were taken as UTC.",)

    def test_plain_numbers_are_taken_as_unix_seconds_and_noted(self, tmp_path):
        track = read_track(csv_file(tmp_path, "86400,0,0", "86460.5,0,0"))
        assert track.start == "1970-01-02T00:00:00Z"
        assert track.time.tolist() == [0.0, 60.5]
        assert track.notes == ("Times that are plain numbers were taken as unix seconds.",)

    def test_a_longer_last_column_or_a_short_row_without_need_is_fine(self, tmp_path):
        path = csv_file(tmp_path, "0,1,2,x,extra", "60,1,2", header="time,lat,lon,note")
        assert len(read_track(path).time) == 2


class TestBadFile:
    """Refused before any line is read."""

    def test_a_missing_file_is_named_with_its_nearest_neighbor(self, tmp_path):
        csv_file(tmp_path, "0,0,0")
        where, problem, fix = refusal(tmp_path / "trakc.csv")
        assert where.endswith("trakc.csv")
        assert problem == "no such file"
        assert "track.csv" in fix

    def test_a_missing_folder_is_a_missing_file(self, tmp_path):
        assert refusal(tmp_path / "nowhere" / "track.csv")[1] == "no such file"

    @pytest.mark.parametrize("name", ["track.csv", "track.gpx", "track.nc"])
    def test_an_empty_file_is_said_to_be_empty(self, tmp_path, name):
        (tmp_path / name).touch()
        assert refusal(tmp_path / name)[1] == "is empty"

    @pytest.mark.parametrize("name", ["track.kml", "track", "track.csv.gz"])
    def test_another_format_is_answered_with_those_supported(self, tmp_path, name):
        assert ".csv, .gpx and .nc" in refusal(tmp_path / name)[1]

    def test_a_suffix_counts_in_any_case(self, tmp_path):
        path = write(tmp_path, "TRACK.CSV", "time,lat,lon", "0,0,0", "60,0,0")
        assert len(read_track(path).time) == 2

    def test_text_in_another_encoding_is_refused(self, tmp_path):
        path = tmp_path / "track.csv"
        path.write_bytes("time,lat,lon,naïve\n".encode("latin-1"))
        assert refusal(path)[1] == "is not UTF-8 text"

    def test_a_file_that_is_not_netcdf_is_refused(self, tmp_path):
        pytest.importorskip("netCDF4")
        assert "cannot be read" in refusal(write(tmp_path, "track.nc", "time,lat,lon"))[1]

    def test_a_line_without_end_is_no_csv(self, tmp_path):
        where, problem, _ = refusal(write(tmp_path, "track.csv", "x" * 200_000))
        assert where.endswith("track.csv:1")
        assert "is not CSV" in problem

    def test_a_header_alone_holds_no_fixes(self, tmp_path):
        assert refusal(csv_file(tmp_path))[1] == "holds no fixes"

    def test_a_path_may_be_text_and_its_error_repeats_it(self, tmp_path):
        path = str(tmp_path / "track.csv")
        assert refusal(path)[0] == path


class TestBadLine:
    """The error names the file and the line, what is wrong and what to do."""

    @pytest.mark.parametrize(
        ("header", "missing"),
        [("when,lat,lon", "time or timestamp"), ("time,y,lon", "lat or latitude"),
         ("time,lat,x", "lon or longitude"), ("time;lat;lon", "time or timestamp")],
    )  # fmt: skip
    def test_a_missing_column_is_named_with_those_there(self, tmp_path, header, missing):
        where, problem, fix = refusal(csv_file(tmp_path, "0,0,0", header=header))
        assert where.endswith("track.csv:1")
        assert missing in problem
        assert all(name in problem for name in header.split(","))
        assert "time,lat,lon" in fix

    @pytest.mark.parametrize(
        ("line", "problem"),
        [
            ("60,nan,0", "lat 'nan' is not a number"),
            ("60,0,NaN", "lon 'NaN' is not a number"),
            ("60,,0", "lat is empty"),
            ("60,0, ", "lon is empty"),
            ("60,0", "lon is empty"),
            ("60,50N,0", "lat '50N' is not a number"),
            ("60,0,inf", "lon 'inf' is not a number"),
            ("60,90.1,0", "lat 90.1 is outside [-90, 90]"),
            ("60,0,-180.5", "lon -180.5 is outside [-180, 360]"),
            ("60,0,361", "lon 361 is outside [-180, 360]"),
            ("noon,0,0", "time 'noon' cannot be read"),
            (",0,0", "time '' cannot be read"),
            ("2020-13-01T00:00:00Z,0,0", "time '2020-13-01T00:00:00Z' cannot be read"),
            ("nan,0,0", "time nan is no unix time [s]"),
            ("1600000000000,0,0", "time 1600000000000 is no unix time [s]"),
        ],
    )
    def test_a_bad_value_is_named_with_its_line(self, tmp_path, line, problem):
        where, found, fix = refusal(csv_file(tmp_path, "0,0,0", line))
        assert where.endswith("track.csv:3")
        assert found.startswith(problem)
        assert fix

    def test_blank_lines_count_as_lines(self, tmp_path):
        assert refusal(csv_file(tmp_path, "0,0,0", "", "", "60,x,0"))[0].endswith(":5")

    def test_a_bad_line_of_another_vessel_is_no_concern(self, tmp_path):
        path = csv_file(tmp_path, "0,0,0,1", "?,?,?,2", "60,0,0,1", header="time,lat,lon,mmsi")
        assert len(read_track(path, track_id="mmsi=1").time) == 2

    def test_time_going_backwards_names_the_line_and_both_times(self, tmp_path):
        where, problem, fix = refusal(csv_file(tmp_path, "0,0,0", "120,0,0", "60,0,0"))
        assert where.endswith("track.csv:4")
        assert "1970-01-01T00:02:00Z" in problem
        assert "1970-01-01T00:01:00Z" in problem
        assert fix == "sort the file by time"

    @pytest.mark.parametrize("lines", [["0,0,0"], ["0,0,0", "0,0,0"]])
    def test_one_time_alone_makes_no_track(self, tmp_path, lines):
        assert "1 usable fix" in refusal(csv_file(tmp_path, *lines))[1]


class TestTrackId:
    """COLUMN=VALUE picks one track out of many."""

    FLEET = ("0,0,0,235070762", "10,0,5,99", "60,0,0.001,235070762", "70,0,5,99", "90,0,5,99")
    HEADER = "time,lat,lon,mmsi"

    def fleet(self, folder):
        return csv_file(folder, *self.FLEET, header=self.HEADER)

    def test_only_the_rows_with_the_value_are_read(self, tmp_path):
        track = read_track(self.fleet(tmp_path), track_id="mmsi=235070762")
        assert track.time.tolist() == [0.0, 60.0]

    @pytest.mark.parametrize("track_id", ["mmsi=235070762.0", " MMSI = 235070762 ", "mmsi=+2.35070762e8"])
    def test_values_compare_as_numbers_and_spaces_and_case_do_not_count(self, tmp_path, track_id):
        assert len(read_track(self.fleet(tmp_path), track_id=track_id).time) == 2

    def test_long_numbers_that_differ_in_the_last_digit_stay_apart(self, tmp_path):
        rows = ("0,0,0,10000000000000000001", "60,0,0,10000000000000000002", "90,0,0,1")
        path = csv_file(tmp_path, *rows, header="time,lat,lon,id")
        assert "1 usable fix" in refusal(path, track_id="id=10000000000000000001")[1]

    def test_a_word_compares_as_it_is(self, tmp_path):
        path = csv_file(tmp_path, "0,0,0,Ann", "60,0,0,Ann", "90,0,0,Bo", header="time,lat,lon,name")
        assert len(read_track(path, track_id="name=Ann").time) == 2

    def test_any_column_may_choose_when_one_track_is_left(self, tmp_path):
        path = csv_file(
            tmp_path, "0,0,0,tug,1", "60,0,0,tug,1", "90,0,0,yacht,2",
            header="time,lat,lon,kind,mmsi",
        )  # fmt: skip
        assert len(read_track(path, track_id="kind=tug").time) == 2

    def test_a_column_that_leaves_several_tracks_is_refused(self, tmp_path):
        path = csv_file(tmp_path, "0,0,0,0,A", "60,0,0,0,B", "90,0,0,1,A", header="time,lat,lon,leg,drifter_id")
        _, problem, fix = refusal(path, track_id="leg=0")
        assert problem.startswith("leg=0 holds 2 tracks, told apart by drifter_id")
        assert "--track-id drifter_id=A" in fix

    def test_several_tracks_without_a_choice_are_refused_with_an_example(self, tmp_path):
        _, problem, fix = refusal(self.fleet(tmp_path))
        assert "holds 2 tracks, told apart by mmsi" in problem
        assert "--track-id mmsi=99 has the most fixes, 3" in fix

    def test_one_track_needs_no_choice_though_it_has_an_id(self, tmp_path):
        path = csv_file(tmp_path, "0,0,0,7", "60,0,0,7.0", "90,0,0,", header=self.HEADER)
        assert len(read_track(path).time) == 3

    def test_an_id_that_numbers_the_rows_tells_no_tracks_apart(self, tmp_path):
        path = csv_file(tmp_path, "0,0,0,1", "60,0,0,2", header="time,lat,lon,id")
        assert len(read_track(path).time) == 2

    def test_an_unknown_column_is_answered_with_those_there_and_the_nearest(self, tmp_path):
        _, problem, fix = refusal(self.fleet(tmp_path), track_id="mmis=99")
        assert "time, lat, lon, mmsi" in problem
        assert fix == "did you mean mmsi=99?"

    def test_an_unknown_column_near_to_none_suggests_none(self, tmp_path):
        assert refusal(self.fleet(tmp_path), track_id="q=9")[2] == "use one of these columns"

    def test_an_unknown_value_is_answered_with_how_many_and_the_nearest(self, tmp_path):
        _, problem, fix = refusal(self.fleet(tmp_path), track_id="mmsi=235070726")
        assert "nearest of the 2 there: 235070762" in problem
        assert "--track-id mmsi=235070762" in fix

    def test_a_column_without_a_value_anywhere_is_said_to_be_so(self, tmp_path):
        path = csv_file(tmp_path, "0,0,0,", "60,0,0,", header=self.HEADER)
        assert refusal(path, track_id="mmsi=1")[1] == "no fix has a mmsi"

    @pytest.mark.parametrize("track_id", ["235070762", "mmsi=", "=1", ""])
    def test_another_form_is_refused(self, tmp_path, track_id):
        assert refusal(self.fleet(tmp_path), track_id=track_id)[1] == "is not COLUMN=VALUE"


class TestOptions:
    @pytest.mark.parametrize("max_speed", [0.0, -1.0, float("nan")])
    def test_max_speed_is_positive(self, tmp_path, max_speed):
        assert refusal(eastward(tmp_path, [0, 0]), max_speed=max_speed)[0] == "max_speed"

    @pytest.mark.parametrize("max_gap", [0.0, -1.0, float("nan")])
    def test_max_gap_is_positive(self, tmp_path, max_gap):
        assert refusal(eastward(tmp_path, [0, 0]), max_gap=max_gap)[0] == "max_gap"

    @pytest.mark.parametrize("origin", [(0.0, 91.0), (-181.0, 0.0), (float("nan"), 0.0)])
    def test_origin_lies_on_earth(self, tmp_path, origin):
        assert refusal(eastward(tmp_path, [0, 0]), origin=origin)[0] == "origin"


class TestDuplicates:
    """Of fixes with the same time the first counts."""

    def test_the_first_is_kept_and_the_others_counted(self, tmp_path):
        path = csv_file(
            tmp_path, "2020-01-01T00:00:00Z,0,0", "2020-01-01T00:01:00Z,0,0.001",
            "2020-01-01T00:01:00Z,0,0.002", "2020-01-01T00:01:00Z,0,0.003",
        )  # fmt: skip
        track = read_track(path)
        assert track.time.tolist() == [0.0, 60.0]
        assert track.x[1] - track.x[0] == pytest.approx(0.001 * DEGREE, rel=1e-3)
        assert track.notes == ("Fixes dropped for repeating the time of the one before: 2.",)


class TestJumps:
    """No target covers more than max_speed between two fixes."""

    def steps(self, folder, *lons, **options):
        return read_track(eastward(folder, lons), **options)

    def jump_notes(self, track):
        return [note for note in track.notes if "speed above" in note]

    def test_a_path_below_max_speed_is_kept_whole(self, tmp_path):
        track = self.steps(tmp_path, 0.0, 0.001, 0.002)
        assert len(track.time) == 3
        assert self.jump_notes(track) == []

    def test_a_fix_far_off_is_dropped_and_both_sides_stay(self, tmp_path):
        track = self.steps(tmp_path, 0.0, 0.001, 0.002, 9.0, 0.004, 0.005)
        assert track.time.tolist() == [0.0, 60.0, 120.0, 240.0, 300.0]
        (note,) = self.jump_notes(track)
        assert "40 m/s could reach them: 1, at 2020-09-13T12:29:40Z." in note

    def test_a_wrong_first_or_last_fix_is_dropped(self, tmp_path):
        track = self.steps(tmp_path, 9.0, 0.001, 0.002, 0.003, 9.0)
        assert len(track.time) == 3
        assert track.start == "2020-09-13T12:27:40Z"
        assert track.time[0] == 0.0

    def test_the_longest_run_wins_wherever_it_is(self, tmp_path):
        track = self.steps(tmp_path, 9.0, 9.001, 0.0, 0.001, 0.002, 5.0, 5.001)
        assert np.ptp(track.x) == pytest.approx(0.002 * DEGREE, rel=1e-3)
        assert len(track.time) == 3

    def test_runs_on_the_left_within_reach_of_the_longest_are_kept(self, tmp_path):
        track = self.steps(tmp_path, 0.0, 0.001, 9.0, 0.003, 0.004, 0.005)
        assert len(track.time) == 5

    def test_many_dropped_fixes_show_only_the_first_times(self, tmp_path):
        track = self.steps(tmp_path, *(0.001 * i for i in range(6)), 5.0, 6.0, 7.0, 8.0, 9.0)
        (note,) = self.jump_notes(track)
        assert "them: 5, at" in note
        assert note.count("2020-") == 3
        assert note.endswith(" and 2 more.")

    def test_a_higher_max_speed_lets_more_through(self, tmp_path):
        path = eastward(tmp_path, [0.0, 0.01, 0.03, 0.04])  # 19, 37 and 19 m/s
        assert len(read_track(path).time) == 4
        assert len(read_track(path, max_speed=30.0).time) == 2

    def test_a_track_of_jumps_only_is_refused(self, tmp_path):
        _, problem, fix = refusal(eastward(tmp_path, [0.0, 5.0, 10.0]))
        assert "1 usable fix" in problem
        assert "max_speed" in fix

    def test_the_speed_is_measured_along_the_earth(self, tmp_path):
        """At 60 degrees north a degree of longitude is half as long."""
        lons = [0.0, 0.03]
        assert len(read_track(eastward(tmp_path, lons, lat=60.0)).time) == 2
        refusal(eastward(tmp_path, lons, lat=0.0))


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


class TestMaxGap:
    def test_it_is_five_minutes_at_least(self, tmp_path):
        assert read_track(eastward(tmp_path, [0, 0, 0])).max_gap == 300.0

    def test_it_is_five_median_intervals_if_that_is_longer(self, tmp_path):
        path = csv_file(tmp_path, "0,0,0", "600,0,0", "1200,0,0", "90000,0,0")
        assert read_track(path).max_gap == 3000.0

    def test_it_can_be_chosen(self, tmp_path):
        assert read_track(eastward(tmp_path, [0, 0]), max_gap=7).max_gap == 7.0

    def test_longer_silences_are_noted(self, tmp_path):
        path = csv_file(tmp_path, "0,0,0", "60,0,0", "120,0,0", "1120,0,0", "2120,0,0")
        (note,) = read_track(path, max_gap=900.0).notes[1:]
        assert "longer than 900 s" in note
        assert "absent: 2, 2000 s in all" in note


class TestDigest:
    """The same path has the same digest, another path or gap another one."""

    def test_it_depends_on_the_numbers_not_on_the_file(self, tmp_path):
        first = write(tmp_path, "a.csv", "time,lat,lon", "0,0,0", "60,0,0.001")
        second = write(tmp_path, "b.csv", "x,longitude,latitude,time", ",0,0,0", ",0.0010,0,60")
        assert read_track(first).digest == read_track(second).digest

    def test_a_moved_fix_another_time_or_gap_changes_it(self, tmp_path):
        digests = {
            read_track(csv_file(tmp_path, "0,0,0", "60,0,0.001")).digest,
            read_track(csv_file(tmp_path, "0,0,0", "60,0,0.002")).digest,
            read_track(csv_file(tmp_path, "0,0,0", "61,0,0.001")).digest,
            read_track(csv_file(tmp_path, "0,0,0", "60,0,0.001"), max_gap=400.0).digest,
        }
        assert len(digests) == 4
        assert {len(digest) for digest in digests} == {64}


class TestPositionAt:
    """Straight between fixes, absent where nothing was recorded."""

    TRACK = Track(
        time=np.array([0.0, 10.0, 20.0, 100.0, 110.0]),
        x=np.array([0.0, 10.0, 20.0, 100.0, 100.0]),
        y=np.array([0.0, -20.0, 0.0, 0.0, 5.0]),
        origin=(0.0, 0.0),
        start="2020-01-01T00:00:00Z",
        max_gap=50.0,
        notes=(),
        digest="",
    )

    def test_between_two_fixes_it_is_on_the_line(self):
        x, y, present = position_at(self.TRACK, 2.5)
        assert (float(x), float(y), bool(present)) == (2.5, -5.0, True)

    def test_at_every_fix_it_is_there(self):
        x, y, present = position_at(self.TRACK, self.TRACK.time)
        assert x.tolist() == self.TRACK.x.tolist()
        assert y.tolist() == self.TRACK.y.tolist()
        assert present.all()

    def test_before_the_first_and_after_the_last_fix_it_is_absent(self):
        x, y, present = position_at(self.TRACK, [-1.0, 110.0001])
        assert not present.any()
        assert np.isnan([x, y]).all()

    def test_inside_a_long_silence_it_is_absent_and_at_its_ends_present(self):
        present = position_at(self.TRACK, [20.0, 20.0001, 60.0, 99.9999, 100.0])[2]
        assert present.tolist() == [True, False, False, False, True]

    def test_a_silence_of_exactly_max_gap_is_bridged(self, tmp_path):
        track = read_track(eastward(tmp_path, [0.0, 0.001]), max_gap=60.0)
        assert bool(position_at(track, 30.0)[2])
        shorter = read_track(eastward(tmp_path, [0.0, 0.001]), max_gap=59.9)
        assert not bool(position_at(shorter, 30.0)[2])

    def test_no_time_is_no_presence(self):
        assert not bool(position_at(self.TRACK, float("nan"))[2])

    def test_the_answer_has_the_shape_of_the_question(self):
        assert [part.shape for part in position_at(self.TRACK, np.zeros((2, 3)))] == [(2, 3)] * 3


class TestGpx:
    """GPX 1.0 and 1.1, tracks only."""

    POINTS = ('<trkpt lat="0" lon="0"><time>2020-01-01T00:00:00Z</time></trkpt>',
              '<trkpt lat="0" lon="0.001"><ele>3</ele><time>2020-01-01T00:01:00Z</time></trkpt>',
              '<trkpt lat="0" lon="0.002"><time>2020-01-01T00:02:00Z</time></trkpt>')  # fmt: skip

    def gpx(self, folder, *body, version="1/1"):
        return write(
            folder,
            "track.gpx",
            '<?xml version="1.0" encoding="UTF-8"?>',
            f'<gpx xmlns="http://www.topografix.com/GPX/{version}">',
            *body,
            "</gpx>",
        )

    def one(self, *points, name=""):
        return (f"<trk><name>{name}</name><trkseg>", *points, "</trkseg></trk>")

    @pytest.mark.parametrize("version", ["1/0", "1/1"])
    def test_both_versions_are_read(self, tmp_path, version):
        track = read_track(self.gpx(tmp_path, *self.one(*self.POINTS), version=version))
        assert track.time.tolist() == [0.0, 60.0, 120.0]
        assert track.x == pytest.approx([-0.001 * DEGREE, 0.0, 0.001 * DEGREE], rel=1e-3)
        assert track.notes == ()

    def test_a_namespace_prefix_changes_nothing(self, tmp_path):
        text = self.gpx(tmp_path, *self.one(*self.POINTS)).read_text()
        prefixed = text.replace("</", "</g:").replace("<t", "<g:t").replace("<gpx xmlns", "<g:gpx xmlns:g")
        prefixed = prefixed.replace("<name", "<g:name").replace("<ele", "<g:ele")
        assert len(read_track(write(tmp_path, "prefixed.gpx", prefixed)).time) == 3

    def test_segments_follow_one_another(self, tmp_path):
        body = self.one(self.POINTS[0], "</trkseg><trkseg>", *self.POINTS[1:])
        assert len(read_track(self.gpx(tmp_path, *body)).time) == 3

    def test_the_name_chooses_a_track(self, tmp_path):
        body = self.one(*self.POINTS, name="Ferry 1") + self.one(*self.POINTS[:2], name="Tug")
        assert len(read_track(self.gpx(tmp_path, *body), track_id="name=Tug").time) == 2

    def test_the_index_chooses_a_track(self, tmp_path):
        body = self.one(*self.POINTS) + self.one(*self.POINTS[:2])
        assert len(read_track(self.gpx(tmp_path, *body), track_id="track=1").time) == 2

    def test_several_tracks_without_a_choice_are_refused_with_an_example(self, tmp_path):
        body = self.one(*self.POINTS[:2]) + self.one(*self.POINTS)
        _, problem, fix = refusal(self.gpx(tmp_path, *body))
        assert "holds 2 tracks" in problem
        assert "--track-id track=1 has the most fixes, 3" in fix

    def test_a_name_that_two_tracks_share_does_not_choose(self, tmp_path):
        body = self.one(*self.POINTS, name="Log") + self.one(*self.POINTS, name="Log")
        assert "--track-id track=0" in refusal(self.gpx(tmp_path, *body), track_id="name=Log")[2]

    def test_an_unknown_name_is_answered_with_the_nearest(self, tmp_path):
        path = self.gpx(tmp_path, *self.one(*self.POINTS, name="Ferry"))
        assert "name=Ferry" in refusal(path, track_id="name=Fery")[2]

    def test_an_unknown_column_is_answered_with_track_and_name(self, tmp_path):
        path = self.gpx(tmp_path, *self.one(*self.POINTS))
        assert "it has track, name" in refusal(path, track_id="mmsi=1")[1]

    @pytest.mark.parametrize(
        ("point", "problem"),
        [
            ('<trkpt lat="0" lon="0"/>', "time '' cannot be read"),
            ('<trkpt lon="0"><time>2021-01-01T00:00:00Z</time></trkpt>', "lat is empty"),
            ('<trkpt lat="0" lon="x"><time>2021-01-01T00:00:00Z</time></trkpt>', "lon 'x' is not"),
            ('<trkpt lat="99" lon="0"><time>2021-01-01T00:00:00Z</time></trkpt>', "lat 99 is out"),
        ],
    )
    def test_a_bad_point_is_named_with_its_line(self, tmp_path, point, problem):
        where, found, _ = refusal(self.gpx(tmp_path, *self.one(self.POINTS[0], point)))
        assert where.endswith("track.gpx:5")
        assert found.startswith(problem)

    def test_a_doctype_is_refused_before_its_entities_can_act(self, tmp_path):
        bomb = '<!DOCTYPE gpx [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]><gpx>&b;</gpx>'
        where, problem, fix = refusal(write(tmp_path, "bomb.gpx", '<?xml version="1.0"?>', bomb))
        assert where.endswith("bomb.gpx:2")
        assert "DOCTYPE" in problem
        assert fix == "remove it"

    def test_an_entity_without_a_doctype_is_no_xml(self, tmp_path):
        assert "is not XML" in refusal(write(tmp_path, "e.gpx", "<gpx>&b;</gpx>"))[1]

    def test_broken_xml_is_named_with_its_line(self, tmp_path):
        where, problem, _ = refusal(write(tmp_path, "broken.gpx", "<gpx>", "<trk>", "</gpx>"))
        assert where.endswith("broken.gpx:3")
        assert "is not XML" in problem

    @pytest.mark.parametrize("body", ["<rte><rtept lat='0' lon='0'/></rte>", ""])
    def test_a_file_without_a_track_is_refused(self, tmp_path, body):
        assert "holds no <trk>" in refusal(self.gpx(tmp_path, body))[1]

    def test_other_xml_is_refused(self, tmp_path):
        assert "holds no <trk>" in refusal(write(tmp_path, "a.gpx", "<kml><trk/></kml>"))[1]

    def test_a_track_without_points_holds_no_fixes(self, tmp_path):
        assert refusal(self.gpx(tmp_path, "<trk/>"))[1] == "holds no fixes"


class TestNetcdf:
    """CF trajectories: one, a rectangle of them, or ragged."""

    @pytest.fixture
    def netcdf(self, tmp_path):
        netcdf4 = pytest.importorskip("netCDF4")
        path = tmp_path / "track.nc"

        def make(dimensions, **variables):
            """Each variable: (dimensions, values, attributes)."""
            with netcdf4.Dataset(path, "w") as dataset:
                for name, size in dimensions.items():
                    dataset.createDimension(name, size)
                for name, (over, values, attributes) in variables.items():
                    values = np.ma.asarray(values)
                    kind = str if values.dtype.kind == "U" else values.dtype
                    fill = attributes.pop("_FillValue", None)
                    variable = dataset.createVariable(name, kind, over, fill_value=fill)
                    variable.setncatts(attributes)
                    variable[...] = np.asarray(values, object) if kind is str else values
            return path

        return make

    UNITS = "seconds since 2020-01-01 00:00:00"

    def lat(self, over, values, **more):
        return over, np.ma.asarray(values, float), {"standard_name": "latitude", **more}

    def lon(self, over, values, **more):
        return over, np.ma.asarray(values, float), {"standard_name": "longitude", **more}

    def time(self, over, values, units=UNITS, **more):
        return over, np.ma.asarray(values), {"standard_name": "time", "units": units, **more}

    def single(self, netcdf, **changes):
        variables = {
            "lat": self.lat(["obs"], [0.0, 0.0, 0.0]),
            "lon": self.lon(["obs"], [0.0, 0.001, 0.002]),
            "time": self.time(["obs"], [0.0, 60.0, 120.0]),
        }
        return netcdf({"obs": 3}, **{**variables, **changes})

    def test_one_trajectory_is_read(self, netcdf):
        track = read_track(self.single(netcdf))
        assert track.time.tolist() == [0.0, 60.0, 120.0]
        assert track.start == "2020-01-01T00:00:00Z"
        assert track.x == pytest.approx([-0.001 * DEGREE, 0.0, 0.001 * DEGREE], rel=1e-3)
        assert track.notes == ()

    def test_the_same_path_in_csv_has_the_same_digest(self, netcdf, tmp_path):
        assert read_track(self.single(netcdf)).digest == read_track(eastward(tmp_path, [0.0, 0.001, 0.002])).digest

    def test_variables_are_found_by_standard_name_units_or_name(self, netcdf):
        path = netcdf(
            {"obs": 2},
            status=(["obs"], np.array([1, 2]), {}),
            a=(["obs"], np.array([1.0, 1.0]), {"units": "degrees_north"}),
            b=(["obs"], np.array([2.0, 2.0]), {"standard_name": "longitude"}),
            time=(["obs"], np.array([0, 60]), {"units": self.UNITS}),
        )
        assert read_track(path).origin == (2.0, 1.0)

    def test_the_name_decides_between_two_with_the_same_units(self, netcdf):
        north = {"units": "degrees_north"}
        path = self.single(
            netcdf,
            deploy_lat=([], np.array(7.0), dict(north)),
            lat=(["obs"], np.array([1.0, 1.0, 1.0]), dict(north)),
        )
        assert read_track(path).origin[1] == 1.0

    def test_a_missing_variable_is_named_with_those_there(self, netcdf):
        path = netcdf({"obs": 2}, foo=(["obs"], np.array([1.0, 1.0]), {}))
        _, problem, fix = refusal(path)
        assert "standard_name latitude" in problem
        assert "it has foo" in problem
        assert "standard_name = 'latitude'" in fix

    @pytest.mark.parametrize(
        ("units", "values"),
        [
            ("days since 2020-01-01", [0.0, 1 / 1440, 2 / 1440]),
            ("hours since 2020-01-01T02:00:00+02:00", [0.0, 1 / 60, 2 / 60]),
            ("minutes since 2019-12-31 23:00", [60, 61, 62]),
            ("milliseconds since 2020-01-01", [0, 60_000, 120_000]),
            ("nanoseconds since 2020-01-01 00:00:00.000000000", [0, 60 * 10**9, 120 * 10**9]),
            ("seconds since 0001-01-01", [YEAR_ONE_TO_2020 + i * 60 for i in range(3)]),
            ("s since 1970-01-01", [1577836800, 1577836860, 1577836920]),
        ],
    )
    def test_time_units_are_decoded(self, netcdf, units, values):
        track = read_track(self.single(netcdf, time=self.time(["obs"], values, units)))
        assert track.start == "2020-01-01T00:00:00Z"
        assert track.time.tolist() == [0.0, 60.0, 120.0]

    @pytest.mark.parametrize(
        ("units", "more", "words"),
        [
            ("seconds", {}, "no time that was recorded"),
            ("fortnights since 2020-01-01", {}, "no time that was recorded"),
            (UNITS, {"calendar": "noleap"}, "calendar 'noleap'"),
            ("seconds since yesterday", {}, "'yesterday' cannot be read"),
        ],
    )
    def test_a_time_that_cannot_be_decoded_is_refused(self, netcdf, units, more, words):
        time = self.time(["obs"], [0, 60, 120], units, **more)
        where, problem, _ = refusal(self.single(netcdf, time=time))
        assert where.endswith("track.nc time")
        assert words in problem

    def test_a_grid_is_refused_with_its_dimensions(self, netcdf):
        path = netcdf(
            {"lat": 2, "lon": 2, "time": 2},
            lat=self.lat(["lat"], [0, 1]),
            lon=self.lon(["lon"], [0, 1]),
            time=self.time(["time"], [0, 60]),
        )
        _, problem, _ = refusal(path)
        assert problem == "lat(lat), lon(lon), time(time) is no trajectory; is it a grid?"

    def test_a_bad_value_is_named_with_its_index(self, netcdf):
        where, problem, _ = refusal(self.single(netcdf, lat=self.lat(["obs"], [0, 0, 95])))
        assert where.endswith("track.nc[2]")
        assert problem == "lat 95 is outside [-90, 90]"

    def test_a_nan_that_the_file_does_not_mark_as_missing_is_refused(self, netcdf):
        path = self.single(netcdf, lat=self.lat(["obs"], [0, np.nan, 0]))
        assert refusal(path)[1] == "lat 'nan' is not a number"

    def test_masked_positions_are_dropped_and_noted(self, netcdf):
        lat = self.lat(["obs"], [0, -9, 0], _FillValue=-9.0)
        track = read_track(self.single(netcdf, lat=lat))
        assert track.time.tolist() == [0.0, 120.0]
        assert track.notes == ("Fixes dropped because the file marks them missing: 1.",)

    @pytest.mark.parametrize("all_three", [False, True])
    def test_a_file_of_missing_values_only_is_refused(self, netcdf, all_three):
        nothing = np.ma.masked_all(3)
        changes = {"lat": self.lat(["obs"], nothing)}
        if all_three:
            changes |= {"lon": self.lon(["obs"], nothing), "time": self.time(["obs"], nothing)}
        assert refusal(self.single(netcdf, **changes))[1] in (
            "every fix lacks its time or position",
            "holds no fixes",
        )

    def rectangle(self, netcdf, over=("trajectory", "obs"), **more):
        """Two trajectories of 3 and 2 fixes; masked values fill the second row."""
        fill = -999.0
        lat = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, fill]])
        lon = np.array([[0.0, 0.001, 0.002], [5.0, 5.001, fill]])
        time = np.array([[0.0, 60.0, 120.0], [10.0, 70.0, fill]])
        if over[0] == "obs":
            lat, lon, time = lat.T, lon.T, time.T
        return netcdf(
            {"trajectory": 2, "obs": 3},
            lat=self.lat(over, lat, _FillValue=fill),
            lon=self.lon(over, lon, _FillValue=fill),
            time=self.time(over, time, _FillValue=fill),
            **more,
        )

    IDS = (["trajectory"], np.array(["north", "south"]), {"cf_role": "trajectory_id"})

    def test_a_rectangle_of_several_is_refused_with_an_example(self, netcdf):
        _, problem, fix = refusal(self.rectangle(netcdf))
        assert "holds 2 tracks, told apart by trajectory" in problem
        assert "--track-id trajectory=0 has the most fixes, 3" in fix

    def test_a_row_is_chosen_by_index_and_its_padding_is_no_loss(self, netcdf):
        track = read_track(self.rectangle(netcdf), track_id="trajectory=1")
        assert track.time.tolist() == [0.0, 60.0]
        assert track.origin == (5.0005, 1.0)
        assert track.notes == ()

    @pytest.mark.parametrize("track_id", ["trajectory=south", "trajectory=1", "buoy=south"])
    def test_a_row_is_chosen_by_identifier_index_or_its_variable(self, netcdf, track_id):
        track = read_track(self.rectangle(netcdf, buoy=self.IDS), track_id=track_id)
        assert track.origin == (5.0005, 1.0)

    def test_an_identifier_goes_before_an_index(self, netcdf):
        ids = (["trajectory"], np.array([1, 0]), {"cf_role": "trajectory_id"})
        track = read_track(self.rectangle(netcdf, trajectory=ids), track_id="trajectory=0")
        assert track.origin == (5.0005, 1.0)

    def test_identifiers_may_be_characters(self, netcdf):
        letters = np.array([list("north"), list("so\0\0\0")], dtype="S1")
        path = netcdf(
            {"trajectory": 2, "obs": 2, "letters": 5},
            lat=self.lat(["trajectory", "obs"], [[0, 0], [1, 1]]),
            lon=self.lon(["trajectory", "obs"], [[0, 0], [1, 1]]),
            time=self.time(["obs"], [0, 60]),
            buoy=(["trajectory", "letters"], letters, {"cf_role": "trajectory_id"}),
        )
        assert read_track(path, track_id="buoy=so").origin == (1.0, 1.0)

    def test_an_unknown_trajectory_is_answered_with_the_nearest(self, netcdf):
        path = self.rectangle(netcdf, buoy=self.IDS)
        assert "buoy=south" in refusal(path, track_id="buoy=sooth")[2]
        assert "2 there" in refusal(path, track_id="trajectory=2")[1]

    def test_an_unknown_column_is_answered_with_those_there(self, netcdf):
        path = self.rectangle(netcdf, buoy=self.IDS)
        assert "it has trajectory, buoy" in refusal(path, track_id="mmsi=2")[1]

    def test_a_transposed_rectangle_is_the_same(self, netcdf):
        path = self.rectangle(netcdf, over=("obs", "trajectory"), buoy=self.IDS)
        assert read_track(path, track_id="buoy=south").time.tolist() == [0.0, 60.0]

    @pytest.mark.parametrize("over", [("trajectory", "obs"), ("obs", "trajectory")])
    def test_a_time_shared_by_all_trajectories_is_repeated(self, netcdf, over):
        values = np.array([[0.0, 0.001, 0.002], [5.0, 5.001, 5.002]])
        values = values.T if over[0] == "obs" else values
        path = netcdf(
            {"trajectory": 2, "obs": 3},
            lat=self.lat(over, 0.0 * values),
            lon=self.lon(over, values),
            time=self.time(["obs"], [0, 60, 120]),
        )
        track = read_track(path, track_id="trajectory=1")
        assert track.time.tolist() == [0.0, 60.0, 120.0]
        assert track.origin == (5.001, 0.0)

    def ragged(self, netcdf, **more):
        return netcdf(
            {"trajectory": 2, "obs": 5},
            lat=self.lat(["obs"], [0, 0, 1, 1, 1]),
            lon=self.lon(["obs"], [0.0, 0.001, 5.0, 5.001, 5.002]),
            time=self.time(["obs"], [0, 60, 0, 60, 120]),
            **more,
        )

    SIZES = (["trajectory"], np.array([2, 3]), {"sample_dimension": "obs"})

    def test_contiguous_ragged_trajectories_are_chosen_by_index(self, netcdf):
        track = read_track(self.ragged(netcdf, size=self.SIZES), track_id="trajectory=1")
        assert track.time.tolist() == [0.0, 60.0, 120.0]

    def test_contiguous_ragged_trajectories_are_chosen_by_identifier(self, netcdf):
        path = self.ragged(netcdf, row_size=(*self.SIZES[:2], {}), ID=self.IDS)
        assert read_track(path, track_id="ID=north").time.tolist() == [0.0, 60.0]

    def test_ragged_sizes_that_do_not_add_up_are_refused(self, netcdf):
        sizes = (["trajectory"], np.array([2, 9]), {"sample_dimension": "obs"})
        assert "its sum is 11, but there are 5 fixes" in refusal(self.ragged(netcdf, n=sizes))[1]

    def test_indexed_ragged_trajectories_are_told_apart(self, netcdf):
        index = (["obs"], np.array([0, 0, 1, 1, 1]), {"instance_dimension": "trajectory"})
        path = self.ragged(netcdf, index=index, buoy=self.IDS)
        assert read_track(path, track_id="buoy=north").time.tolist() == [0.0, 60.0]
        assert "--track-id buoy=south" in refusal(path)[2]

    def test_a_ragged_index_beyond_the_trajectories_is_refused(self, netcdf):
        index = (["obs"], np.array([0, 0, 1, 1, 2]), {"instance_dimension": "trajectory"})
        assert "outside the 2 trajectories" in refusal(self.ragged(netcdf, index=index))[1]

    def test_an_identifier_beside_each_fix_tells_trajectories_apart(self, netcdf):
        ids = (["obs"], np.array([7, 7, 8, 8, 8]), {})
        path = self.ragged(netcdf, drifter_id=ids)
        assert read_track(path, track_id="drifter_id=7").time.tolist() == [0.0, 60.0]
        assert "--track-id drifter_id=8" in refusal(path)[2]

    def test_a_single_trajectory_may_carry_its_identifier(self, netcdf):
        ids = ([], np.array(8213480), {"cf_role": "trajectory_id"})
        path = self.single(netcdf, drifter=ids)
        assert len(read_track(path, track_id="drifter=8213480").time) == 3

    def test_what_xarray_writes_is_read(self, tmp_path):
        xarray = pytest.importorskip("xarray")
        pytest.importorskip("netCDF4")
        start = np.datetime64("2020-01-01T00:00:00.218", "ns")
        xarray.Dataset(
            {
                "lat": (("trajectory", "obs"), [[0.0, 0.0], [1.0, np.nan]]),
                "lon": (("trajectory", "obs"), [[0.0, 0.001], [1.0, np.nan]]),
            },
            coords={
                "time": ("obs", start + np.array([0, 60_000_000_000], "m8[ns]")),
                "drifter_id": ("trajectory", ["a", "b"]),
            },
        ).to_netcdf(tmp_path / "xarray.nc")
        track = read_track(tmp_path / "xarray.nc", track_id="drifter_id=a")
        assert track.start == "2020-01-01T00:00:00.218000Z"
        assert track.time.tolist() == [0.0, 60.0]


class TestMissingExtra:
    """An absent optional library is one sentence with its cure."""

    def test_projecting_needs_pyproj(self, tmp_path, monkeypatch):
        path = eastward(tmp_path, [0.0, 0.001])
        monkeypatch.setitem(sys.modules, "pyproj", None)
        with pytest.raises(MissingExtraError, match=r"pip install '\.\[maritime\]'"):
            read_track(path)

    def test_netcdf_needs_netcdf4(self, tmp_path, monkeypatch):
        monkeypatch.setitem(sys.modules, "netCDF4", None)
        with pytest.raises(MissingExtraError, match=r"pip install '\.\[xarray\]'"):
            read_track(write(tmp_path, "track.nc", "anything"))


class TestRealData:
    """Solent AIS, Coast Guard drifters and a vessel with a GPS glitch."""

    def test_a_fast_ferry_crosses_the_solent_and_comes_back(self):
        track = read_track(real(SOLENT), track_id=FERRY)
        assert len(track.time) == 1104
        assert track.notes == ("Fixes dropped for repeating the time of the one before: 1.",)
        harbor, far_side = track.y > 3000.0, track.y < -3000.0
        there = int(np.argmax(far_side))
        assert harbor[:there].any()
        assert harbor[there:].any()

    def test_a_ship_passes_the_whole_solent_without_a_loss(self):
        track = read_track(real(SOLENT), track_id=SHIP)
        assert len(track.time) == 192
        assert np.ptp(track.x) == pytest.approx(18.1e3, rel=0.01)
        assert np.ptp(track.y) == pytest.approx(10.7e3, rel=0.01)
        assert track.notes == ()

    @pytest.mark.parametrize(("vessel", "top_speed"), [(SHIP, 7.0), (FERRY, 24.0)])
    def test_no_step_is_faster_than_the_vessel(self, vessel, top_speed):
        track = read_track(real(SOLENT), track_id=vessel)
        speed = np.hypot(np.diff(track.x), np.diff(track.y)) / np.diff(track.time)
        assert speed.max() < top_speed

    def test_the_solent_file_asks_which_vessel(self):
        _, problem, fix = refusal(real(SOLENT))
        assert "holds 91 tracks, told apart by mmsi" in problem
        assert "--track-id mmsi=" in fix

    def test_a_drifter_drifts_for_weeks_and_falls_silent_at_times(self):
        track = read_track(real(DRIFTERS), track_id=DRIFTER)
        assert len(track.time) == 965
        assert track.time[-1] > 26 * 86400
        assert track.max_gap == 9000.0
        speed = np.hypot(np.diff(track.x), np.diff(track.y)) / np.diff(track.time)
        assert speed.max() < 1.5
        assert "Silences longer than 9000 s" in track.notes[-1]

    def test_a_segment_of_all_drifters_is_not_one_track(self):
        problem = refusal(real(DRIFTERS), track_id="segment=0")[1]
        assert problem.startswith("segment=0 holds 7 tracks, told apart by drifter_id")

    def test_a_gps_glitch_is_dropped_and_the_fix_after_it_kept(self):
        track = read_track(real(MAB_AIS), track_id=GLITCHING_VESSEL)
        assert len(track.time) == 8
        assert np.hypot(track.x, track.y).max() < 50.0
        (note,) = [note for note in track.notes if "speed above" in note]
        assert "them: 2, at 2022-01-03T00:18:40Z, 2022-01-03T00:20:38Z." in note

    def test_a_grid_of_currents_is_not_a_track(self):
        pytest.importorskip("netCDF4")
        assert "is it a grid?" in refusal(real(CURRENTS))[1]
