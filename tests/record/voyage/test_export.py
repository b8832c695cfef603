"""Exported tracks: read again by Shoal's own reader, and by parsers that know nothing of Shoal."""

import csv
import json
import re
import sys
from datetime import datetime
from functools import reduce
from itertools import pairwise
from operator import xor
from xml.etree import ElementTree

import numpy as np
import pytest

import shoal
from shoal.core.errors import MissingExtraError, RecordError, ScenarioError, UnknownNameError
from shoal.record.voyage.ais import ship_name
from shoal.record.voyage.anchor import anchor_of
from shoal.record.voyage.voyages import Craft, voyages_of
from shoal.tracks.read import read_track
from voyages import AGENTS, ORIGIN, START, UNIX, made_record

pytest.importorskip("pyproj")

SUFFIXES = {"geojson": ".geojson", "kml": ".kml", "gpx": ".gpx", "netcdf": ".nc", "csv": ".csv", "nmea": ".nmea"}
NEEDS = {"netcdf": ("xarray", "netCDF4"), "nmea": ("pyais",)}
AIS_RESOLUTION = 0.19  # [m] 1/10,000 minute of latitude
KML, GX = "{http://www.opengis.net/kml/2.2}", "{http://www.google.com/kml/ext/2.2}"
GPX = "{http://www.topografix.com/GPX/1/1}"
NASTY = "<b>&\"'=1+1</b> \x1b[31m\ud800"  # a record may hold any name
SHOWN = NASTY.replace("\x1b", r"\x1b").replace("\ud800", r"\ud800")


def exported(folder, record, kind, **given):
    for library in NEEDS.get(kind, ()):
        pytest.importorskip(library)
    file = folder / f"tracks{SUFFIXES[kind]}"
    shoal.export(record, file, **{"start": START, **given})
    return file


def truth(record, origin=None):
    return voyages_of(record.trajectories[0], record.facts, anchor_of(record.scenario, start=START, origin=origin), "")


def called(kind, craft):
    """How the reader's user names a craft."""
    mmsi = (979_000_000 if craft.kind == "buoy" else 799_000_000) + craft.number
    by_name = f"name={craft.name}"
    return {
        "kml": by_name,
        "gpx": by_name,
        "nmea": f"mmsi={mmsi}",
        "netcdf": f"trajectory_id={craft.id}",
        "csv": f"id={craft.id}",
        "geojson": f"id={craft.id}",
    }[kind]


class TestRoundTrip:
    """What Shoal writes as a track, it reads as the track of a target: same places, same times."""

    @pytest.mark.parametrize("kind", SUFFIXES)
    @pytest.mark.parametrize("steps", [range(0, 40, 10), range(3, 9)])
    def test_of_everybody(self, tmp_path, kind, steps):
        record = made_record(steps=steps)
        frames, found = record.trajectories[0], truth(record)
        x, y = np.hstack([frames.x, frames.target_x]), np.hstack([frames.y, frames.target_y])
        file = exported(tmp_path, record, kind)
        for m, craft in enumerate(found.crafts):
            track = read_track(file, track_id=called(kind, craft), origin=ORIGIN, max_speed=300.0)
            off = np.hypot(track.x - x[:, m], track.y - y[:, m])
            assert off.max() < (AIS_RESOLUTION if kind == "nmea" else 0.002)
            begin = round(datetime.fromisoformat(track.start).timestamp() * 1e6)
            assert (begin + np.round(track.time * 1e6)).tolist() == found.times.tolist()

    @pytest.mark.parametrize("kind", SUFFIXES)
    def test_of_who_was_away_in_between_has_a_gap(self, tmp_path, kind):
        record = made_record(steps=range(0, 60, 10))
        record.trajectories[0].alive[[0, 3], 1] = False
        record.trajectories[0].alive[:, 2] = False  # never there
        file = exported(tmp_path, record, kind)
        track = read_track(file, track_id=called(kind, truth(record).crafts[1]), origin=ORIGIN)
        assert track.time.tolist() == [0.0, 1.0, 3.0, 4.0]
        assert datetime.fromisoformat(track.start).timestamp() == UNIX + 1
        with pytest.raises(shoal.ShoalError):
            read_track(file, track_id=called(kind, truth(record).crafts[2]), origin=ORIGIN)

    @pytest.mark.parametrize("kind", SUFFIXES)
    def test_across_the_antimeridian(self, tmp_path, kind):
        origin = (180.0, -16.0)
        record = made_record(steps=range(0, 100, 10), origin=origin, reach=1.0)
        record.trajectories[0].x[:, 0] = np.linspace(-20.0, 20.0, 10)  # never on it at a frame
        record.trajectories[0].y[:, 0] = 5.0
        file = exported(tmp_path, record, kind)
        track = read_track(file, track_id=called(kind, truth(record).crafts[0]), origin=origin)
        at = np.interp(track.time, np.arange(10.0), record.trajectories[0].x[:, 0])
        assert track.time.size >= 10
        assert np.hypot(track.x - at, track.y - 5.0).max() < AIS_RESOLUTION

    def test_the_door_is_the_same_in_python_and_on_the_command_line(self, tmp_path):
        record = made_record()
        made = shoal.export(record, tmp_path / "a.csv", start=START)
        assert made == (6, 3, START, "2015-11-16T06:00:02Z")
        shoal.export(record, tmp_path / "b.txt", to="csv", start=START)
        assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.txt").read_bytes()


