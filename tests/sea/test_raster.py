"""Specification of the raster of distances to the shore."""

import numpy as np
import pytest

from sea_files import NORWAY, ORIGIN, geojson, polygon, real, square
from shoal.core.errors import SeaError
from shoal.core.geodesy import Frame
from shoal.sea.coast import read_coast
from shoal.sea.gridded import Gridded
from shoal.sea.polygons import Polygon
from shoal.sea.raster import filled, land_raster, search_area

pytest.importorskip("pyproj")
pytest.importorskip("scipy")

FRAME = Frame(ORIGIN)


def raster(polygons, half=1000.0, **options):
    return land_raster(polygons, None, FRAME, half, half, **options)


def island(x, y, half):
    return Polygon(np.array(square(x, y, half), float), [])


def centers(found):
    rows, columns = found.distance.shape
    return np.meshgrid(found.x0 + found.cell * np.arange(columns), found.y0 + found.cell * np.arange(rows))


class TestDistance:
    """Positive at sea, negative on land, zero at the shore."""

    def test_of_an_island(self):
        found = raster([island(0.0, 0.0, 300.0)], cell=10.0)
        x, y = centers(found)
        assert found.x0 == -1015.0
        inside = np.maximum(abs(x), abs(y)) < 300.0
        np.testing.assert_array_equal(found.distance < 0, inside)
        east = (abs(y) < 200) & (x > 300)
        np.testing.assert_allclose(found.distance[east], (x - 300.0)[east], atol=1e-3)
        middle = found.distance[inside & (abs(x) < 6) & (abs(y) < 6)]
        np.testing.assert_allclose(middle, -295.0, atol=1e-3)

    def test_the_arena_and_two_cells_more(self):
        found = land_raster([], None, FRAME, 1000.0, 333.0, 10.0)
        assert found.distance.shape == (71, 204)
        assert (found.distance > 2000.0).all()

    def test_a_lake_in_an_island_is_sea(self):
        hole = np.array(square(0.0, 0.0, 100.0), float)
        found = raster([Polygon(np.array(square(0.0, 0.0, 300.0), float), [hole])], cell=10.0)
        assert found.distance[102, 102] > 0.0

    def test_overlapping_polygons_are_land_together(self):
        found = raster([island(0.0, 0.0, 300.0), island(100.0, 0.0, 300.0)], cell=10.0)
        assert (found.distance < 0).sum() * 100.0 == 700.0 * 600.0

    def test_beyond_the_search_area_is_as_land(self):
        found = raster([island(0.0, 0.0, 100.0)], cell=10.0, outside=[island(0.0, 0.0, 500.0)])
        assert (found.distance > 0).sum() * 100.0 == 1000.0**2 - 200.0**2

    def test_a_search_area_of_a_file(self, tmp_path):
        area = search_area(geojson(tmp_path / "a.geojson", polygon(square(*ORIGIN, 0.005))), FRAME)
        at_sea = (raster(None, outside=area).distance > 0).sum() * 25.0
        assert at_sea == pytest.approx((0.01 * 55_800) * (0.01 * 111_412), rel=0.01)

    @pytest.mark.parametrize(("half", "cell"), [(100.0, 5.0), (5_000.0, 5.0), (20_000.0, 20.0)])
    def test_cells_by_the_size_of_the_arena(self, half, cell):
        assert land_raster(None, None, FRAME, half, half / 100).cell == cell


class TestFieldAsLand:
    """Where there is no coast, nodes without values are land."""

    def field(self, metric):
        axis = np.linspace(-2000.0, 2000.0, 5)
        first, second = (axis, axis) if metric else (ORIGIN[0] + axis / 55_800, ORIGIN[1] + axis / 111_412)
        land = np.zeros((5, 5), dtype=bool)
        land[2, 3] = True  # around (1000, 0)
        zero = np.zeros((1, 5, 5), np.float32)
        return Gridded(zero, zero, np.zeros(1), first, second, metric, land)

    @pytest.mark.parametrize("metric", [True, False])
    def test_the_nearest_node_decides(self, metric):
        found = land_raster(None, self.field(metric), FRAME, 1800.0, 1800.0, cell=20.0)
        x, y = centers(found)
        expected = (abs(x - 1000.0) < 500.0) & (abs(y) < 500.0)
        assert (expected != (found.distance < 0)).mean() < (1e-9 if metric else 0.01)
        assert found.notes == ["There is no coast file: where the field has no values is land."]

    def test_a_coast_goes_before(self):
        assert (land_raster([], self.field(True), FRAME, 1800.0, 1800.0).distance > 0).all()


class TestRefusals:
    """One sentence each."""

    def test_nothing_but_land(self):
        with pytest.raises(SeaError, match="all of it is land"):
            raster([island(0.0, 0.0, 5000.0)])

    def test_a_search_area_elsewhere(self):
        with pytest.raises(SeaError, match="outside the search area"):
            raster([], outside=[island(1e5, 0.0, 100.0)])

    @pytest.mark.parametrize("cell", [0.0, -1.0, np.nan, 0.01])
    def test_cells_of_no_size(self, cell):
        with pytest.raises(SeaError, match="cells of"):
            raster([], cell=cell)


class TestFilling:
    """No center is wrong."""

    def agrees(self, polygons, x, y):
        shapely = pytest.importorskip("shapely")
        shapes = [shapely.Polygon(each.shell, each.holes) for each in polygons]
        tree = shapely.STRtree(shapes)
        points = shapely.points(*(each.ravel() for each in np.meshgrid(x, y)))
        truth = np.zeros(len(points), dtype=bool)
        truth[tree.query(points, predicate="within")[0]] = True
        return np.array_equal(filled(polygons, x, y).ravel(), truth)

    @pytest.mark.parametrize("seed", range(5))
    def test_stars_with_holes(self, seed):
        chance = np.random.default_rng(seed)
        angle = np.linspace(0.0, 2 * np.pi, 60)[:-1]
        polygons = []
        for _ in range(6):
            reach, middle = chance.uniform(20.0, 60.0, len(angle)), chance.uniform(-60.0, 60.0, 2)
            ring = middle + reach[:, None] * np.stack((np.cos(angle), np.sin(angle)), axis=1)
            ring = np.concatenate((ring, ring[:1]))
            polygons.append(Polygon(ring, [middle + 0.3 * (ring - middle)]))
        assert self.agrees(polygons, np.arange(-80.0, 81.0), np.arange(-70.0, 71.0))

    def test_centers_on_edges_and_vertices_belong_to_one_of_two_neighbors(self):
        left, right = island(-1.0, 0.0, 1.0), island(1.0, 0.0, 1.0)
        x, y = np.arange(-3.0, 4.0), np.arange(-2.0, 3.0)
        both = filled([left], x, y).astype(int) + filled([right], x, y)
        assert both.max() == 1
        assert both.sum() == 8

    def test_a_figure_of_eight_is_even_odd(self):
        ring = np.array([[-2, -2], [2, 2], [2, -2], [-2, 2], [-2, -2]], float)
        found = filled([Polygon(ring, [])], np.arange(-2.5, 3.0), np.arange(-2.5, 3.0))
        assert found.sum() == 8

    def test_the_coast_of_norway(self):
        frame = Frame((4.9, 60.7))
        land = read_coast(real(NORWAY / "norway_west_coastline_osm.geojson"), frame, 10e3, 10e3).polygons
        axis = np.arange(-10e3, 10e3, 101.3)
        assert self.agrees(land, axis, axis)
