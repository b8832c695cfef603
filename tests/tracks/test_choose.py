"""Specification of choosing one track out of many."""

import csv
import itertools
import math

import pytest

from shoal.tracks.read import read_track
from track_files import DRIFTERS, SOLENT, csv_file, real, refusal


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
        path = csv_file(
            tmp_path, "0,0,0,0,A", "30,0,0,0,A", "60,0,0,0,B", "90,0,0,1,A", header="time,lat,lon,leg,drifter_id"
        )
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


def boats(folder, column, first, second, *, interleaved=True):
    """Two boats 1 km apart, 0.93 m/s each, a fix a minute."""
    rows = [
        (60 * i + 30 * boat, f"{60 * i + 30 * boat},{54.0 + 0.0005 * i + 0.009 * boat:.4f},10,{name}")
        for boat, name in enumerate((first, second))
        for i in range(31)
    ]
    lines = [row for _, row in (sorted(rows) if interleaved else rows)]
    return csv_file(folder, *lines, header=f"time,lat,lon,{column}")


class TestSeveralVehicles:
    """They are never joined in silence, whatever the column is called."""

    @pytest.mark.parametrize(
        "column",
        ["Device", "deviceid", "device_id", "imei", "WMO", "platform", "platform_code", "platform_number", "PTT",
         "callsign", "ship", "vessel", "shipname", "ship_name", "trackid", "track", "buoy", "drifter", "deployment",
         "asset", "object_id", "userid", "uuid", "individual-local-identifier", "Vessel Name", "trip_id", "Serial No",
         "Ponton", "x7", "segment", "status"],
    )  # fmt: skip
    @pytest.mark.parametrize("interleaved", [True, False])
    @pytest.mark.parametrize("names", [("A0", "A1"), ("1", "2")])
    def test_they_are_refused_and_the_column_is_named(self, tmp_path, column, interleaved, names):
        path = boats(tmp_path, column, *names, interleaved=interleaved)
        _, problem, fix = refusal(path)
        assert f"holds 2 tracks, told apart by {column}" in problem
        assert f"--track-id {column}={names[0]} has the most fixes, 31" in fix
        assert len(read_track(path, track_id=f"{column}={names[1]}").time) == 31

    def test_one_after_the_other_they_are_refused_too(self, tmp_path):
        rows = [f"{60 * i},{54 + 0.0005 * i + 0.5 * (i > 20)},10,{'A' if i <= 20 else 'B'}" for i in range(41)]
        path = csv_file(tmp_path, *rows, header="time,lat,lon,Ponton")
        assert "holds 2 tracks, told apart by Ponton" in refusal(path)[1]
        assert len(read_track(path, track_id="all", max_speed=2000.0).time) == 41

    @pytest.mark.parametrize("column", ["status", "sog", "quality", "mode", "Ponton"])
    def test_a_column_that_changes_on_the_way_tells_no_vehicles_apart(self, tmp_path, column):
        rows = [f"{60 * i},{54 + 0.0005 * i:.4f},10,{5 if i < 9 else i % 3}" for i in range(41)]
        assert len(read_track(csv_file(tmp_path, *rows, header=f"time,lat,lon,{column}")).time) == 41

    def test_nor_does_a_course_on_a_circle(self, tmp_path):
        turns = [(60 * i, math.cos(i / 5), math.sin(i / 5), round(math.degrees(i / 5)) % 360) for i in range(200)]
        rows = [f"{t},{54 + 0.001 * x:.6f},{10 + 0.001 * y:.6f},{course // 12}" for t, x, y, course in turns]
        assert len(read_track(csv_file(tmp_path, *rows, header="time,lat,lon,sector")).time) == 200

    def test_words_that_repeat_are_noted(self, tmp_path):
        rows = [f"{60 * i},{54 + 0.0005 * i:.4f},10,{'ebb' if i < 20 else 'flood'}" for i in range(41)]
        track = read_track(csv_file(tmp_path, *rows, header="time,lat,lon,tide"))
        (note,) = [each for each in track.notes if "tide" in each]
        assert note == (
            "All fixes were taken as one track, though tide has 2 values: flood (21 fixes), ebb (20 fixes); "
            "if these are vehicles, name one: --track-id tide=VALUE."
        )

    def test_the_mmsi_decides_alone(self, tmp_path):
        names = ["ALPHA,IMO0000000"] * 5 + ["ALFA,IMO9000001"] * 26
        rows = [f"{60 * i},{54 + 0.0005 * i},10,219000001,{each}" for i, each in enumerate(names)]
        assert len(read_track(csv_file(tmp_path, *rows, header="time,lat,lon,mmsi,name,imo")).time) == 31

    @pytest.mark.parametrize("column", ["name", "id", "uuid", "ObjectID"])
    def test_what_names_each_fix_names_no_vehicle(self, tmp_path, column):
        rows = [f"{60 * i},{54 + 0.0005 * i},10,fix {i}" for i in range(31)]
        assert len(read_track(csv_file(tmp_path, *rows, header=f"time,lat,lon,{column}")).time) == 31

    def test_one_fix_of_each_vessel_makes_no_track(self, tmp_path):
        rows = [f"{i},{54 + 0.01 * i},10,{219_000_000 + i}" for i in range(9)]
        _, problem, fix = refusal(csv_file(tmp_path, *rows, header="time,lat,lon,mmsi"))
        assert problem == "the file holds 9 tracks, told apart by mmsi, and no track has two fixes"
        assert "--track-id" not in fix

    def test_of_vessels_all_is_not_offered(self, tmp_path):
        assert "all" not in refusal(boats(tmp_path, "mmsi", "219000001", "219000002"))[2]

    def test_a_star_does_not_join_vehicles(self, tmp_path):
        path = boats(tmp_path, "mmsi", "219000001", "219000002")
        assert "holds 2 tracks, told apart by mmsi" in refusal(path, track_id="mmsi=2190*")[1]

    def test_all_takes_the_file_at_its_word(self, tmp_path):
        assert len(read_track(boats(tmp_path, "Device", "A", "B"), track_id="all").time) == 62


class TestRealVessels:
    """Every vessel of real files is one track without its identifier; two of them are two."""

    @pytest.mark.parametrize(("path", "column"), [(SOLENT, "mmsi"), (DRIFTERS, "drifter_id")])
    def test_no_other_column_splits_them(self, tmp_path, path, column):
        for vessel, rows in self.vessels(path, column):
            track = read_track(self.write(tmp_path, rows, {column: None}))
            assert len(track.time) >= 0.8 * len(rows), vessel

    @pytest.mark.parametrize(("path", "column"), [(SOLENT, "mmsi"), (DRIFTERS, "drifter_id")])
    def test_two_under_another_name_are_told_apart(self, tmp_path, path, column):
        vessels = self.vessels(path, column)
        for (_, some), (_, others) in itertools.pairwise(vessels[:20]):
            path = self.write(tmp_path, some + others, {column: "Ponton"})
            assert "told apart by Ponton" in refusal(path)[1]

    def vessels(self, path, column):
        with real(path).open() as file:
            rows = sorted(csv.DictReader(file), key=lambda row: row[column])
        grouped = [(vessel, list(group)) for vessel, group in itertools.groupby(rows, key=lambda row: row[column])]
        return [(vessel, group) for vessel, group in grouped if len(group) > 60]

    def write(self, folder, rows, names):
        columns = [names.get(each, each) for each in rows[0]]
        lines = [",".join(text for each, text in row.items() if names.get(each, each)) for row in rows]
        return csv_file(folder, *lines, header=",".join(filter(None, columns)))
