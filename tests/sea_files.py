"""Files of currents, wind and coasts, written for a test; where the real ones lie."""

import json
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest

from shoal.core.errors import SeaError
from shoal.core.geodesy import Frame
from shoal.sea.gridded import read_gridded

DATA = Path(__file__).resolve().parents[2] / "shared" / "data"
NORWAY = DATA / "norway_west"
NORKYST = NORWAY / "norway_west_currents_norkyst800_2015-11-16.nc"
AROME = NORWAY / "norway_west_wind_arome_2015-11-16.nc"
RADAR = DATA / "mab" / "mab_currents_hfradar_2019-01-01.nc"

START = datetime(2020, 1, 1, tzinfo=UTC)
HOURS = "hours since 2020-01-01 00:00:00"
ORIGIN = (5.0, 60.0)
HALF = 5000.0  # [m] of the arena


def real(path):
    if not path.is_file():
        pytest.skip(f"the real data file {path.name} is not beside this repository")
    return path


def netcdf(path, dimensions, variables, **options):
    """Write a file; each variable: (dimensions, values, attributes), whose dtype may be given as `dtype`."""
    library = pytest.importorskip("netCDF4")
    with library.Dataset(path, "w", **options) as dataset:
        for name, size in dimensions.items():
            dataset.createDimension(name, size)
        for name, (over, values, attributes) in variables.items():
            attributes = dict(attributes)
            fill, dtype = attributes.pop("_FillValue", None), attributes.pop("dtype", np.asarray(values).dtype)
            variable = dataset.createVariable(name, dtype, over, fill_value=fill)
            variable.setncatts(attributes)
            variable.set_auto_maskandscale("scale_factor" in attributes and np.asarray(values).dtype.kind == "f")
            variable[...] = values
    return path


def east(lon, lat, hours=0.0):
    """A field [m/s] that differs everywhere, and grows."""
    return (0.3 + 2.0 * (lat - ORIGIN[1])) * (1.0 + 0.1 * hours) + 0.0 * lon


def north(lon, lat, hours=0.0):
    return -0.2 + 2.0 * np.sin(np.radians(10.0 * (lon - ORIGIN[0]))) + 0.05 * hours + 0.0 * lat


def axis(middle, reach, count):
    return np.linspace(middle - reach, middle + reach, count)


LON, LAT, TIME = axis(ORIGIN[0], 0.3, 21), axis(ORIGIN[1], 0.15, 19), np.arange(4.0)
LON_IS, LAT_IS = {"units": "degrees_east"}, {"units": "degrees_north"}
TIME_IS = {"units": HOURS, "standard_name": "time"}


def regular(path, names=("uo", "vo"), lon=LON, lat=LAT, time=TIME, units="m s-1", scale=1.0, **more):
    """A file on axes of longitude and latitude; `more`: of both components, `change`: of all variables."""
    change = more.pop("change", {})
    t, y, x = np.meshgrid(time, lat, lon, indexing="ij")
    over = ("time", "lat", "lon")
    variables = {
        "time": (("time",), time, TIME_IS),
        "lat": (("lat",), lat, LAT_IS),
        "lon": (("lon",), lon, LON_IS),
        names[0]: (over, east(x, y, t) / scale, {"units": units, **more}),
        names[1]: (over, north(x, y, t) / scale, {"units": units, **more}),
    }
    variables = {name: each for name, each in {**variables, **change}.items() if each is not None}
    return netcdf(path, {"time": len(time), "lat": len(lat), "lon": len(lon)}, variables)


def reading(path, quantity="currents", origin=ORIGIN, half=HALF, start=START, duration=7200.0):
    return read_gridded(path, quantity, Frame(origin), half, half, start, duration)


def refusal(path, **options):
    """(where, problem, fix) of the error that reading `path` raises."""
    with pytest.raises(SeaError) as caught:
        reading(path, **options)
    return caught.value.args


def assert_is_the_field(field, frame=None, tolerance=2e-6, half=HALF, hours=0.0):
    """At every node in the arena, at every time, the field is `east` and `north`, turned into the frame."""
    frame = frame or Frame(ORIGIN)
    first, second = np.meshgrid(field.first, field.second)
    lon, lat = frame.geographic(first, second) if field.metric else (first, second)
    x, y = frame.local(lon, lat)
    arena = (np.abs(x) <= half * 1.001) & (np.abs(y) <= half * 1.001)
    assert arena.sum() > 9
    for k, later in enumerate(hours + field.time / 3600.0):
        u, v = frame.turned(lon, lat, east(lon, lat, later), north(lon, lat, later))
        np.testing.assert_allclose(field.u[k][arena], u[arena], atol=tolerance)
        np.testing.assert_allclose(field.v[k][arena], v[arena], atol=tolerance)


def geojson(path, *geometries, **more):
    features = [{"type": "Feature", "properties": {}, "geometry": each} for each in geometries]
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features, **more}), encoding="utf-8")
    return path


def square(lon, lat, half):
    """A closed ring [deg]."""
    return [[lon + half * a, lat + half * b] for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1))]


def polygon(*rings):
    return {"type": "Polygon", "coordinates": list(rings)}
