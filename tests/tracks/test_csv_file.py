"""Specification of reading CSV: its columns, its lines, its dialects."""

import tracemalloc
from datetime import datetime, timedelta

import numpy as np
import pytest

from shoal.tracks import csv_file as csv_file_module
from shoal.tracks.read import read_track
from track_files import DEGREE, csv_file, eastward, refusal


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


class TestBadLine:
    """The error names the file and the line, what is wrong and what to do."""

    @pytest.mark.parametrize(
        ("header", "missing"),
        [("when,lat,lon", "time or timestamp"), ("time,y,lon", "lat or latitude"),
         ("time,lat,x", "lon or longitude"), ("time;lat;x", "lon or longitude")],
    )  # fmt: skip
    def test_a_missing_column_is_named_with_those_there(self, tmp_path, header, missing):
        where, problem, fix = refusal(csv_file(tmp_path, "0,0,0", header=header))
        assert where.endswith("track.csv:1")
        assert missing in problem
        assert all(name in problem for name in header.replace(";", ",").split(","))
        assert "time,lat,lon" in fix

    @pytest.mark.parametrize(
        ("line", "problem"),
        [
            ("60,50N,0", "lat '50N' is not a number"),
            ("60,0,inf", "lon 'inf' is not a number"),
            ("60,90.1,0", "lat 90.1 is outside [-90, 90]"),
            ("60,0,-180.5", "lon -180.5 is outside [-180, 360]"),
            ("60,0,361", "lon 361 is outside [-180, 360]"),
            ("noon,0,0", "time 'noon' cannot be read"),
            ("2020-13-01T00:00:00Z,0,0", "time '2020-13-01T00:00:00Z' cannot be read"),
            ("1e300,0,0", "time 1e300 is not a Unix time"),
            ("60,1_0,0", "lat '1_0' is not a number"),
            ("60,٣,0", "lat '٣' is not a number"),
            ("1_600_000_000,0,0", "time '1_600_000_000' cannot be read"),
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

    @pytest.mark.parametrize("lines", [["0,0,0"], ["0,0,0", "0,0,0"]])
    def test_one_time_alone_makes_no_track(self, tmp_path, lines):
        assert "1 usable fix" in refusal(csv_file(tmp_path, *lines))[1]


class TestUnavailable:
    """No position, or no time: dropped and counted."""

    @pytest.mark.parametrize(
        "line",
        ["60,91,181", "60,91,0", "60,0,181", "60,,0", "60,0, ", "60,0", "60,NaN,nan", "60,null,null", ",0,0", "nan,0,0",
         "60,-9999,-9999", "60,9.96921e36,0"],
    )  # fmt: skip
    def test_the_line_costs_one_fix(self, tmp_path, line):
        track = read_track(csv_file(tmp_path, "0,0,0", line, "120,0,0.001"))
        assert track.time.tolist() == [0.0, 120.0]
        assert "Fixes dropped because the file marks them missing: 1." in track.notes

    def test_181_is_a_place_among_others_beyond_180(self, tmp_path):
        assert len(read_track(csv_file(tmp_path, "0,0,180.999", "60,0,181", "120,0,181.001")).time) == 3

    def test_a_file_of_nothing_else_is_refused(self, tmp_path):
        assert refusal(csv_file(tmp_path, "0,91,181", "60,91,181"))[1] == "every fix lacks its time or position"


PLACES = [(54.0 + 0.0009 * i, 10.0 + 0.0012 * i) for i in range(31)]  # a minute apart: 2.12 m/s
MOMENTS = [datetime(2024, 3, 10, 12) + timedelta(minutes=i) for i in range(31)]
MMSI = 219000001
SPACED = "%Y-%m-%d %H:%M:%S"


def table(row, header, *, encoding="utf-8", stamp="%Y-%m-%dT%H:%M:%S"):
    """Bytes of a file in one dialect; row has the fields t, a and o."""
    rows = [
        row.format(t=t.strftime(stamp), a=f"{a:.6f}", o=f"{o:.6f}") for t, (a, o) in zip(MOMENTS, PLACES, strict=True)
    ]
    return "\n".join([*header.split("\n"), *rows, ""]).encode(encoding)


def comma(text):
    return text.replace(b".", b",")


DIALECTS = {
    "MarineCadastre": table(
        f"{MMSI},{{t}},{{a}},{{o}},4.1,38,70,A", "MMSI,BaseDateTime,LAT,LON,SOG,COG,VesselType,Class"
    ),
    "MarineCadastre 2025": table(
        f"{MMSI},{{t}},{{o}},{{a}},4.1", "mmsi,base_date_time,longitude,latitude,sog", stamp=SPACED
    ),
    "Danish": table(
        f"{{t}},Class A,{MMSI},{{a}},{{o}},Under way",
        "# Timestamp,Type of mobile,MMSI,Latitude,Longitude,Status",
        stamp="%d/%m/%Y %H:%M:%S",
    ),
    "Norwegian": table(f"{MMSI};{{t}};{{o}};{{a}};38.0;4.1", "mmsi;date_time_utc;lon;lat;cog;sog"),
    "BarentsWatch": table(f"{MMSI},{{t}}+00:00,{{a}},{{o}}", "mmsi,msgtime,latitude,longitude"),
    "ERDDAP": table("{t}Z,{a},{o}", "time,latitude,longitude\nUTC,degrees_north,degrees_east"),
    "aisstream": table(
        f"{MMSI},{{t}}.000000000 +0000 UTC,{{a}},{{o}}", "MMSI,time_utc,latitude,longitude", stamp=SPACED
    ),
    "Movebank": table(
        "{t}.000,{o},{a},gull 7",
        "timestamp,location-long,location-lat,individual-local-identifier",
        stamp=SPACED,
    ),
    "semicolon": table("{t};{a};{o}", "time;lat;lon"),
    "tab": table("{t}\t{a}\t{o}", "time\tlat\tlon"),
    "bar": table("{t}|{a}|{o}", "time|lat|lon"),
    "spaces": table("{t}  {a} {o}", "time   lat lon"),
    "decimal comma": comma(table("{t};{a};{o}", "time;lat;lon")),
    "quoted": table('"{t}","{a}","{o}"', '"time","lat","lon"'),
    "spaces around": table(" {t} , {a} , {o} ", "time, lat, lon"),
    "UTF-8 with mark": table("{t},{a},{o}", "time,lat,lon", encoding="utf-8-sig"),
    "UTF-16": table("{t},{a},{o}", "time,lat,lon", encoding="utf-16"),
    "UTF-16 without mark": table("{t},{a},{o}", "time,lat,lon", encoding="utf-16-le"),
    "UTF-32": table("{t},{a},{o}", "time,lat,lon", encoding="utf-32"),
    "Latin-1": table("{t},{a},{o},SKJÆRGÅRD", "time,lat,lon,remark", encoding="latin-1"),
    "lines end in CR": table("{t},{a},{o}", "time,lat,lon").replace(b"\n", b"\r"),
    "lines end in CRLF": table("{t},{a},{o}", "time,lat,lon").replace(b"\n", b"\r\n"),
    "units in the header": table("{t},{a},{o}", "time (UTC),latitude (deg),longitude [deg]"),
    "comments": table("{t},{a},{o}", "# buoy 7, exported today\n# datum: WGS84\ntime,lat,lon"),
    "comments between": table("{t},{a},{o}\n# checked", "time,lat,lon"),
    "separator named": table("{t};{a};{o}", "sep=;\ntime;lat;lon"),
    "title first": table("{t},{a},{o}", "Cruise 12\n\ntime,lat,lon"),
    "UTC behind": table("{t} UTC,{a},{o}", "time,lat,lon", stamp=SPACED),
    "two columns": table("{t},{a},{o}", "date,time,lat,lon", stamp="%Y-%m-%d,%H:%M:%S"),
    "two columns, clock first": table("{t},{a},{o}", "time,date,lat,lon", stamp="%H:%M:%S,%d.%m.%Y"),
    "date beside a whole stamp": table("2024-03-10,{t},{a},{o}", "date,time,lat,lon"),
    "six columns": table("{t},{a},{o}", "year,month,day,hour,minute,second,lat,lon", stamp="%Y,%m,%d,%H,%M,%S"),
}


class TestDialects:
    """One track of 31 fixes, as the trade writes it: the numbers are the same each time."""

    @pytest.mark.parametrize("dialect", DIALECTS)
    def test_it_is_read(self, tmp_path, dialect):
        path = tmp_path / "track.csv"
        path.write_bytes(DIALECTS[dialect])
        track = read_track(path)
        assert track.start == "2024-03-10T12:00:00Z"
        assert track.time.tolist() == [60.0 * i for i in range(31)]
        assert np.hypot(np.diff(track.x), np.diff(track.y)).sum() == pytest.approx(3821.1, abs=0.1)

    def test_a_row_of_units_is_skipped_and_noted(self, tmp_path):
        (tmp_path / "track.csv").write_bytes(DIALECTS["ERDDAP"])
        assert read_track(tmp_path / "track.csv").notes == ("Line 2 was skipped: it holds units.",)

    def test_another_encoding_is_noted(self, tmp_path):
        (tmp_path / "track.csv").write_bytes(DIALECTS["Latin-1"])
        assert (
            "The text is not UTF-8; it was taken as Windows-1252 (Latin-1)." in read_track(tmp_path / "track.csv").notes
        )

    def test_a_header_inside_the_file_is_skipped_and_noted(self, tmp_path):
        path = csv_file(tmp_path, "0,1,2", "60,1,2", "time,lat,lon", "120,1,2")
        assert "Lines skipped because they repeat the header: 1." in read_track(path).notes

    def test_lines_count_from_the_top_also_behind_quotes_over_two_lines(self, tmp_path):
        path = csv_file(tmp_path, '0,1,2,"two\nlines"', "60,x,2,", header="time,lat,lon,remark")
        assert refusal(path)[0].endswith(":4")

    @pytest.mark.parametrize("name", ["track.tsv", "track.txt", "track.dat"])
    def test_a_table_may_have_another_suffix(self, tmp_path, name):
        (tmp_path / name).write_bytes(DIALECTS["tab"])
        assert len(read_track(tmp_path / name).time) == 31


class TestLargeFile:
    """A day of a coast is read once, in little memory."""

    HEADER = "MMSI,BaseDateTime,LAT,LON,SOG,VesselName"

    def day(self, folder, ships=400, hours=24):
        """Every ship once an hour."""
        rows = (
            f"{367_000_000 + ship},2024-03-10T{hour:02}:00:00,{30 + ship / 100 + hour / 20:.4f},-75,3.0,SHIP {ship}"
            for hour in range(hours)
            for ship in range(ships)
        )
        return csv_file(
            folder, *rows, f"{367_000_007},2024-03-10T23:30:00,31.2450,-75.0,3.0,SHIP 7", header=self.HEADER
        )

    def test_without_a_choice_the_tracks_are_counted(self, tmp_path):
        _, problem, fix = refusal(self.day(tmp_path))
        assert "holds 400 tracks, told apart by MMSI" in problem
        assert "--track-id MMSI=367000007 has the most fixes, 25" in fix

    @pytest.mark.parametrize("track_id", ["MMSI=367000007", "VesselName=SHIP 7"])
    def test_one_is_chosen(self, tmp_path, track_id):
        assert len(read_track(self.day(tmp_path), track_id=track_id).time) == 25

    @pytest.mark.parametrize("enough", [500, 4321, 10**9])
    def test_a_column_whose_name_says_nothing_is_found_early_and_counted_to_the_end(
        self, tmp_path, monkeypatch, enough
    ):
        """However many rows were read before it was found, and wherever the blocks of the file end."""
        monkeypatch.setattr(csv_file_module, "ENOUGH", enough)
        monkeypatch.setattr(csv_file_module, "ROWS", 97)
        monkeypatch.setattr(csv_file_module, "BLOCK", 50_000)
        path = self.day(tmp_path)
        path.write_text(path.read_text().replace("MMSI", "Unit").replace("VesselName", "Word"))
        _, problem, fix = refusal(path)
        assert "holds 400 tracks, told apart by Unit" in problem
        assert "--track-id Unit=367000007 has the most fixes, 25" in fix

    def test_memory_does_not_grow_with_other_vessels(self, tmp_path):
        path = self.day(tmp_path, ships=4000, hours=12)
        tracemalloc.start()
        refusal(path)
        refusal(path, track_id="MMSI=1")
        read_track(path, track_id="MMSI=367000007")
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < 3 * path.stat().st_size


class TestHemispheres:
    """Degrees without a sign, and a column of letters that says on which side."""

    @pytest.mark.parametrize(
        ("header", "sides", "origin"),
        [
            ("time,lat,NS,lon,EW", ("N", "W"), (-5.0, 60.0)),
            ("time,Latitude,N/S,Longitude,E/W", ("S", "E"), (5.0, -60.0)),
            ("time,lat,lat_dir,lon,lon_dir", ("S", "West"), (-5.0, -60.0)),
            ("time,lat,latitude_ref,lon,longitude_ref", ("N", "E"), (5.0, 60.0)),
            ("time,lat,course,lon,wind", ("S", "W"), (5.0, 60.0)),
        ],
    )
    def test_turn_the_sign(self, tmp_path, header, sides, origin):
        file = tmp_path / "sides.csv"
        rows = [f"2024-03-10T12:{m:02}:00Z,{60 + 1e-4 * m},{sides[0]},{5 + 1e-4 * m},{sides[1]}" for m in range(20)]
        file.write_text("\n".join([header, *rows]))
        assert read_track(file).origin == pytest.approx(origin, abs=0.002)
