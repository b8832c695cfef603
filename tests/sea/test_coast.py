"""Specification of coasts and search areas: GeoJSON polygons in, local meters out."""

import json
import random

import numpy as np
import pytest

from damage import hurt_bytes, hurt_json
from sea_files import ORIGIN, geojson, polygon, square
from shoal.core.errors import SeaError
from shoal.core.geodesy import Frame
from shoal.sea.clip import clipped
from shoal.sea.coast import read_coast
from shoal.sea.raster import search_area

pytest.importorskip("pyproj")


def coast(path, origin=ORIGIN, half=5000.0):
    return read_coast(path, Frame(origin), half, half)


def refusal(path):
    with pytest.raises(SeaError) as caught:
        coast(path)
    return caught.value.args


class TestPolygons:
    """What of a file is land near the arena."""

    def test_a_polygon_with_a_hole(self, tmp_path):
        path = geojson(tmp_path / "a.geojson", polygon(square(*ORIGIN, 0.02), square(*ORIGIN, 0.01)))
        (land,) = coast(path).polygons
        assert np.abs(land.shell).max() == pytest.approx(0.02 * 111_412, rel=1e-3)
        assert len(land.holes) == 1
        assert (land.shell[0] == land.shell[-1]).all()

    @pytest.mark.parametrize(
        "wrap",
        [
            lambda each: each,
            lambda each: {"type": "Feature", "geometry": each},
            lambda each: {"type": "GeometryCollection", "geometries": [each, each]},
            lambda each: {"type": "MultiPolygon", "coordinates": [each["coordinates"]]},
            lambda each: {"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": None}, each]},
        ],
    )
    def test_every_way_to_wrap_one(self, tmp_path, wrap):
        path = tmp_path / "a.geojson"
        path.write_text(json.dumps(wrap(polygon(square(*ORIGIN, 0.02)))), encoding="utf-8")
        assert coast(path).polygons

    def test_land_far_away_is_left_out_and_noted(self, tmp_path):
        found = coast(geojson(tmp_path / "a.geojson", polygon(square(20.0, 50.0, 1.0))))
        assert found.polygons == []
        assert found.notes == ["a.geojson has no land near the arena."]

    def test_a_cut_inside_the_arena_is_noted(self, tmp_path):
        path = geojson(tmp_path / "a.geojson", polygon(square(*ORIGIN, 0.02)))
        assert coast(path).notes == ["a.geojson is cut inside the arena: beyond the cut, all is taken as sea."]
        assert coast(path, half=500.0).notes == []

    def test_an_island_in_the_open_sea_is_no_cut(self, tmp_path):
        lon, lat = ORIGIN
        ring = [[lon + 0.01, lat], [lon, lat + 0.01], [lon - 0.01, lat], [lon, lat - 0.01], [lon + 0.01, lat]]
        assert coast(geojson(tmp_path / "a.geojson", polygon(ring))).notes == []

    @pytest.mark.parametrize("origin", [180.0, -179.99, 179.99, 540.0 - 360.0])
    @pytest.mark.parametrize("lons", [(179.9, 180.1), (179.9, -179.9), (-180.1, -179.9)])
    def test_land_across_the_antimeridian(self, tmp_path, origin, lons):
        west, east = lons
        ring = [[west, -0.1], [east, -0.1], [east, 0.1], [west, 0.1], [west, -0.1]]
        found = coast(geojson(tmp_path / "a.geojson", polygon(ring)), origin=(origin, 0.0))
        (land,) = found.polygons
        degree = 111_319.49  # [m] on the equator
        assert np.ptp(land.shell[:, 0]) == pytest.approx(2 * 5000.0 + 2 * 0.02 * degree, rel=1e-3)  # the clip's margin

    def test_an_edge_along_a_parallel_stays_on_it(self, tmp_path):
        frame = Frame(ORIGIN)
        path = geojson(tmp_path / "a.geojson", polygon([[4, 60], [6, 60], [6, 61], [4, 61], [4, 60]]))
        (land,) = read_coast(path, frame, 20e3, 20e3).polygons
        middles = (land.shell[1:] + land.shell[:-1]) / 2
        _, lat = frame.geographic(middles[:, 0], middles[:, 1])
        south = lat < 60.001
        assert south.sum() > 30
        assert np.abs(lat[south] - 60.0).max() * 111_000 < 0.3

    def test_the_digest_is_of_the_land_near_the_arena(self, tmp_path):
        one = geojson(tmp_path / "a.geojson", polygon(square(*ORIGIN, 0.02)))
        two = geojson(tmp_path / "b.geojson", polygon(square(*ORIGIN, 0.02)), polygon(square(20.0, 50.0, 1.0)))
        assert coast(one).digest == coast(two).digest
        assert coast(one).digest != coast(geojson(tmp_path / "c.geojson", polygon(square(*ORIGIN, 0.021)))).digest

    @pytest.mark.parametrize("name", ["urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326", "urn:ogc:def:crs:EPSG::4326"])
    def test_names_of_degrees(self, tmp_path, name):
        crs = {"type": "name", "properties": {"name": name}}
        assert coast(geojson(tmp_path / "a.geojson", polygon(square(*ORIGIN, 0.02)), crs=crs)).polygons

    def test_points_beside_polygons_are_noted(self, tmp_path):
        point = {"type": "Point", "coordinates": [5, 60]}
        found = coast(geojson(tmp_path / "a.geojson", point, polygon(square(*ORIGIN, 0.2))))
        assert found.notes == ["Geometries of a.geojson that are no polygons were left out: 1 of type 'Point'."]

    def test_a_search_area_is_whole(self, tmp_path):
        (area,) = search_area(geojson(tmp_path / "a.geojson", polygon(square(*ORIGIN, 1.0))), Frame(ORIGIN))
        assert np.abs(area.shell[:, 1]).max() > 100e3


