"""Specification of reading currents and wind: each convention against a field that is known everywhere."""

import shutil
import threading
import tracemalloc
from datetime import timedelta

import numpy as np
import pytest

from sea_files import (
    AROME,
    HALF,
    LAT,
    LAT_IS,
    LON,
    LON_IS,
    NORKYST,
    ORIGIN,
    RADAR,
    START,
    TIME,
    TIME_IS,
    assert_is_the_field,
    axis,
    east,
    netcdf,
    north,
    reading,
    real,
    regular,
)
from shoal.core.errors import SeaError
from shoal.core.geodesy import Frame

pytest.importorskip("netCDF4")
pyproj = pytest.importorskip("pyproj")

STANDARD = ("eastward_sea_water_velocity", "northward_sea_water_velocity")


class TestRegularGrids:
    """Axes of longitude and latitude keep their grid."""

    def test_copernicus_marine(self, tmp_path):
        field = reading(regular(tmp_path / "cmems.nc"))
        assert_is_the_field(field)
        assert not field.metric
        assert not field.land.any()
        assert field.notes == []

    def test_only_the_window_is_kept_with_two_cells_around_it(self, tmp_path):
        field = reading(regular(tmp_path / "cmems.nc"))
        assert np.all(np.diff(field.first) > 0)
        lon, lat = Frame(ORIGIN).geographic(HALF, HALF)
        assert np.searchsorted(field.first, lon) == len(field.first) - 3
        assert np.searchsorted(field.second, lat) == len(field.second) - 3
        assert field.u.dtype == np.float32
        assert field.u.shape == (3, len(field.second), len(field.first))

    def test_times_are_from_the_last_before_the_start_to_the_first_after_the_end(self, tmp_path):
        path = regular(tmp_path / "cmems.nc")
        field = reading(path, start=START + timedelta(hours=0.5), duration=3600.0)
        assert field.time.tolist() == [-1800.0, 1800.0, 5400.0]
        assert reading(path, duration=3600.0).time.tolist() == [0.0, 3600.0]
        assert reading(path, start=START.replace(tzinfo=None), duration=3600.0).time.tolist() == [0.0, 3600.0]

    def test_descending_latitude_and_longitude(self, tmp_path):
        assert_is_the_field(reading(regular(tmp_path / "a.nc", lat=LAT[::-1])))
        assert_is_the_field(reading(regular(tmp_path / "b.nc", lat=LAT[::-1], lon=LON[::-1])))

    def test_descending_time(self, tmp_path):
        field = reading(regular(tmp_path / "a.nc", time=TIME[::-1]))
        assert_is_the_field(field)
        assert field.time.tolist() == [0.0, 3600.0, 7200.0]

    @pytest.mark.parametrize("shift", [-360.0, 360.0])
    def test_longitudes_on_another_turn(self, tmp_path, shift):
        field = reading(regular(tmp_path / "a.nc", lon=LON + shift))
        assert_is_the_field(field)
        assert abs(field.first.mean() - ORIGIN[0]) < 1.0

    @pytest.mark.parametrize(
        "lon", [np.arange(-180.0, 180.0, 0.5), np.arange(0.0, 360.0, 0.5), np.arange(0.0, 360.1, 0.5)]
    )
    @pytest.mark.parametrize("origin", [(180.0, 60.0), (-179.9, 60.0), (0.0, 60.0), (359.9, 60.0), (5.0, 60.0)])
    def test_the_whole_earth_has_no_seam(self, tmp_path, lon, origin):
        lat = axis(60.0, 3.0, 13)
        path = regular(tmp_path / "a.nc", lon=lon, lat=lat, time=TIME[:1])
        field = reading(path, origin=origin, half=60e3)
        assert np.all(np.diff(field.first) == pytest.approx(0.5))
        assert field.first[0] < origin[0] < field.first[-1]
        first, second = np.meshgrid(field.first, field.second)
        frame = Frame(origin)
        u, v = frame.turned(first, second, east(first, second), north(first, second))
        np.testing.assert_allclose(field.u[0], u, rtol=1e-5, atol=1e-5)
        np.testing.assert_allclose(field.v[0], v, rtol=1e-5, atol=1e-5)

    def test_a_region_across_the_antimeridian(self, tmp_path):
        lon = np.array([178.0, 178.5, 179.0, 179.5, -180.0, -179.5, -179.0, -178.5])
        path = regular(tmp_path / "a.nc", lon=lon, lat=axis(60.0, 3.0, 13))
        field = reading(path, origin=(-179.8, 60.0), half=20e3)
        assert field.first[0] < -180.0 < field.first[-1]

    def test_packed_integers_and_fill_values(self, tmp_path):
        packing = {"dtype": "i2", "scale_factor": 1e-4, "add_offset": 0.5, "_FillValue": np.int16(-32767)}
        assert_is_the_field(reading(regular(tmp_path / "a.nc", **packing)), tolerance=6e-5)

    @pytest.mark.parametrize("order", [("lon", "lat", "time"), ("lat", "time", "lon")])
    def test_any_order_of_dimensions(self, tmp_path, order):
        t, y, x = np.meshgrid(TIME, LAT, LON, indexing="ij")
        turn = [("time", "lat", "lon").index(name) for name in order]
        change = {
            name: (order, np.transpose(values(x, y, t), turn), {"units": "m/s"})
            for name, values in (("uo", east), ("vo", north))
        }
        assert_is_the_field(reading(regular(tmp_path / "a.nc", change=change)))

    @pytest.mark.parametrize("step", [1, -1])
    def test_a_longitude_and_a_latitude_for_each_node_of_straight_rows(self, tmp_path, step):
        lon, lat = np.meshgrid(LON, LAT[::step])
        change = {"lon": (("lat", "lon"), lon, LON_IS), "lat": (("lat", "lon"), lat, LAT_IS)}
        field = reading(regular(tmp_path / "a.nc", lat=LAT[::step], change=change))
        assert_is_the_field(field)
        assert not field.metric

    def test_the_digest_is_of_what_was_read(self, tmp_path):
        path = regular(tmp_path / "a.nc")
        other = shutil.copy(path, tmp_path / "b.nc")
        assert reading(path).digest == reading(other).digest
        assert reading(path).digest != reading(path, half=8000.0).digest
        assert reading(path).digest != reading(path, duration=3000.0).digest

    def test_a_coarse_grid_at_the_pole(self, tmp_path):
        lon, lat = np.arange(0.0, 360.0, 2.5), np.arange(-90.0, 91.0, 2.5)
        change = {name: (("time", "lat", "lon"), np.ones((1, 73, 144)), {"units": "m/s"}) for name in ("uo", "vo")}
        path = regular(tmp_path / "a.nc", lon=lon, lat=lat, time=TIME[:1], change=change)
        field = reading(path, origin=(30.0, 88.0))
        np.testing.assert_allclose(np.hypot(field.u, field.v), 2.0**0.5, rtol=1e-2)

    def test_where_another_thread_runs(self, tmp_path):
        done = threading.Event()
        threading.Thread(target=done.wait, daemon=True).start()
        path = regular(tmp_path / "a.nc")
        try:
            assert_is_the_field(reading(path))
            with pytest.raises(SeaError, match="does not cover"):
                reading(path, origin=(50.0, 60.0))
        finally:
            done.set()


