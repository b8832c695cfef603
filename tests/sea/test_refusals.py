"""Specification of what is refused of a file of currents or wind: one sentence says where, what and how to mend it."""

import random
import sys
from datetime import timedelta

import numpy as np
import pytest

from damage import hurt_bytes
from sea_files import LAT, LAT_IS, LON, LON_IS, ORIGIN, START, TIME, TIME_IS, netcdf, reading, refusal, regular
from shoal.core.errors import MissingExtraError, SeaError

pytest.importorskip("netCDF4")
pytest.importorskip("pyproj")


class TestFiles:
    """Files that are absent, of another kind, or damaged."""

    def test_absent(self, tmp_path):
        regular(tmp_path / "cmems.nc")
        assert refusal(tmp_path / "cmem.nc")[1:] == ("no such file", "did you mean cmems.nc?")

    def test_a_folder(self, tmp_path):
        assert refusal(tmp_path)[1] == "is a folder"

    def test_an_address(self):
        assert "not a file" in refusal("https://example.org/a.nc")[1]

    @pytest.mark.parametrize(
        ("content", "problem"),
        [(b"", "is empty"), (b"time,u,v\n", "is not a NetCDF file"), (b"GRIB\0\0\1", "is a GRIB file"),
         (b"\x1f\x8b\x08", "is compressed"), (b"<!DOCTYPE html>", "is a page of the web"),
         (b"\x89HDF\r\n\x1a\n" + b"\0" * 100, "cannot be read"), (b"CDF\x01" + b"\xff" * 40, "")],
    )  # fmt: skip
    def test_another_kind(self, tmp_path, content, problem):
        path = tmp_path / "a.nc"
        path.write_bytes(content)
        assert problem in refusal(path)[1]

    @pytest.mark.parametrize("share", [0.3, 0.6, 0.95])
    def test_cut_off(self, tmp_path, share):
        path = regular(tmp_path / "a.nc")
        content = path.read_bytes()
        path.write_bytes(content[: int(share * len(content))])
        refusal(path)

    @pytest.mark.parametrize("seed", range(24))
    def test_damaged_at_random(self, tmp_path, seed):
        path = regular(tmp_path / "a.nc")
        hurt_bytes(path, random.Random(seed))
        said = str(path)
        try:
            reading(path)
        except SeaError as error:
            said = str(error)
        assert str(path) in said

    def test_without_netcdf4(self, tmp_path, monkeypatch):
        path = regular(tmp_path / "a.nc")
        monkeypatch.setitem(sys.modules, "netCDF4", None)
        with pytest.raises(MissingExtraError, match=r"pip install '\.\[maritime\]'"):
            reading(path)


class TestVariables:
    """Components that are not there, or are not speeds."""

    def test_none_lists_what_there_is(self, tmp_path):
        problem = refusal(regular(tmp_path / "a.nc", names=("salt", "temp")))[1]
        assert problem.startswith("holds no currents: no variables with standard_name eastward_sea_water_velocity")
        assert problem.endswith("it has time, lat, lon, salt, temp")

    def test_half_a_pair(self, tmp_path):
        assert "uo is there, but no vo" in refusal(regular(tmp_path / "a.nc", names=("uo", "temp")))[1]

    def test_wind_is_no_current_whatever_its_name(self, tmp_path):
        path = regular(tmp_path / "a.nc", names=("u", "v"), standard_name="eastward_wind")
        assert "holds no currents" in refusal(path)[1]

    @pytest.mark.parametrize("units", ["K", "m", "1", "m s-2", "degrees"])
    def test_units_of_something_else(self, tmp_path, units):
        where, problem, _ = refusal(regular(tmp_path / "a.nc", units=units))
        assert where.endswith("a.nc uo")
        assert problem == f"has the units '{units}', which are not of a speed"

    def test_no_units(self, tmp_path):
        assert refusal(regular(tmp_path / "a.nc", units=""))[1] == "has no units"

    def test_all_missing(self, tmp_path):
        path = regular(tmp_path / "a.nc", scale=1e-30)
        assert "all values in longitude" in refusal(path)[1]

    def test_several_members(self, tmp_path):
        over = ("member", "lat", "lon")
        values = np.zeros((3, len(LAT), len(LON)))
        variables = {
            "lat": (("lat",), LAT, LAT_IS),
            "lon": (("lon",), LON, LON_IS),
            "u": (over, values, {"units": "m/s"}),
            "v": (over, values, {"units": "m/s"}),
        }
        path = netcdf(tmp_path / "a.nc", {"member": 3, "lat": len(LAT), "lon": len(LON)}, variables)
        assert "has 3 indices along 'member'" in refusal(path)[1]

    def test_components_that_are_not_alike(self, tmp_path):
        steady = (("lat", "lon"), np.zeros((len(LAT), len(LON))), {"units": "m/s"})
        problem = refusal(regular(tmp_path / "a.nc", change={"vo": steady}))[1]
        assert problem == "uo(time, lat, lon) and vo(lat, lon) are not on one grid, at the same times"


