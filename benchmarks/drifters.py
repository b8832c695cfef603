"""Drifters by a method of its own: Runge-Kutta of fourth order on WGS 84, on the grid that a file has. NumPy alone.

Nothing of shoal is in it, so that shoal's drift can be judged by it (judge_drift.py, tests/sea/test_judge.py). A place
is a column and a row of the grid, with fractions: velocities are bilinear in both, and so are longitude and latitude,
whose slopes turn degrees a second into columns and rows a second. So one method serves grids that are straight and
grids that bend.
"""

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]

RADIUS, ECCENTRICITY_SQUARED = 6378137.0, 6.69437999014e-3  # WGS 84 [m], [-]
HOURS = "hours since 2020-01-01 00:00:00"


class Grid(NamedTuple):
    """Velocities on a grid of J rows and I columns.

    lon, lat : (J, I) [deg], continuous; time : (T,) [s] since the start
    u, v : (T, J, I) [m/s], NaN on land. With an angle they are along the grid, and on the sides of its cells:
        (T, J, I - 1), (T, J - 1, I); else they are true east and north
    angle : (J, I) [rad] from east to the rows, or None
    """

    lon: Numbers
    lat: Numbers
    time: Numbers
    u: Numbers
    v: Numbers
    angle: Numbers | None = None


def meters_per_degree(lat: Numbers) -> tuple[Numbers, Numbers]:
    """Lengths [m] of a degree of longitude and of latitude at latitudes [deg]."""
    phi = np.radians(lat)
    w = np.sqrt(1.0 - ECCENTRICITY_SQUARED * np.sin(phi) ** 2)
    along, across = RADIUS * (1.0 - ECCENTRICITY_SQUARED) / w**3, RADIUS / w * np.cos(phi)
    return np.radians(1.0) * across, np.radians(1.0) * along


def places(grid: Grid, at: Numbers) -> Numbers:
    """Longitude and latitude (P, 2) [deg] of columns and rows (P, 2)."""
    return np.stack((_between(grid.lon, *at.T)[0], _between(grid.lat, *at.T)[0]), axis=-1)


def drifted(grid: Grid, at: Numbers, duration: float, step: float = 60.0) -> tuple[Numbers, NDArray[np.bool_]]:
    """Where drifters are step by step, (1 + steps, P, 2) columns and rows, and who never left the cells known at sea.

    Parameters
    ----------
    at : (P, 2) columns and rows at the start
    duration, step : [s]
    """
    open_water = _open_cells(grid)
    way, fine = [at], np.ones(len(at), np.bool_)
    for number in range(round(duration / step)):
        time = number * step
        a = _rates(grid, at, time)
        b = _rates(grid, at + step / 2 * a, time + step / 2)
        c = _rates(grid, at + step / 2 * b, time + step / 2)
        d = _rates(grid, at + step * c, time + step)
        at = at + step / 6 * (a + 2 * b + 2 * c + d)
        i, j = np.floor(at).astype(np.intp).T
        inside = (i >= 1) & (j >= 1) & (i < grid.lon.shape[1] - 2) & (j < grid.lon.shape[0] - 2)
        fine &= inside & open_water[j.clip(0, len(open_water) - 1), i.clip(0, open_water.shape[1] - 1)]
        at = np.where(inside[:, None], at, way[0])  # who leaves begins anew, and does not count
        way.append(at)
    return np.array(way), fine


def _rates(grid: Grid, at: Numbers, time: float) -> Numbers:
    """Columns and rows a second at places (P, 2) and a time [s]."""
    column, row = at.T
    later = int(np.clip(np.searchsorted(grid.time, time, "right"), 1, len(grid.time) - 1))
    share = (time - grid.time[later - 1]) / (grid.time[later] - grid.time[later - 1])
    u, v = ((1.0 - share) * each[later - 1] + share * each[later] for each in (grid.u, grid.v))
    half = 0.0 if grid.angle is None else 0.5
    east, north = _between(np.nan_to_num(u), column - half, row)[0], _between(np.nan_to_num(v), column, row - half)[0]
    if grid.angle is not None:
        angle = _between(grid.angle, column, row)[0]
        east, north = east * np.cos(angle) - north * np.sin(angle), east * np.sin(angle) + north * np.cos(angle)
    _, lon_i, lon_j = _between(grid.lon, column, row)
    lat, lat_i, lat_j = _between(grid.lat, column, row)
    to_east, to_north = meters_per_degree(lat)
    lon_rate, lat_rate = east / to_east, north / to_north
    area = lon_i * lat_j - lon_j * lat_i
    return np.stack((lon_rate * lat_j - lat_rate * lon_j, lat_rate * lon_i - lon_rate * lat_i), axis=-1) / area[:, None]


def _between(nodes: Numbers, column: Numbers, row: Numbers) -> tuple[Numbers, Numbers, Numbers]:
    """Bilinear value of nodes (J, I) at columns and rows (P,), and its slopes along both."""
    i = np.clip(np.floor(column), 0, nodes.shape[1] - 2).astype(np.intp)
    j = np.clip(np.floor(row), 0, nodes.shape[0] - 2).astype(np.intp)
    s, t = column - i, row - j
    a, b, c, d = nodes[j, i], nodes[j, i + 1], nodes[j + 1, i], nodes[j + 1, i + 1]
    value = (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d)
    return value, (1 - t) * (b - a) + t * (d - c), (1 - s) * (c - a) + s * (d - b)