class TestNamesAndUnits:
    """Components are found by standard_name, then by usual names."""

    @pytest.mark.parametrize("names", [("uo", "vo"), ("u", "v"), ("water_u", "water_v"), ("EWCT", "NSCT")])
    def test_usual_names_of_currents(self, tmp_path, names):
        assert_is_the_field(reading(regular(tmp_path / "a.nc", names=names)))

    @pytest.mark.parametrize("names", [("u10", "v10"), ("uwnd", "vwnd"), ("U10M", "V10M"), ("u", "v")])
    def test_usual_names_of_wind(self, tmp_path, names):
        assert_is_the_field(reading(regular(tmp_path / "a.nc", names=names), quantity="wind"))

    def test_standard_names_go_before_usual_names(self, tmp_path):
        t, y, x = np.meshgrid(TIME, LAT, LON, indexing="ij")
        over = ("time", "lat", "lon")
        change = {
            "a": (over, east(x, y, t), {"units": "m/s", "standard_name": STANDARD[0]}),
            "b": (over, north(x, y, t), {"units": "m/s", "standard_name": STANDARD[1]}),
            "water_u_bottom": (over, 0 * t, {"units": "m/s", "standard_name": STANDARD[0]}),
        }
        path = regular(tmp_path / "a.nc", names=("v", "u"), change=change)
        assert_is_the_field(reading(path))

    @pytest.mark.parametrize("other", ["barotropic_eastward", "surface_geostrophic_eastward"])
    def test_all_of_the_current_goes_before_a_part_of_it(self, tmp_path, other):
        t, y, x = np.meshgrid(TIME, LAT, LON, indexing="ij")
        over = ("time", "lat", "lon")
        part = [f"{other}_sea_water_velocity", f"{other.replace('east', 'north')}_sea_water_velocity"]
        whole = ["sea_water_x_velocity", "sea_water_y_velocity"]
        pairs = {
            name: (over, values, {"units": "m/s", "standard_name": said})
            for name, values, said in zip(
                "abcd", (0 * t, 0 * t, east(x, y, t), north(x, y, t)), part + whole, strict=True
            )
        }
        change = {"uo": None, "vo": None}
        field = reading(regular(tmp_path / "a.nc", change={**change, **pairs}))
        assert_is_the_field(field)
        assert field.notes == []
        half = {name: pairs[name] for name in "ab"}
        (note,) = reading(regular(tmp_path / "b.nc", change={**change, **half})).notes
        assert note == f"a is {part[0]}, not all of the current at the surface."

    @pytest.mark.parametrize(
        ("units", "scale"),
        [("m/s", 1.0), ("m s^-1", 1.0), ("meter second-1", 1.0), ("metres per second", 1.0), ("cm s-1", 0.01),
         ("cm/s", 0.01), ("knots", 1852 / 3600), ("kt", 1852 / 3600)],
    )  # fmt: skip
    def test_units_are_converted(self, tmp_path, units, scale):
        assert_is_the_field(reading(regular(tmp_path / "a.nc", units=units, scale=scale)), tolerance=1e-5)

    @pytest.mark.parametrize(
        ("values", "units"),
        [(np.arange(4) * 60, "minutes since 2020-01-01"), (np.arange(4) / 24, "days since 2020-01-01T00:00:00Z"),
         (np.arange(4) * 3600 + 1_577_836_800, "seconds since 1970-01-01"),
         (np.arange(4) + 2, "hours since 2020-01-01 00:00 +02:00")],
    )  # fmt: skip
    def test_units_of_time(self, tmp_path, values, units):
        change = {"time": (("time",), values, {"units": units})}
        assert_is_the_field(reading(regular(tmp_path / "a.nc", change=change)))


