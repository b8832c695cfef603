"""Where the nodes of a grid are, and which of them a window needs."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import SeaError
from shoal.core.geodesy import near
from shoal.sea.components import text
from shoal.sea.curved import curved_nodes
from shoal.sea.projected import projected_nodes
from shoal.sea.window import Window, box

Axis = tuple[NDArray[np.float64], NDArray[np.intp]]  # nodes [deg] and their indices in the file

MARGIN = 2  # cells beyond the arena, where the file has them
SAME = 1e-3  # cells: longitudes of a column that differ by less are one
LAT = (("latitude",), ("degrees_north", "degree_north", "degree_n", "degrees_n", "degreen", "degreesn"),
       ("lat", "latitude", "nav_lat", "lat_rho", "y_lat", "xlat", "tlat", "gphit"))  # fmt: skip
LON = (("longitude",), ("degrees_east", "degree_east", "degree_e", "degrees_e", "degreee", "degreese"),
       ("lon", "longitude", "nav_lon", "lon_rho", "x_lon", "xlong", "xlon", "tlon", "glamt"))  # fmt: skip


@dataclass(frozen=True)
class Nodes:
    """The nodes that a window needs.

    Parameters
    ----------
    dimensions : of rows and columns in the file
    rows, columns : (J,), (I,) their indices in the file
    lon, lat : [deg] (I,) and (J,) ascending where `straight`; else (J, I)
    """

    dimensions: tuple[str, str]
    rows: NDArray[np.intp]
    columns: NDArray[np.intp]
    lon: NDArray[np.float64]
    lat: NDArray[np.float64]
    straight: bool


def nodes_of(dataset: Any, path: Path, shape: dict[str, int], variable: Any, window: Window) -> Nodes:
    """Return the nodes of the grid around a window.

    Parameters
    ----------
    shape : dimensions, with their sizes, that may be horizontal: of the variable, or of the center of its cells
    variable : whose grid it is

    Raises
    ------
    SeaError : no coordinates; axes that do not rise or fall; a window that is not inside
    """
    lat, lon = (_coordinate(dataset, variable, shape, known) for known in (LAT, LON))
    if lat is None or lon is None:
        found = projected_nodes(dataset, path, shape, variable, window)
        if found is None:
            raise SeaError(
                f"{path} {variable.name}",
                f"has no longitude and latitude for its dimensions {', '.join(variable.dimensions)}",
                "add coordinates with units degrees_east and degrees_north, or projection axes with a grid_mapping",
            )
        return Nodes(*found, straight=False)
    if lat.ndim == lon.ndim == 1 and lat.dimensions != lon.dimensions:
        return _straight_nodes(path, lat, lon, window)
    if lat.dimensions != lon.dimensions or lat.ndim != 2:
        described = ", ".join(f"{each.name}({', '.join(each.dimensions)})" for each in (lon, lat))
        problem = f"{described} are not a grid of rows and columns"
        raise SeaError(
            str(path), problem, "interpolate to a grid of longitudes and latitudes first, as with cdo remapbil"
        )
    dimensions, rows, columns, lons, lats = curved_nodes(path, lat, lon, window)
    if set(dimensions) <= set(variable.dimensions) and _is_straight(lons) and _is_straight(lats.T):
        return _kept_nodes(path, dimensions, _rising(lats[:, 0], rows), _rising(lons[0], columns), window)
    return Nodes(dimensions, rows, columns, lons, lats, straight=False)


def _coordinate(dataset: Any, variable: Any, shape: dict[str, int], known: Any) -> Any:
    """The coordinate of a variable most like latitude, or longitude."""
    standard_names, units, names = known
    listed = text(variable, "coordinates").split()

    def likeness(each: Any) -> int:
        said = text(each, "standard_name").lower()
        is_one = (
            said in standard_names
            or text(each, "units").lower().replace(" ", "_") in units
            or each.name.lower() in names
        )
        other = bool(said) and said not in standard_names and not each.name.lower().startswith(names)
        return 0 if other or not is_one else 1 + 4 * (each.name in listed) + 2 * (each.name in shape)

    there = [
        each
        for each in dataset.variables.values()
        if each.ndim in (1, 2)
        and set(each.dimensions) <= set(shape)
        and each.dtype is not str
        and each.dtype.kind in "iuf"
    ]
    best = max(there, key=likeness, default=None)
    return best if best is not None and likeness(best) else None


def _straight_nodes(path: Path, lat: Any, lon: Any, window: Window) -> Nodes:
    """Of a grid with a longitude for each column, and a latitude for each row."""
    lats, rows = _axis(path, lat)
    lons, columns = _axis(path, lon)
    lons, columns = _around(lons, columns, window.middle)
    if np.abs(lats).max() > 90.0 + 1e-6:
        raise SeaError(f"{path} {lat.name}", "is beyond 90 degrees", "give latitudes in degrees")
    return _kept_nodes(path, (lat.dimensions[0], lon.dimensions[0]), (lats, rows), (lons, columns), window)


def _kept_nodes(path: Path, dimensions: tuple[str, str], second: Axis, first: Axis, window: Window) -> Nodes:
    """The nodes of rising axes that a window needs, if it is inside."""
    (lats, rows), (lons, columns) = second, first
    inside_east = lons[0] - 1e-9 <= window.west and window.east <= lons[-1] + 1e-9
    inside_north = lats[0] - 1e-9 <= window.south and window.north <= lats[-1] + 1e-9
    if not (inside_east and inside_north):
        raise outside(path, window, box(lons[0], lons[-1], lats[0], lats[-1]))
    i, j = _kept(lons, window.west, window.east), _kept(lats, window.south, window.north)
    return Nodes(dimensions, rows[j], columns[i], lons[i], lats[j], straight=True)


def _is_straight(values: NDArray[np.float64]) -> bool:
    """Whether each column (J, I) is at one longitude, and columns rise or fall."""
    steps = np.diff(values[0])
    if not (np.isfinite(values).all() and ((steps > 0.0).all() or (steps < 0.0).all())):
        return False
    return bool(np.ptp(values, axis=0).max() <= SAME * np.abs(steps).min())


def _rising(values: NDArray[np.float64], index: NDArray[np.intp]) -> Axis:
    return (values, index) if values[-1] > values[0] else (values[::-1], index[::-1])


def outside(path: Path, window: Window, covered: str) -> SeaError:
    """Return the error that a file does not cover the arena; both boxes are in it."""
    return SeaError(
        str(path),
        f"does not cover the arena: it has {covered}; the arena needs {window}",
        "move area.origin, make the area smaller, or give a file of these waters",
    )


def _axis(path: Path, variable: Any) -> Axis:
    """An axis [deg] that rises, and the index in the file of each of its nodes."""
    values = np.ma.filled(np.ma.masked_invalid(np.ma.asarray(variable[...], np.float64)), np.nan)
    if "radian" in text(variable, "units"):
        values = np.degrees(values)
    if len(values) < 2:
        raise SeaError(f"{path} {variable.name}", "has fewer than 2 nodes", "give a file that is wider than one cell")
    if not np.isfinite(values).all():
        raise SeaError(f"{path} {variable.name}", "has missing values", "export the file again")
    values, index = _rising(np.unwrap(values, period=360.0), np.arange(len(values)))
    if not np.all(np.diff(values) > 0.0):
        raise SeaError(
            f"{path} {variable.name}", "neither rises nor falls all along", "sort its nodes, each of them once"
        )
    return values, index


def _around(
    lons: NDArray[np.float64], columns: NDArray[np.intp], middle: float
) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Longitudes shifted to lie around `middle`; those of the whole Earth begin and end opposite to it."""
    if lons[-1] - lons[0] + 1.5 * np.diff(lons).max() < 360.0:
        center = (lons[0] + lons[-1]) / 2.0
        return lons + float(near(center, middle)) - center, columns
    turned = near(lons, middle)
    order = np.argsort(turned, kind="stable")
    turned = turned[order]
    new = np.concatenate(([True], np.diff(turned) > 1e-6))  # 0 and 360 may both be there
    return turned[new], columns[order][new]


def _kept(axis: NDArray[np.float64], low: float, high: float) -> slice:
    """The nodes around low to high, with a margin."""
    first = int(np.searchsorted(axis, low, "right")) - 1 - MARGIN
    last = int(np.searchsorted(axis, high, "left")) + MARGIN
    return slice(max(0, first), min(len(axis), last + 1))