class TestGeoJson:
    """RFC 7946, as a parser of JSON sees it."""

    def features(self, folder, record, **given):
        content = json.loads(exported(folder, record, "geojson", **given).read_text())
        assert content["type"] == "FeatureCollection"
        return {each["id"]: each for each in content["features"]}

    def test_a_feature_per_craft_with_a_time_per_position(self, tmp_path):
        record = made_record()
        record.trajectories[0].on_target[1, 0] = True
        found = self.features(tmp_path, record)
        assert list(found) == [f"agent-{i}" for i in range(AGENTS)] + ["target-0"]
        buoy, target = found["agent-0"], found["target-0"]
        assert buoy["geometry"]["type"] == "LineString"
        assert len(buoy["geometry"]["coordinates"]) == len(buoy["properties"]["coordTimes"]) == 3
        assert buoy["properties"]["onTarget"] == [False, True, False]
        assert buoy["properties"]["fleet"] == "fast"
        assert target["properties"]["kind"] == "target"
        assert target["properties"]["fleet"] is None
        assert "onTarget" not in target["properties"]

    def test_no_line_crosses_the_antimeridian_and_pieces_meet_on_it(self, tmp_path):
        record = made_record(steps=[0, 10, 20], origin=(180.0, 0.0))
        record.trajectories[0].x[:, 0] = -30.0, 10.0, 20.0
        record.trajectories[0].y[:, 0] = 0.0, 40.0, 40.0
        feature = self.features(tmp_path, record)["agent-0"]
        one, other = feature["geometry"]["coordinates"]
        assert feature["geometry"]["type"] == "MultiLineString"
        assert (one[-1][0], other[0][0]) == (180.0, -180.0)
        assert one[-1][1] == other[0][1] == pytest.approx((one[0][1] * 1 + other[1][1] * 3) / 4, abs=2e-8)
        times = feature["properties"]["coordTimes"]
        assert times == [[START, "2015-11-16T06:00:00.750000Z"], ["2015-11-16T06:00:00.750000Z", *rest(2)]]
        assert all(abs(a[0] - b[0]) < 1.0 for line in (one, other) for a, b in pairwise(line))

    def test_a_fix_by_itself_is_a_line_all_the_same(self, tmp_path):
        record = made_record()
        record.trajectories[0].alive[1:, 0] = False
        feature = self.features(tmp_path, record)["agent-0"]
        first, second = feature["geometry"]["coordinates"]
        assert first == second
        assert feature["properties"]["coordTimes"] == [START, START]


