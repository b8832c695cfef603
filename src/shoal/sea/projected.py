"""Nodes of a grid that has axes of a map projection, and no longitude and latitude of its nodes."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import SeaError, reason_of
from shoal.core.geodesy import near, pyproj
from shoal.sea.components import text
from shoal.sea.curved import Found
from shoal.sea.window import Window, boundary, box

MARGIN = 3  # cells
METERS = {"m": 1.0, "meter": 1.0, "meters": 1.0, "metre": 1.0, "metres": 1.0, "km": 1000.0, "kilometer": 1000.0,
          "kilometre": 1000.0, "kilometers": 1000.0, "kilometres": 1000.0}  # fmt: skip
AXES = {
    "X": ("projection_x_coordinate", "grid_longitude", "x", "xc", "rlon"),
    "Y": ("projection_y_coordinate", "grid_latitude", "y", "yc", "rlat"),
}


def projected_nodes(dataset: Any, path: Path, shape: dict[str, int], variable: Any, window: Window) -> Found | None:
    """Return dimensions, rows and columns, and lon and lat (J, I) [deg], of the nodes around a window.

    None if the file names no projection, or has no axes of it.

    Raises
    ------
    SeaError : a projection or axes that cannot be read, or a window that is not inside
    """
    mapping = _mapping(dataset, variable)
    x, y = (_axis(dataset, shape, axis) for axis in ("X", "Y"))
    if mapping is None or x is None or y is None:
        return None
    try:
        crs = _crs(mapping)
        library = pyproj()
        to_grid = library.Transformer.from_crs(crs.geodetic_crs, crs, always_xy=True)
    except Exception as error:  # pyproj's own, of many kinds
        problem = f"names a projection that cannot be read ({reason_of(error)})"
        raise SeaError(f"{path} {mapping.name}", problem, "give longitude and latitude of each node, too") from error
    xs, columns = _rising(path, x)
    ys, rows = _rising(path, y)
    edge = to_grid.transform(*boundary(window.frame, window.half_x, window.half_y))
    parts = []
    for axis, values in ((xs, edge[0]), (ys, edge[1])):
        low, high = float(np.min(values)), float(np.max(values))
        if not (np.isfinite(low) and np.isfinite(high) and axis[0] - 1e-6 <= low and high <= axis[-1] + 1e-6):
            raise SeaError(
                str(path),
                f"does not cover the arena: {_covered(to_grid, xs, ys, window)}; the arena needs {window}",
                "move area.origin, make the area smaller, or give a file of these waters",
            )
        first = max(0, int(np.searchsorted(axis, low, "right")) - 1 - MARGIN)
        parts.append(slice(first, min(len(axis), int(np.searchsorted(axis, high, "left")) + MARGIN + 1)))
    i, j = parts
    lon, lat = to_grid.transform(*np.meshgrid(xs[i], ys[j]), direction="INVERSE")
    nodes = np.asarray(near(lon, window.middle)), np.asarray(lat)
    return (y.dimensions[0], x.dimensions[0]), rows[j], columns[i], *nodes


def _mapping(dataset: Any, variable: Any) -> Any:
    """The variable that describes the projection."""
    named = dataset.variables.get(text(variable, "grid_mapping").split(":")[0])
    others = [each for each in dataset.variables.values() if text(each, "grid_mapping_name")]
    return named if named is not None else others[0] if len(others) == 1 else None


def _crs(mapping: Any) -> Any:
    attributes = {name: mapping.getncattr(name) for name in mapping.ncattrs()}
    library = pyproj()
    for name in ("proj4", "proj4_params", "proj4_string"):
        if name in attributes:
            return library.CRS.from_user_input(str(attributes[name]))
    plain = {name: value.item() if getattr(value, "size", 0) == 1 else value for name, value in attributes.items()}
    return library.CRS.from_cf({name: list(v) if isinstance(v, np.ndarray) else v for name, v in plain.items()})


def _axis(dataset: Any, shape: dict[str, int], axis: str) -> Any:
    """The coordinate variable of an axis of the projection."""
    there = [
        dataset.variables[name] for name in shape if name in dataset.variables and dataset.variables[name].ndim == 1
    ]
    for each in there:
        if text(each, "standard_name") in AXES[axis] or text(each, "axis").upper() == axis:
            return each
    return next((each for each in there if each.name.lower() in AXES[axis]), None)


def _rising(path: Path, variable: Any) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """An axis [m] (of a rotated pole [deg]) that rises, and the index in the file of each of its nodes."""
    units = text(variable, "units").lower()
    scale = 1.0 if units.startswith("degree") else METERS.get(units)
    if scale is None:
        raise SeaError(f"{path} {variable.name}", f"has the units {units!r}, not m or km", "set its attribute units")
    values = np.asarray(np.ma.filled(np.ma.asarray(variable[...], np.float64), np.nan)) * scale
    index = np.arange(len(values))
    if len(values) > 1 and values[-1] < values[0]:
        values, index = values[::-1], index[::-1]
    if len(values) < 2 or not np.all(np.diff(values) > 0.0):
        raise SeaError(
            f"{path} {variable.name}", "neither rises nor falls all along", "sort its nodes, each of them once"
        )
    return values, index


def _covered(to_grid: Any, xs: NDArray[np.float64], ys: NDArray[np.float64], window: Window) -> str:
    lon, lat = to_grid.transform(*np.meshgrid(xs[[0, -1]], ys[[0, -1]]), direction="INVERSE")
    lon = near(lon, window.middle)
    return f"its corners are in {box(float(lon.min()), float(lon.max()), float(lat.min()), float(lat.max()))}"