class TestLevels:
    """The surface of the sea, and the wind at 10 m."""

    def levels(self, tmp_path, values, at, quantity="currents", **attributes):
        """A file whose field is right at index `at` of a vertical axis, and 0 elsewhere."""
        t, z, y, x = np.meshgrid(TIME, np.arange(len(values)), LAT, LON, indexing="ij")
        names = ("water_u", "water_v") if quantity == "currents" else ("u", "v")
        variables = {
            "time": (("time",), TIME, TIME_IS),
            "lat": (("lat",), LAT, LAT_IS),
            "lon": (("lon",), LON % 360.0, LON_IS),
            "level": (("level",), np.array(values), attributes),
            names[0]: (("time", "level", "lat", "lon"), np.where(z == at, east(x, y, t), 0.0), {"units": "m/s"}),
            names[1]: (("time", "level", "lat", "lon"), np.where(z == at, north(x, y, t), 0.0), {"units": "m/s"}),
        }
        sizes = {"time": len(TIME), "level": len(values), "lat": len(LAT), "lon": len(LON)}
        return reading(netcdf(tmp_path / "levels.nc", sizes, variables), quantity)

    @pytest.mark.parametrize(
        ("values", "at"),
        [([0.0, 2.0, 4.0], 0), ([100.0, 10.0, 0.5], 2), ([-50.0, -0.5], 1), ([-0.9, -0.5, -0.1], 2)],
    )
    def test_the_level_nearest_to_the_surface(self, tmp_path, values, at):
        field = self.levels(tmp_path, values, at, units="m", axis="Z")
        assert_is_the_field(field)
        assert field.notes == [f"Of {len(values)} levels of water_u, level = {values[at]:g} m was taken."]

    def test_each_component_may_have_an_axis_of_its_own(self, tmp_path):
        t, y, x = np.meshgrid(TIME, LAT, LON, indexing="ij")
        depths, about = np.array([0.5, 5.0]), {"units": "m", "positive": "down"}
        variables = {"time": (("time",), TIME, TIME_IS), "lat": (("lat",), LAT, LAT_IS), "lon": (("lon",), LON, LON_IS)}
        for name, depth, values in (("uo", "depthu", east(x, y, t)), ("vo", "depthv", north(x, y, t))):
            variables[depth] = ((depth,), depths, about)
            variables[name] = (("time", depth, "lat", "lon"), np.stack((values, 0 * t), axis=1), {"units": "m/s"})
        sizes = {"time": 4, "lat": len(LAT), "lon": len(LON), "depthu": 2, "depthv": 2}
        assert_is_the_field(reading(netcdf(tmp_path / "nemo.nc", sizes, variables)))

    @pytest.mark.parametrize(
        ("values", "units", "at"), [([2.0, 10.0, 80.0], "m", 1), ([500.0, 1000.0, 850.0], "hPa", 1)]
    )
    def test_the_wind_nearest_to_10_m(self, tmp_path, values, units, at):
        assert_is_the_field(self.levels(tmp_path, values, at, quantity="wind", units=units))