def rest(count):
    return [f"2015-11-16T06:00:0{second}Z" for second in range(1, count + 1)]


class TestXml:
    def test_gpx_has_a_segment_per_piece_and_valid_places(self, tmp_path):
        record = made_record(steps=range(0, 50, 10))
        record.trajectories[0].alive[2, 0] = False
        root = ElementTree.parse(exported(tmp_path, record, "gpx")).getroot()
        assert root.tag == f"{GPX}gpx"
        first = root.findall(f"{GPX}trk")[0]
        assert [each.tag for each in first][-2:] == [f"{GPX}trkseg"] * 2  # behind what says whose it is
        points = first.findall(f"{GPX}trkseg/{GPX}trkpt")
        assert [each.findtext(f"{GPX}time") for each in points] == [START, rest(4)[0], *rest(4)[2:]]
        assert all(-180.0 <= float(each.get("lon")) < 180.0 for each in points)

    def test_kml_plays_in_time_in_the_colors_of_the_fleets(self, tmp_path):
        record = made_record(steps=range(0, 50, 10))
        record.trajectories[0].alive[2, 0] = False
        root = ElementTree.parse(exported(tmp_path, record, "kml")).getroot()
        folders = root.findall(f"{KML}Document/{KML}Folder")
        assert [each.findtext(f"{KML}name") for each in folders] == ["fast", "slow", "targets"]
        styles = {f"#{each.get('id')}" for each in root.iter(f"{KML}Style")}
        marks = list(root.iter(f"{KML}Placemark"))
        assert {each.findtext(f"{KML}styleUrl") for each in marks} == styles
        assert len(styles) == len({each.findtext(f".//{KML}color") for each in root.iter(f"{KML}Style")}) == 3
        away = marks[0].findall(f"{GX}MultiTrack/{GX}Track")
        assert [len(each.findall(f"{KML}when")) for each in away] == [2, 2]
        assert [len(each.findall(f"{GX}coord")) for each in away] == [2, 2]
        assert marks[1].find(f"{GX}Track") is not None