class TestPlaces:
    """Windows that a file does not cover, and axes that are none."""

    @pytest.mark.parametrize("origin", [(5.28, 60.0), (5.0, 60.14), (100.0, 0.0), (-175.0, 60.0)])
    def test_an_arena_outside_says_both_boxes(self, tmp_path, origin):
        problem = refusal(regular(tmp_path / "a.nc"), origin=origin)[1]
        assert problem.startswith("does not cover the arena: it has longitude")
        assert problem.count("latitude") == 2

    def test_an_arena_that_is_larger_than_the_file(self, tmp_path):
        assert "does not cover" in refusal(regular(tmp_path / "a.nc"), half=30e3)[1]

    @pytest.mark.parametrize("origin", [(0.0, 89.99), (20.0, -88.99), (0.0, 90.0)])
    def test_a_pole(self, tmp_path, origin):
        lon, lat = np.arange(0.0, 360.0, 10.0), np.linspace(-90.0, 90.0, 181)
        path = regular(tmp_path / "a.nc", lon=lon, lat=lat, scale=1e9)
        assert "beyond 89 degrees" in refusal(path, origin=origin)[1]

    @pytest.mark.parametrize("name", ["lat", "lon"])
    def test_an_axis_that_turns_back(self, tmp_path, name):
        values, attributes = {"lat": (LAT.copy(), LAT_IS), "lon": (LON.copy(), LON_IS)}[name]
        values[5] = values[7]
        where, problem, _ = refusal(regular(tmp_path / "a.nc", change={name: ((name,), values, attributes)}))
        assert where.endswith(f"a.nc {name}")
        assert problem == "neither rises nor falls all along"

    def test_an_axis_with_holes(self, tmp_path):
        values = np.where(np.arange(len(LAT)) == 3, np.nan, LAT)
        path = regular(tmp_path / "a.nc", change={"lat": (("lat",), values, LAT_IS)})
        assert refusal(path)[1] == "has missing values"

    def test_no_longitudes(self, tmp_path):
        path = regular(tmp_path / "a.nc", change={"lon": None})
        assert "has no longitude and latitude for its dimensions time, lat, lon" in refusal(path)[1]

    def test_a_mesh_of_triangles(self, tmp_path):
        variables = {
            "lat": (("node",), LAT, LAT_IS),
            "lon": (("node",), LAT, LON_IS),
            "time": (("time",), TIME, TIME_IS),
            "u": (("time", "node"), np.zeros((4, len(LAT))), {"units": "m/s"}),
            "v": (("time", "node"), np.zeros((4, len(LAT))), {"units": "m/s"}),
        }
        path = netcdf(tmp_path / "a.nc", {"time": 4, "node": len(LAT)}, variables)
        assert "are not a grid of rows and columns" in refusal(path)[1]

    def bending(self, path, *standard_names):
        lon, lat = np.meshgrid(LON, LAT)
        variables = {
            "nav_lat": (("y", "x"), lat, LAT_IS),
            "nav_lon": (("y", "x"), lon + (lat - ORIGIN[1]), LON_IS),
            "u": (("y", "x"), 0 * lat, {"units": "m/s", "standard_name": standard_names[0]}),
            "v": (("y", "x"), 0 * lat, {"units": "m/s", "standard_name": standard_names[1]}),
        }
        return netcdf(path, {"y": len(LAT), "x": len(LON)}, variables)

    def test_a_grid_that_bends_and_says_not_along_what(self, tmp_path):
        assert "says neither that it points east" in refusal(self.bending(tmp_path / "a.nc", "", ""))[1]

    @pytest.mark.parametrize("where", [{"half": 40e3}, {"origin": (50.0, 60.0)}, {"origin": (5.3, 60.0)}])
    def test_an_arena_outside_a_grid_that_bends(self, tmp_path, where):
        path = self.bending(tmp_path / "a.nc", "sea_water_x_velocity", "sea_water_y_velocity")
        problem = refusal(path, **where)[1]
        assert problem.startswith("does not cover the arena: it has longitude")
        assert problem.count("latitude") == 2


class TestTimes:
    """Times that a file does not cover, or that are none."""

    @pytest.mark.parametrize(("later", "duration"), [(-0.5, 60.0), (2.5, 3600.0), (1e5, 60.0), (0.0, 1e9)])
    def test_a_run_outside_says_both_spans(self, tmp_path, later, duration):
        path = regular(tmp_path / "a.nc")
        problem = refusal(path, start=START + timedelta(hours=later), duration=duration)[1]
        assert problem.startswith("reaches from 2020-01-01T00:00:00Z to 2020-01-01T03:00:00Z, but the run lasts from ")

    @pytest.mark.parametrize("calendar", ["noleap", "365_day", "360_day", "julian", "all_leap", "none"])
    def test_a_calendar_of_no_real_day(self, tmp_path, calendar):
        path = regular(tmp_path / "a.nc", change={"time": (("time",), TIME, {**TIME_IS, "calendar": calendar})})
        assert f"in calendar '{calendar}' is not a time that was recorded" in refusal(path)[1]

    @pytest.mark.parametrize("units", ["months since 2020-01-01", "hours since soon"])
    def test_units_that_are_none(self, tmp_path, units):
        path = regular(tmp_path / "a.nc", change={"time": (("time",), TIME, {"units": units})})
        assert refusal(path)[0].endswith("a.nc time")

    def test_times_that_turn_back(self, tmp_path):
        path = regular(tmp_path / "a.nc", change={"time": (("time",), np.array([0.0, 2.0, 1.0, 3.0]), TIME_IS)})
        assert "2020-01-01T02:00:00Z is followed by 2020-01-01T01:00:00Z" in refusal(path)[1]

    def test_times_that_are_not_said(self, tmp_path):
        assert "no variable says when they are" in refusal(regular(tmp_path / "a.nc", change={"time": None}))[1]

    def test_a_long_silence_is_noted(self, tmp_path):
        path = regular(tmp_path / "a.nc", change={"time": (("time",), np.array([0.0, 1.0, 9.0, 10.0]), TIME_IS)})
        assert reading(path, duration=9 * 3600.0).notes == ["a.nc is silent for 8 h, which is bridged; usual are 1 h."]