class TestRefusals:
    """One sentence each."""

    @pytest.mark.parametrize(
        ("text", "problem"),
        [("", "is empty"), ("{", "is not JSON"), ("[1]", "is no object"), ('{"type": "FeatureCollection"}', "a list"),
         ('{"type": "FeatureCollection", "features": [1]}', "is 1, not a GeoJSON object"),
         ('{"type": "FeatureCollection", "features": []}', "holds no polygons"),
         ('{"type": "Topology"}', "holds no polygons"),
         ('{"type": "Polygon", "coordinates": 3}', "where a list belongs"),
         ('{"type": "Polygon", "coordinates": [[["a", 1]]]}', "not [lon, lat]"),
         ('{"type": "Polygon", "coordinates": [[[1], [2], [3], [1]]]}', "not [lon, lat]"),
         ('{"type": "Polygon", "coordinates": [[[1, NaN], [2, 2], [3, 3], [1, NaN]]]}', "not degrees")],
    )  # fmt: skip
    def test_what_is_no_geojson(self, tmp_path, text, problem):
        path = tmp_path / "a.geojson"
        path.write_text(text, encoding="utf-8")
        assert problem in refusal(path)[1]

    @pytest.mark.parametrize("seed", range(200))
    def test_damaged_at_random(self, tmp_path, seed):
        rings = polygon(square(*ORIGIN, 0.02), square(*ORIGIN, 0.01))
        path = geojson(
            tmp_path / "a.geojson", rings, {"type": "MultiPolygon", "coordinates": [[square(*ORIGIN, 0.03)]]}
        )
        chance = random.Random(seed)
        if seed % 2:
            hurt_bytes(path, chance)
        else:
            tree = json.loads(path.read_text(encoding="utf-8"))
            hurt_json(tree, chance)
            path.write_text(json.dumps(tree), encoding="utf-8")
        said = str(path)
        try:
            coast(path)
        except SeaError as error:
            said = str(error)
        assert str(path) in said

    def test_bytes_that_are_no_text(self, tmp_path):
        path = tmp_path / "a.geojson"
        path.write_bytes(b"\xff\xfe\x00")
        assert "is not JSON" in refusal(path)[1]

    def test_a_ring_that_is_not_closed(self, tmp_path):
        where, problem, _ = refusal(geojson(tmp_path / "a.geojson", polygon(square(*ORIGIN, 0.02)[:-1])))
        assert where.endswith("a.geojson feature 0 ring 0")
        assert "is not closed" in problem

    def test_a_ring_of_three_positions(self, tmp_path):
        assert "fewer than 4" in refusal(geojson(tmp_path / "a.geojson", polygon([[1, 1], [2, 2], [1, 1]])))[1]

    def test_lines(self, tmp_path):
        line = {"type": "LineString", "coordinates": square(*ORIGIN, 0.02)}
        assert refusal(geojson(tmp_path / "a.geojson", line))[1] == "holds no polygons, but 1 of type 'LineString'"

    def test_another_coordinate_system(self, tmp_path):
        crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}
        problem = refusal(geojson(tmp_path / "a.geojson", polygon(square(*ORIGIN, 0.02)), crs=crs))[1]
        assert "EPSG::25832', not in longitude and latitude" in problem

    def test_meters(self, tmp_path):
        assert "are not degrees" in refusal(geojson(tmp_path / "a.geojson", polygon(square(3e5, 6.6e6, 100.0))))[1]

    def test_a_shapefile_and_an_absent_file(self, tmp_path):
        (tmp_path / "a.shp").write_bytes(b"\0")
        assert "ogr2ogr" in refusal(tmp_path / "a.shp")[2]
        assert refusal(tmp_path / "b.geojson")[1] == "no such file"


class TestClipping:
    """A ring inside a box, by its even-odd area."""

    LOW, HIGH = np.array([0.0, 0.0]), np.array([1.0, 1.0])

    def area(self, ring):
        x, y = ring.T
        return abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) / 2

    def test_a_square_over_a_corner(self):
        ring = np.array(square(0.0, 0.0, 0.5), float)
        assert self.area(clipped(ring, self.LOW, self.HIGH)) == pytest.approx(0.25)

    def test_around_and_beside(self):
        assert self.area(clipped(np.array(square(0, 0, 9.0), float), self.LOW, self.HIGH)) == pytest.approx(1.0)
        assert len(clipped(np.array(square(5, 5, 1.0), float), self.LOW, self.HIGH)) == 0

    def test_a_ring_around_a_corner_without_meeting_the_box(self):
        ring = np.array([[-1.0, 0.5], [0.5, -1.0], [-1.0, -1.0], [-1.0, 0.5]])
        found = clipped(ring, self.LOW, self.HIGH)
        assert len(found) == 0 or self.area(found) == pytest.approx(0.0)
