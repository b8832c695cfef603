"""Specification of reading GeoJSON and OGC Moving Features JSON."""

import json

import pytest

from shoal.tracks.read import read_track
from track_files import DEGREE, refusal, write

STAMPS = [f"2020-01-01T00:0{i}:00Z" for i in range(3)]
LINE = [[0.001 * i, 0.0] for i in range(3)]


def collection(*features):
    return {"type": "FeatureCollection", "features": list(features)}


def feature(geometry, properties=None, **more):
    return {"type": "Feature", "geometry": geometry, "properties": properties or {}, **more}


def line(coordinates, **properties):
    return feature({"type": "LineString", "coordinates": coordinates}, properties)


def moving(coordinates=LINE, datetimes=STAMPS, **properties):
    motion = {"type": "MovingPoint", "coordinates": coordinates, "datetimes": datetimes}
    return {"type": "Feature", "temporalGeometry": motion, "properties": properties}


def point(i, lat=0.0, **properties):
    return feature({"type": "Point", "coordinates": [0.001 * i, lat]}, {"time": STAMPS[i], **properties})


FORMS = {
    "points": collection(*map(point, range(3))),
    "points with t": collection(
        *(feature({"type": "Point", "coordinates": LINE[i]}, {"t": STAMPS[i], "x": 1}) for i in range(3))
    ),
    "coordTimes": collection(line(LINE, coordTimes=STAMPS)),
    "coordinateProperties": line(LINE, coordinateProperties={"times": STAMPS}),
    "fourth coordinate": line([[*LINE[i], 0, 1577836800 + 60 * i] for i in range(3)]),
    "several lines": feature(
        {"type": "MultiLineString", "coordinates": [LINE[:2], LINE[2:]]}, {"times": [STAMPS[:2], STAMPS[2:]]}
    ),
    "moving point": moving(),
    "moving points": collection(moving()),
    "prisms": {
        "type": "Feature",
        "temporalGeometry": {"type": "MovingGeometryCollection", "prisms": [moving()["temporalGeometry"]]},
    },
    "trajectory": collection(line(LINE, datetimes=STAMPS)),
    "milliseconds": moving(datetimes=[1577836800000 + 60000 * i for i in range(3)]),
}


class TestGeojson:
    @pytest.mark.parametrize("form", FORMS)
    def test_it_is_read(self, tmp_path, form):
        track = read_track(write(tmp_path, "track.json", json.dumps(FORMS[form])))
        assert track.start == "2020-01-01T00:00:00Z"
        assert track.time.tolist() == [0.0, 60.0, 120.0]
        assert track.x == pytest.approx([-0.001 * DEGREE, 0.0, 0.001 * DEGREE], rel=1e-3)

    @pytest.mark.parametrize("name", ["track.geojson", "track.json", "track.mfjson"])
    def test_the_suffix_may_be_any_of_three(self, tmp_path, name):
        assert len(read_track(write(tmp_path, name, json.dumps(FORMS["points"]))).time) == 3

    def test_properties_tell_points_apart(self, tmp_path):
        points = [point(i, lat, mmsi=219000001 + n) for n, lat in enumerate((0.0, 1.0)) for i in range(3)]
        path = write(tmp_path, "track.geojson", json.dumps(collection(*points)))
        assert "holds 2 tracks, told apart by mmsi" in refusal(path)[1]
        assert read_track(path, track_id="mmsi=219000002").origin[1] == 1.0

    def test_lines_are_told_apart_by_index_or_property(self, tmp_path):
        path = write(
            tmp_path, "t.json", json.dumps(collection(moving(name="a"), moving([[5, 5], [5, 5.001], [5, 5]], name="b")))
        )
        assert "holds 2 tracks, told apart by track" in refusal(path)[1]
        assert read_track(path, track_id="name=b").origin[0] == 5.0
        assert read_track(path, track_id="track=1").origin[0] == 5.0

    def test_a_line_without_times_is_refused(self, tmp_path):
        _, problem, fix = refusal(write(tmp_path, "t.json", json.dumps(line(LINE))))
        assert problem == "no fix has a time"
        assert "coordTimes" in fix

    def test_times_that_do_not_pair_are_refused_with_their_feature(self, tmp_path):
        where, problem, _ = refusal(write(tmp_path, "t.json", json.dumps(collection(moving(datetimes=STAMPS[:2])))))
        assert where.endswith("t.json feature 0")
        assert problem == "has 2 times for 3 positions"

    @pytest.mark.parametrize("text", ["{}", "[]", "1", '{"type": "FeatureCollection", "features": [null, 3]}', "null"])
    def test_other_json_is_refused(self, tmp_path, text):
        assert "holds no points or lines" in refusal(write(tmp_path, "t.json", text))[1]

    def test_what_is_no_json_is_named_with_its_line(self, tmp_path):
        where, problem, _ = refusal(write(tmp_path, "t.json", "{", '"a": }'))
        assert where.endswith("t.json:2")
        assert problem.startswith("is not JSON")

    def test_json_too_deep_is_refused(self, tmp_path):
        assert "cannot be read" in refusal(write(tmp_path, "t.json", "[" * 100_000))[1]