class TestCsv:
    def test_a_row_per_time_and_craft_that_was_there(self, tmp_path):
        record = made_record()
        frames = record.trajectories[0]
        frames.x[2, 0], frames.y[2, 0] = frames.x[1, 0] + 1852.0 / 3600.0, frames.y[1, 0]  # in a second
        frames.vx[2, 0], frames.vy[2, 0] = 0.0, 1.0
        frames.alive[1, 1] = False
        record.trajectories[0].on_target[2, 0] = True
        with exported(tmp_path, record, "csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        assert len(rows) == 3 * 6 - 1
        last = rows[2]
        assert (last["id"], last["time"], last["sog_kn"]) == ("agent-0", rest(2)[1], "1.000")
        assert float(last["cog_deg"]) == pytest.approx(90.0, abs=0.1)
        assert float(last["heading_deg"]) % 360.0 == pytest.approx(0.0, abs=0.1)
        assert last["on_target"] == "1"
        assert [rows[-3][name] for name in ("id", "sog_kn", "cog_deg", "on_target")] == ["target-0", "", "", ""]


class TestNetCdf:
    """CF-1.11 trajectories."""

    def test_says_what_every_number_is(self, tmp_path):
        netcdf4 = pytest.importorskip("netCDF4")
        with netcdf4.Dataset(exported(tmp_path, made_record(), "netcdf")) as dataset:
            assert dataset.featureType == "trajectory"
            assert dataset.Conventions == "CF-1.11"
            assert {name: len(each) for name, each in dataset.dimensions.items()} == {"trajectory": 6, "obs": 3}
            (identifier,) = dataset.get_variables_by_attributes(cf_role="trajectory_id")
            assert identifier[-1] == "target-0"
            units = {"time": "seconds since 1970-01-01", "lat": "degrees_north", "lon": "degrees_east"}
            names = {"time": "time", "lat": "latitude", "lon": "longitude"}
            for name, unit in units.items():
                assert dataset[name].units.startswith(unit)
                assert dataset[name].standard_name == names[name]
                assert dataset[name].dimensions == ("trajectory", "obs")
            assert dataset["speed"].coordinates.split().count("lat") == 1

    def test_opens_with_real_times_and_gaps(self, tmp_path):
        xarray = pytest.importorskip("xarray")
        record = made_record()
        record.trajectories[0].alive[1, 0] = False
        record.trajectories[0].on_target[2, 0] = True
        with xarray.open_dataset(exported(tmp_path, record, "netcdf")) as dataset:
            assert dataset.time.values[0].astype("datetime64[s]").astype(int).tolist() == [UNIX, UNIX + 1, UNIX + 2]
            assert np.isnan(dataset.lat.values[0]).tolist() == [False, True, False]
            assert dataset.on_target.values[0].tolist() == [0, -1, 1]
            assert dataset.on_target.values[-1].tolist() == [-1] * 3  # a target reports nothing
            np.testing.assert_array_equal(dataset.lon.values, truth(record).lon.T)


class TestNmea:
    """AIS, as pyais decodes it."""

    def messages(self, folder, record, **given):
        pyais = pytest.importorskip("pyais")
        lines = exported(folder, record, "nmea", **given).read_text().splitlines()
        for line in lines:
            tag, total, sentence, told = re.fullmatch(r"\\(c:\d+)\*(..)\\!(AIVDM,[^*]*)\*(..)", line).groups()
            assert (reduce(xor, tag.encode()), reduce(xor, sentence.encode())) == (int(total, 16), int(told, 16))
        whole = re.sub(r"(?m)^\\.*?\\", "", "\n".join(lines)).encode().splitlines()
        parts = []
        for line in whole:
            parts.append(line)
            if line.split(b",")[1] == line.split(b",")[2]:
                yield pyais.decode(*parts)
                parts = []

    def test_everybody_has_a_number_and_a_name(self, tmp_path):
        messages = self.messages(tmp_path, made_record())
        named = {each.mmsi: each.shipname for each in messages if each.msg_type in (24, 5)}
        fast = {979_000_000: "FAST 0", 979_000_001: "FAST 1"}
        slow = {979_000_002: "SLOW 2", 979_000_003: "SLOW 3", 979_000_004: "SLOW 4"}
        assert named == fast | slow | {799_000_000: "TARGET 0"}

    def test_motion_is_in_knots_and_degrees_or_said_to_be_unknown(self, tmp_path):
        record = made_record(steps=[0, 10])
        frames = record.trajectories[0]
        frames.x[1, :2], frames.y[1, :2] = frames.x[0, :2] + (0.0, 100.0), frames.y[0, :2]
        frames.vx[1, :2], frames.vy[1, :2] = (0.0, 0.0), (0.0, -1.0)
        reports = [each for each in self.messages(tmp_path, record) if each.msg_type in (1, 18)]
        assert [each.second for each in reports] == [0] * 6 + [1] * 6
        assert {(each.speed, each.course) for each in reports[:6]} == {(102.3, 360.0)}
        still, fast, target = reports[6], reports[7], reports[11]
        assert (still.speed, still.course, still.heading) == (0.0, 360.0, 511)
        assert (fast.speed, fast.heading) == (102.2, 180)
        assert fast.course == pytest.approx(90.0, abs=0.11)
        assert (target.msg_type, target.heading, target.turn, target.status) == (1, 511, -128.0, 15)
        found = truth(record)
        for m, each in list(enumerate(reports[6:]))[2:]:
            assert each.speed == pytest.approx(found.speed[1, m] * 3600 / 1852, abs=0.0501)
            assert each.course == pytest.approx(found.course[1, m], abs=0.0501)

    @pytest.mark.parametrize(
        ("fleet", "number", "name"),
        [
            ("Éclair @ sea", 3, "ECLAIR ? SEA 3"),
            ("a name that is much too long", 9999, "A NAME THAT IS 9999"),
            ("浮標", 7, "7"),
            ("under_score", 1, "UNDER?SCORE 1"),
        ],
    )
    def test_names_are_cut_to_what_ais_can_say_but_for_the_number(self, fleet, number, name):
        assert ship_name(Craft("", number, "buoy", fleet, "")) == name


class TestNames:
    """Names are text: no markup, no formulas, nothing that breaks a file."""

    @pytest.mark.parametrize("kind", SUFFIXES)
    def test_of_any_kind_come_back(self, tmp_path, kind):
        record = made_record(names=(NASTY, "=HYPERLINK(0)"))
        file = exported(tmp_path, record, kind)
        if kind == "nmea":
            assert file.read_text().isascii()
            return
        if kind == "netcdf":
            import netCDF4

            with netCDF4.Dataset(file) as dataset:
                assert dataset["fleet"][0] == SHOWN
            return
        if kind == "geojson":
            found = [each["properties"]["name"] for each in json.loads(file.read_text())["features"]]
        elif kind == "csv":
            with file.open(newline="") as stream:
                found = list(dict.fromkeys(row["name"] for row in csv.DictReader(stream)))
            assert found[2:] == ["'=HYPERLINK(0) 2", "'=HYPERLINK(0) 3", "'=HYPERLINK(0) 4", "target 0"]
        else:
            tag = f"{KML}Placemark/{KML}name" if kind == "kml" else f"{GPX}trk/{GPX}name"
            found = [each.text for each in ElementTree.parse(file).getroot().findall(f".//{tag}")]
        assert found[:2] == [f"{SHOWN} 0", f"{SHOWN} 1"]


class TestRefusals:
    """One error, and no file."""

    @pytest.mark.parametrize(
        ("name", "given", "error", "words"),
        [
            ("a.csv", {"run": 1}, RecordError, "keeps no frames"),
            ("a.csv", {"start": None}, ScenarioError, "says not when"),
            ("a.xls", {}, ScenarioError, "does not say by its suffix what it is"),
            ("a.csv", {"to": "shape"}, UnknownNameError, "there is none of this name"),
            ("nowhere/a.csv", {}, RecordError, "cannot be written"),
        ],
    )
    def test_of_what_cannot_be_exported(self, tmp_path, name, given, error, words):
        with pytest.raises(error, match=words):
            shoal.export(made_record(), tmp_path / name, **{"start": START, **given})
        assert not list(tmp_path.iterdir())

    def test_of_a_file_that_is_there(self, tmp_path):
        (tmp_path / "a.csv").write_text("mine")
        with pytest.raises(RecordError, match="exists already"):
            shoal.export(made_record(), tmp_path / "a.csv", start=START)
        assert (tmp_path / "a.csv").read_text() == "mine"

    @pytest.mark.parametrize(
        ("kind", "modules", "extra"),
        [
            ("csv", ["pyproj"], "maritime"),
            ("nmea", ["pyais", "pyais.encode"], "maritime"),
            ("netcdf", ["xarray"], "xarray"),
            ("netcdf", ["netCDF4"], "xarray"),
        ],
    )
    def test_of_what_needs_a_library_that_is_absent(self, tmp_path, monkeypatch, kind, modules, extra):
        for name in modules:
            monkeypatch.setitem(sys.modules, name, None)
        with pytest.raises(MissingExtraError, match=rf"^{modules[0]}: .*\n  fix: pip install '\.\[{extra}\]'"):
            shoal.export(made_record(), tmp_path / f"a{SUFFIXES[kind]}", start=START)
        assert not list(tmp_path.iterdir())

    def test_of_a_run_in_which_nobody_is_there(self, tmp_path):
        record = made_record()
        record.trajectories[0].alive[:] = False
        record.trajectories[0].target_present[:] = False
        with pytest.raises(RecordError, match="anybody"):
            shoal.export(record, tmp_path / "a.csv", start=START)