def _open_cells(grid: Grid) -> NDArray[np.bool_]:
    """Cells (J - 1, I - 1) all of whose nodes are known at all times; with sides, all are."""
    if grid.angle is not None:
        return np.ones((grid.lon.shape[0] - 1, grid.lon.shape[1] - 1), np.bool_)
    known = np.isfinite(grid.u).all(axis=0) & np.isfinite(grid.v).all(axis=0)
    return known[1:, 1:] & known[1:, :-1] & known[:-1, 1:] & known[:-1, :-1]


# --- grids that are made up, and files of them ---


def swirls(x: Numbers, y: Numbers, time: float, shortest: float, speed: float) -> tuple[Numbers, Numbers]:
    """A flow without sources [m/s] at places [m] and a time [s]: ten waves that travel, and a tide.

    Parameters
    ----------
    shortest : wavelength [m]; the longest is four times that
    speed : of the sum of the waves [m/s], about
    """
    chance = np.random.default_rng(1)
    u, v = np.full_like(x, 0.2), np.full_like(x, 0.15 * np.sin(2 * np.pi * time / 44712.0))
    for _ in range(10):
        heading, phase = 2 * np.pi * chance.random(2)
        number = 2 * np.pi / (shortest * 4.0 ** chance.random())
        wave = speed / np.sqrt(5.0) * np.cos(
            number * (x * np.cos(heading) + y * np.sin(heading)) + phase + 2e-5 * time
        )  # fmt: skip
        u, v = u - np.sin(heading) * wave, v + np.cos(heading) * wave
    return u, v


def straight(lon: Numbers, lat: Numbers, times: int, shortest: float, speed: float = 0.5) -> Grid:
    """Hourly swirls, true east and north, on axes of longitude and latitude [deg]."""
    to_east, to_north = meters_per_degree(np.float64(lat.mean()))
    x, y = np.meshgrid((lon - lon.mean()) * to_east, (lat - lat.mean()) * to_north)
    time = 3600.0 * np.arange(times)
    u, v = np.moveaxis([swirls(x, y, each, shortest, speed) for each in time], 1, 0)
    return Grid(*np.meshgrid(lon, lat), time, u, v)


def bent(middle: tuple[float, float], cells: int, cell: float, times: int) -> Grid:
    """Hourly swirls along a grid as ROMS has it: turned, its rows bend, velocities are on the sides of its cells.

    Parameters
    ----------
    middle : longitude and latitude [deg]
    cells : rows and columns; cell : between them [m]
    """
    turn, bend = 0.6, 0.3  # [rad]
    i, j = np.meshgrid(np.arange(cells) - cells / 2, np.arange(cells) - cells / 2)
    a, r = bend * i / cells, cell * (cells / bend + j)  # rings around a point far below
    x, y = r * np.sin(a), r * np.cos(a) - cell * cells / bend
    x, y = x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)
    lat = middle[1] + y / meters_per_degree(np.float64(middle[1]))[1]
    lon = middle[0] + x / meters_per_degree(lat)[0]  # not a projection's: angles are what nodes say
    to_east, to_north = meters_per_degree(lat)
    angle = np.arctan2(np.gradient(lat, axis=1) * to_north, np.gradient(lon, axis=1) * to_east)
    time = 3600.0 * np.arange(times)
    east, north = np.moveaxis([swirls(x, y, each, 12 * cell, 0.5) for each in time], 1, 0)
    u, v = east * np.cos(angle) + north * np.sin(angle), north * np.cos(angle) - east * np.sin(angle)
    return Grid(lon, lat, time, (u[..., 1:] + u[..., :-1]) / 2, (v[:, 1:] + v[:, :-1]) / 2, angle)


def write(path: Path, grid: Grid) -> Path:
    """Write a grid as a CF NetCDF file: as Copernicus Marine does, or with an angle as ROMS."""
    import netCDF4

    with netCDF4.Dataset(path, "w") as dataset:
        if grid.angle is None:
            sizes = dict(zip(("time", "lat", "lon"), grid.u.shape, strict=True))
            over = {"uo": tuple(sizes), "vo": tuple(sizes)}
            axes: dict[str, Any] = {"lon": (("lon",), grid.lon[0]), "lat": (("lat",), grid.lat[:, 0])}
        else:
            rows, columns = grid.lon.shape
            sizes = {"time": len(grid.time), "eta_rho": rows, "xi_rho": columns}
            sizes |= {"eta_u": rows, "xi_u": columns - 1, "eta_v": rows - 1, "xi_v": columns}
            over = {"u": ("time", "eta_u", "xi_u"), "v": ("time", "eta_v", "xi_v")}
            rho = ("eta_rho", "xi_rho")
            axes = {"lon_rho": (rho, grid.lon), "lat_rho": (rho, grid.lat), "angle": (rho, grid.angle)}
        for name, size in sizes.items():
            dataset.createDimension(name, size)
        units = {"lon": "degrees_east", "lat": "degrees_north", "angle": "radians"}
        for name, (dimensions, values) in {"time": (("time",), grid.time / 3600.0), **axes}.items():
            variable = dataset.createVariable(name, "f8", dimensions)
            variable[:], variable.units = values, units.get(name.removesuffix("_rho"), HOURS)
        for (name, dimensions), values in zip(over.items(), (grid.u, grid.v), strict=True):
            variable = dataset.createVariable(name, "f4", dimensions, fill_value=np.float32(1e20))
            variable[:], variable.units = np.nan_to_num(values, nan=1e20), "m s-1"
    return path