class TestMissing:
    """Land, gaps, and marks for missing that nobody declared."""

    def holed(self, tmp_path, holes, **attributes):
        """A file with values at some (time, row, column) replaced."""
        t, y, x = np.meshgrid(TIME, LAT, LON, indexing="ij")
        u, v = east(x, y, t), north(x, y, t)
        for where, value in holes:
            u[where], v[where] = value, value
        over = ("time", "lat", "lon")
        change = {"uo": (over, u, {"units": "m/s", **attributes}), "vo": (over, v, {"units": "m/s", **attributes})}
        return regular(tmp_path / "holed.nc", change=change)

    def place(self, field, lon, lat):
        return int(np.argmin(np.abs(field.second - lat))), int(np.argmin(np.abs(field.first - lon)))

    def test_land_is_what_is_missing_at_all_times(self, tmp_path):
        field = reading(self.holed(tmp_path, [(np.s_[:, 9, 10], np.nan), (np.s_[1, 9, 11], np.nan)]))
        assert field.land.sum() == 1
        assert field.land[self.place(field, LON[10], LAT[9])]
        assert np.isfinite(field.u).all()

    def test_a_gap_is_bridged_in_time_and_noted(self, tmp_path):
        field = reading(self.holed(tmp_path, [(np.s_[1, 9, 11], np.nan), (np.s_[0, 9, 12], np.nan)]))
        j, i = self.place(field, LON[11], LAT[9])
        assert field.u[1, j, i] == pytest.approx((field.u[0, j, i] + field.u[2, j, i]) / 2)
        assert field.u[0, j, i + 1] == field.u[1, j, i + 1]
        assert field.notes[0].startswith("Gaps in time, 0.")

    def test_the_fringe_of_land_is_the_sea_beside_it_and_0_farther_in(self, tmp_path):
        field = reading(self.holed(tmp_path, [(np.s_[:, :, 10:], np.nan)]))
        _, i = self.place(field, LON[10], LAT[9])
        assert field.land[:, i:].all()
        np.testing.assert_array_equal(field.u[:, 1:-1, i], field.u[:, 1:-1, i - 1])
        assert (field.u[:, :, i + 1 :] == 0.0).all()

    @pytest.mark.parametrize("mark", [1e20, 9.97e36, -32768.0, -9999.0, np.inf])
    def test_marks_that_nobody_declared(self, tmp_path, mark):
        field = reading(self.holed(tmp_path, [(np.s_[:, 9, 10], mark)]))
        assert field.land.sum() == 1
        assert "were taken as missing" in field.notes[0]

    def test_the_lowest_integer_is_a_mark(self, tmp_path):
        packing = {"dtype": "i2", "scale_factor": 1e-4}
        path = self.holed(tmp_path, [(np.s_[:, 9, 10], -3.2768)], **packing)
        assert reading(path).land.sum() == 1

    def test_missing_value(self, tmp_path):
        assert reading(self.holed(tmp_path, [(np.s_[:, 9, 10], 5.0)], missing_value=5.0)).land.sum() == 1

    def test_radar_in_cm_per_second_with_gaps(self, tmp_path):
        t, y, x = np.meshgrid(TIME, LAT, LON, indexing="ij")
        u, v = 100 * east(x, y, t), 100 * north(x, y, t)
        u[2, 9, 10] = np.nan
        named = {"units": "cm s-1", "_FillValue": -999.0}
        change = {
            "u": (("time", "lat", "lon"), u, {**named, "standard_name": "surface_eastward_sea_water_velocity"}),
            "v": (("time", "lat", "lon"), v, {**named, "standard_name": "surface_northward_sea_water_velocity"}),
        }
        field = reading(regular(tmp_path / "radar.nc", names=("u", "v"), change=change), duration=5400.0)
        assert np.isfinite(field.u).all()
        assert not field.land.any()


