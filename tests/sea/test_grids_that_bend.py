"""Specification of grids that bend: projected, curvilinear and staggered ones, against a field known everywhere."""

import numpy as np
import pytest

from sea_files import (
    HALF,
    LAT_IS,
    LON_IS,
    ORIGIN,
    TIME,
    TIME_IS,
    assert_is_the_field,
    east,
    netcdf,
    north,
    reading,
)

pytest.importorskip("netCDF4")
pyproj = pytest.importorskip("pyproj")


def stereographic(step=800.0, reach=16):
    """Axes [m], and longitudes, latitudes [deg] and angles [rad] of a polar stereographic grid."""
    projection = pyproj.Proj(proj="stere", lat_0=90, lat_ts=60, lon_0=70, ellps="WGS84")
    x0, y0 = projection(*ORIGIN)
    x, y = (np.round(at / step) * step + step * np.arange(-reach, reach + 1) for at in (x0, y0))
    lon, lat = projection(*np.meshgrid(x, y), inverse=True)
    return x, y, lon, lat, np.radians(70.0 - lon)  # from the east to x: meridians are rays from the pole


STEREO = {
    "grid_mapping_name": "polar_stereographic", "latitude_of_projection_origin": 90.0,
    "straight_vertical_longitude_from_pole": 70.0, "standard_parallel": 60.0, "semi_major_axis": 6378137.0,
    "inverse_flattening": 298.257223563, "false_easting": 0.0, "false_northing": 0.0,
}  # fmt: skip


class TestGridsThatBend:
    """They are turned and resampled to local meters."""

    def norkyst(self, path, quantity="currents", lonlat=True, mapping=True, flipped=False):
        x, y, lon, lat, angle = stereographic()
        t = TIME[:, None, None]
        e, n = east(lon, lat, t), north(lon, lat, t)
        along, up = e * np.cos(angle) + n * np.sin(angle), n * np.cos(angle) - e * np.sin(angle)
        prefix = "sea_water" if quantity == "currents" else "wind"
        names = [f"x_{prefix}_velocity", f"y_{prefix}_velocity"] if quantity == "currents" else ["x_wind", "y_wind"]
        rows = slice(None, None, -1) if flipped else slice(None)
        variables = {
            "time": (("time",), TIME, TIME_IS),
            "X": (("X",), x, {"standard_name": "projection_x_coordinate", "units": "m"}),
            "Y": (("Y",), y[rows], {"standard_name": "projection_y_coordinate", "units": "m"}),
            "u": (
                ("time", "Y", "X"),
                along[:, rows],
                {"units": "m s-1", "standard_name": names[0], "grid_mapping": "map"},
            ),
            "v": (
                ("time", "Y", "X"),
                up[:, rows],
                {"units": "m s-1", "standard_name": names[1], "grid_mapping": "map"},
            ),
        }
        if lonlat:
            variables |= {"lon": (("Y", "X"), lon[rows], LON_IS), "lat": (("Y", "X"), lat[rows], LAT_IS)}
        if mapping:
            variables["map"] = ((), 0, STEREO)
        return netcdf(path, {"time": len(TIME), "Y": len(y), "X": len(x)}, variables)

    @pytest.mark.parametrize("known", ["lonlat", "mapping", "both"])
    @pytest.mark.parametrize("quantity", ["currents", "wind"])
    def test_polar_stereographic(self, tmp_path, known, quantity):
        path = self.norkyst(tmp_path / "a.nc", quantity, lonlat=known != "mapping", mapping=known != "lonlat")
        field = reading(path, quantity)
        assert field.metric
        assert_is_the_field(field, tolerance=2e-5)
        assert (field.first[2], field.first[-3]) == (-HALF, pytest.approx(HALF))

    def test_with_rows_from_north_to_south(self, tmp_path):
        path = self.norkyst(tmp_path / "a.nc", lonlat=False, flipped=True)
        assert_is_the_field(reading(path), tolerance=2e-5)

    def roms(self, path, angle_is="radians", sea=1.0):
        x, y, lon, lat, angle = stereographic()
        t = TIME[:, None, None]
        e, n = east(lon, lat, t), north(lon, lat, t)
        along, up = e * np.cos(angle) + n * np.sin(angle), n * np.cos(angle) - e * np.sin(angle)
        on_u, on_v = (along[:, :, 1:] + along[:, :, :-1]) / 2, (up[:, 1:] + up[:, :-1]) / 2
        levels = np.array([-0.75, -0.25])
        deep = lambda values: np.stack((0 * values, values), axis=1)  # noqa: E731
        variables = {
            "ocean_time": (("ocean_time",), TIME * 3600, {"units": "seconds since 2020-01-01 00:00:00"}),
            "s_rho": (("s_rho",), levels, {"standard_name": "ocean_s_coordinate_g2", "positive": "up"}),
            "lon_rho": (("eta_rho", "xi_rho"), lon, LON_IS),
            "lat_rho": (("eta_rho", "xi_rho"), lat, LAT_IS),
            "angle": (
                ("eta_rho", "xi_rho"),
                np.degrees(angle) if angle_is == "degrees" else angle,
                {"units": angle_is},
            ),
            "mask_rho": (("eta_rho", "xi_rho"), sea + 0.0 * lon, {}),
            "u": (("ocean_time", "s_rho", "eta_u", "xi_u"), deep(on_u), {"units": "meter second-1"}),
            "v": (("ocean_time", "s_rho", "eta_v", "xi_v"), deep(on_v), {"units": "meter second-1"}),
        }
        if angle_is == "absent":
            del variables["angle"]
        rows, columns = len(y), len(x)
        sizes = {"ocean_time": len(TIME), "s_rho": 2, "eta_rho": rows, "xi_rho": columns, "eta_u": rows}
        sizes |= {"xi_u": columns - 1, "eta_v": rows - 1, "xi_v": columns}
        return netcdf(path, sizes, variables)

    @pytest.mark.parametrize("angle_is", ["radians", "degrees", "absent"])
    def test_roms_staggered_with_an_angle(self, tmp_path, angle_is):
        field = reading(self.roms(tmp_path / "roms.nc", angle_is))
        assert_is_the_field(field, tolerance=3e-5)
        assert any("s_rho = -0.25" in note for note in field.notes)

    def test_the_mask_of_roms_is_land(self, tmp_path):
        sea = np.ones((33, 33))
        sea[:, :12] = 0.0
        field = reading(self.roms(tmp_path / "roms.nc", sea=sea))
        assert 0.1 < field.land.mean() < 0.5
        assert not reading(self.roms(tmp_path / "all.nc")).land.any()

    def test_land_of_a_grid_that_bends(self, tmp_path):
        path = self.norkyst(tmp_path / "a.nc")
        import netCDF4

        with netCDF4.Dataset(path, "a") as dataset:
            for name in ("u", "v"):
                dataset[name][:, :, 17:] = np.nan
        field = reading(path)
        assert 0.2 < field.land.mean() < 0.8
        assert np.isfinite(field.u).all()
