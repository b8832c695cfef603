"""The level of a variable that is taken: the sea's surface, or the wind that is nearest to 10 m."""

from pathlib import Path
from typing import Any

import numpy as np

from shoal.core.errors import SeaError
from shoal.sea.components import text

WIND_HEIGHT = 10.0  # [m]
PRESSURES = ("pa", "hpa", "mb", "mbar", "millibar", "millibars", "kpa")
VERTICAL = ("depth", "height", "altitude", "ocean_s_coordinate", "ocean_sigma", "air_pressure", "model_level_number")
LEVEL_NAMES = ("depth", "deptht", "depthu", "depthv", "lev", "level", "levels", "z", "s_rho", "sigma", "siglay", "plev",
               "height", "pressure_level", "isobaric", "layer")  # fmt: skip


def fixed_levels(
    dataset: Any, path: Path, variable: Any, free: set[str], quantity: str
) -> tuple[dict[str, int], list[str]]:
    """Return the index along every dimension but the free ones, and what was assumed.

    Parameters
    ----------
    free : dimensions of time, rows and columns

    Raises
    ------
    SeaError : a dimension that is not of depth or height has several indices
    """
    fixed, notes = {}, []
    for name, size in zip(variable.dimensions, variable.shape, strict=True):
        if name in free:
            continue
        if size == 0:
            raise SeaError(f"{path} {variable.name}", f"is empty along {name}", "give a file with values")
        if size == 1:
            fixed[name] = 0
            continue
        coordinate = dataset.variables.get(name)
        if not _is_vertical(name, coordinate):
            raise SeaError(
                f"{path} {variable.name}",
                f"has {size} indices along {name!r}, which is neither time nor depth nor a horizontal axis",
                f"keep one of them: ncks -d {name},0 FILE.nc ONE.nc",
            )
        fixed[name], note = _level(name, size, coordinate, quantity)
        notes.append(f"Of {size} levels of {variable.name}, {note} was taken.")
    return fixed, notes


def _is_vertical(name: str, coordinate: Any) -> bool:
    if name.lower() in LEVEL_NAMES or name.lower().startswith(("s_", "sigma", "depth", "height", "lev")):
        return True
    if coordinate is None:
        return False
    said = text(coordinate, "standard_name")
    return text(coordinate, "axis").upper() == "Z" or bool(text(coordinate, "positive")) or said.startswith(VERTICAL)


def _level(name: str, size: int, coordinate: Any, quantity: str) -> tuple[int, str]:
    """The index nearest to the surface, or to 10 m of height, and its name in words."""
    if coordinate is None or coordinate.dimensions != (name,) or coordinate.dtype is str:
        last = name.lower().startswith("s_")  # of ROMS: from the bottom up
        return (size - 1 if last else 0), f"the {'last' if last else 'first'} ({name} says no depths)"
    values = np.ma.filled(np.ma.masked_invalid(np.ma.asarray(coordinate[...], np.float64)), np.inf)
    units = text(coordinate, "units")
    if quantity == "wind" and units.lower() in PRESSURES:
        index = int(np.argmax(np.where(np.isfinite(values), values, -np.inf)))
    else:
        index = int(np.argmin(np.abs(np.abs(values) - (WIND_HEIGHT if quantity == "wind" else 0.0))))
    return index, f"{name} = {values[index]:g} {units}".rstrip()