class TestSize:
    """Of a large file no more is held than the window."""

    def test_a_window_of_a_large_file(self, tmp_path):
        lon, lat, hours, depths = (
            axis(ORIGIN[0], 4.0, 801),
            axis(ORIGIN[1], 4.0, 801),
            np.arange(200.0),
            np.arange(10.0),
        )
        sizes = {"time": 200, "depth": 10, "lat": 801, "lon": 801}
        empty = {"time": hours, "depth": depths, "lat": lat, "lon": lon}
        about = {"time": TIME_IS, "depth": {"units": "m", "positive": "down"}, "lat": LAT_IS, "lon": LON_IS}
        path = netcdf(tmp_path / "a.nc", sizes, {name: ((name,), empty[name], about[name]) for name in sizes})
        import netCDF4

        with netCDF4.Dataset(path, "a") as dataset:  # 10 GB, of which all but the window is not written
            t, y, x = np.meshgrid(hours[100:104], lat[380:420], lon[380:420], indexing="ij")
            for name, values in (("uo", east(x, y, t)), ("vo", north(x, y, t))):
                variable = dataset.createVariable(name, "f4", tuple(sizes), chunksizes=(1, 1, 100, 100))
                variable.units = "m s-1"
                variable[100:104, 0, 380:420, 380:420] = values
        tracemalloc.start()
        field = reading(path, start=START + timedelta(hours=100))
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert_is_the_field(field, hours=100.0)
        assert peak < 5e6


class TestSteady:
    """A field of one time, or none, holds, and this is said."""

    def test_one_time(self, tmp_path):
        field = reading(regular(tmp_path / "a.nc", time=TIME[2:3]))
        assert field.time.tolist() == [0.0]
        assert field.notes == ["a.nc has one time, 2020-01-01T02:00:00Z, and is held for the whole run."]

    @pytest.mark.parametrize("hours", [None, 5.0])
    def test_no_time(self, tmp_path, hours):
        y, x = np.meshgrid(LAT, LON, indexing="ij")
        variables = {
            "lat": (("lat",), LAT, LAT_IS),
            "lon": (("lon",), LON, LON_IS),
            "u": (("lat", "lon"), east(x, y), {"units": "m/s"}),
            "v": (("lat", "lon"), north(x, y), {"units": "m/s"}),
        }
        if hours is not None:
            variables["time"] = ((), np.float64(hours), TIME_IS)
        field = reading(netcdf(tmp_path / "a.nc", {"lat": len(LAT), "lon": len(LON)}, variables))
        assert_is_the_field(field)
        said = "no times" if hours is None else "one time, 2020-01-01T05:00:00Z,"
        assert field.notes == [f"a.nc has {said} and is held for the whole run."]


class TestRealFiles:
    """NorKyst, AROME and radar."""

    def test_norkyst_is_as_its_variables_at_the_origin(self):
        import netCDF4

        start = START.replace(year=2015, month=11, day=16)
        with netCDF4.Dataset(real(NORKYST)) as dataset:
            lon, lat = float(dataset["lon"][20]), float(dataset["lat"][80])
            u, v = dataset["u"][3, 80, 20], dataset["v"][3, 80, 20]
        field = reading(NORKYST, origin=(lon, lat), half=10e3, start=start, duration=6 * 3600)
        j, i = np.argmin(np.abs(field.second - lat)), np.argmin(np.abs(field.first - lon))
        assert (field.u[3, j, i], field.v[3, j, i]) == pytest.approx((u, v), abs=1e-6)
        assert len(field.time) == 7

    def test_arome(self):
        start = START.replace(year=2015, month=11, day=16)
        field = reading(real(AROME), "wind", origin=(4.8, 60.6), half=20e3, start=start, duration=86400.0)
        assert 5.0 < np.hypot(field.u, field.v).mean() < 20.0
        assert not field.land.any()

    def test_radar_has_gaps_that_move(self):
        start = START.replace(year=2019)
        field = reading(real(RADAR), origin=(-73.5, 39.8), half=60e3, start=start, duration=10 * 3600)
        assert 0.0 < field.land.mean() < 0.5
        assert any("Gaps in time" in note for note in field.notes)
