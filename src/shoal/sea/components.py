"""The two variables of a file that are the components of currents, or of wind."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from shoal.core.errors import SeaError
from shoal.core.text import cut

TRUE, GRID, UNKNOWN = "true", "grid", "unknown"  # components to the east and north; along the axes of the grid

STANDARD_NAMES = {
    "currents": (
        ("eastward_sea_water_velocity", "northward_sea_water_velocity", TRUE),
        ("surface_eastward_sea_water_velocity", "surface_northward_sea_water_velocity", TRUE),
        ("sea_water_x_velocity", "sea_water_y_velocity", GRID),
        ("x_sea_water_velocity", "y_sea_water_velocity", GRID),
        ("surface_sea_water_x_velocity", "surface_sea_water_y_velocity", GRID),
        ("eastward_sea_water_velocity_assuming_no_tide", "northward_sea_water_velocity_assuming_no_tide", TRUE),
        ("surface_geostrophic_eastward_sea_water_velocity", "surface_geostrophic_northward_sea_water_velocity", TRUE),
        ("barotropic_eastward_sea_water_velocity", "barotropic_northward_sea_water_velocity", TRUE),
        ("barotropic_sea_water_x_velocity", "barotropic_sea_water_y_velocity", GRID),
    ),
    "wind": (
        ("eastward_wind", "northward_wind", TRUE),
        ("x_wind", "y_wind", GRID),
        ("grid_eastward_wind", "grid_northward_wind", GRID),
    ),
}
NAMES = {
    "currents": (
        ("u_eastward", "v_northward", TRUE),
        ("uo", "vo", UNKNOWN), ("utotal", "vtotal", UNKNOWN), ("water_u", "water_v", TRUE), ("u", "v", UNKNOWN),
        ("u_surf", "v_surf", UNKNOWN), ("ssu", "ssv", UNKNOWN), ("ucur", "vcur", UNKNOWN), ("uvel", "vvel", UNKNOWN),
        ("u_vel", "v_vel", UNKNOWN), ("u_velocity", "v_velocity", UNKNOWN), ("ewct", "nsct", TRUE),
        ("u_sur", "v_sur", UNKNOWN), ("u_rho", "v_rho", UNKNOWN), ("vozocrtx", "vomecrty", GRID),
        ("ubar", "vbar", UNKNOWN),
        ("current_u", "current_v", UNKNOWN), ("east", "north", TRUE), ("ugos", "vgos", TRUE),
    ),
    "wind": (
        ("u10", "v10", UNKNOWN), ("u10m", "v10m", UNKNOWN), ("10u", "10v", UNKNOWN), ("x_wind_10m", "y_wind_10m", GRID),
        ("uwnd", "vwnd", UNKNOWN), ("uwind", "vwind", UNKNOWN), ("u_wind", "v_wind", UNKNOWN),
        ("wind_u", "wind_v", UNKNOWN), ("ugrd10m", "vgrd10m", UNKNOWN),
        ("ugrd_10maboveground", "vgrd_10maboveground", UNKNOWN), ("u", "v", UNKNOWN),
    ),
}  # fmt: skip
MEDIUM = {"currents": "water", "wind": "wind"}  # what a standard_name says that is of the quantity
OTHER_DEPTH = re.compile(r"bottom|floor|err|std|stokes|ice|tide_", re.IGNORECASE)
PARTIAL = re.compile(r"barotropic|geostrophic|no_tide|^ubar$|^ugos$", re.IGNORECASE)
METERS_PER_SECOND = {
    "m/s": 1.0, "ms-1": 1.0, "ms^-1": 1.0, "ms**-1": 1.0, "cm/s": 0.01, "cms-1": 0.01, "cms^-1": 0.01,
    "cms**-1": 0.01, "mm/s": 0.001, "mms-1": 0.001, "km/h": 1 / 3.6, "kmh-1": 1 / 3.6,
    "kn": 1852 / 3600, "kt": 1852 / 3600, "kts": 1852 / 3600, "knot": 1852 / 3600, "knots": 1852 / 3600,
}  # fmt: skip
WORDS = (("centi", "c"), ("kilo", "k"), ("milli", "m"), ("met(er|re)s?", "m"), ("seconds?|secs?", "s"), ("hours?", "h"))


@dataclass(frozen=True)
class Components:
    """Two variables of an open file, what turns them into m/s, and along what they point."""

    u: Any
    v: Any
    scale_u: float
    scale_v: float
    along: str

    @property
    def staggered(self) -> bool:
        """Whether they are on the sides of cells, each on its own: an Arakawa C grid."""
        u, v = self.u.dimensions, self.v.dimensions
        return set(u) != set(v) and u[-2:] != v[-2:]

    @property
    def notes(self) -> list[str]:
        """That they are less than the current at the surface, where they are."""
        said = text(self.u, "standard_name") or self.u.name
        return [f"{self.u.name} is {said}, not all of the current at the surface."] if PARTIAL.search(said) else []


def components_of(dataset: Any, path: Path, quantity: str) -> Components:
    """Return the variables of "currents" or "wind": by standard_name, true directions first, then by usual names.

    Raises
    ------
    SeaError : there is no such pair; lists what there is; or its units are not those of a speed
    """
    numeric = {
        name: variable
        for name, variable in dataset.variables.items()
        if variable.dtype is not str and variable.dtype.kind in "iuf" and variable.ndim >= 2
    }
    u, v, along = _pair(numeric, path, quantity, dataset)
    return Components(u, v, _scale(path, u), _scale(path, v), along)


def text(variable: Any, attribute: str) -> str:
    """Return an attribute of a variable as text, empty if there is none."""
    return str(getattr(variable, attribute, "")).strip()


def meters_per_second(units: str) -> float | None:
    """Return how many m/s a unit is, None of a unit of anything else."""
    plain = units.lower()
    for word, short in WORDS:
        plain = re.sub(word, short, plain)
    plain = re.sub(r"[\s.·]", "", plain).replace("per", "/")
    return METERS_PER_SECOND.get(plain)


def _pair(numeric: dict[str, Any], path: Path, quantity: str, dataset: Any) -> tuple[Any, Any, str]:
    half = []
    for first, second, along in STANDARD_NAMES[quantity]:
        u, v = (_with_standard_name(numeric, name, quantity) for name in (first, second))
        if u is not None and v is not None:
            return u, v, along
        half += [(each.name, missing) for each, missing in ((u, second), (v, first)) if each is not None]
    lower = {name.lower(): each for name, each in reversed(numeric.items()) if _may_be(each, quantity)}
    for first, second, along in NAMES[quantity]:
        if first in lower and second in lower:
            return lower[first], lower[second], along
        half += [(lower[a].name, b) for a, b in ((first, second), (second, first)) if a in lower]
    wanted = " and ".join(STANDARD_NAMES[quantity][0][:2])
    has = ", ".join(dataset.variables) or "no variables"
    also = f"; {half[0][0]} is there, but no {half[0][1]}" if half else ""
    raise SeaError(
        str(path),
        f"holds no {quantity}: no variables with standard_name {wanted}{also}; it has {cut(has, 400)}",
        "set these standard_name attributes on the right variables, or give another file",
    )


def _with_standard_name(numeric: dict[str, Any], standard_name: str, quantity: str) -> Any:
    """The best variable of a standard_name: not one of the bottom, first one of a usual name."""
    usual = [name for first, second, _ in NAMES[quantity] for name in (first, second)]
    found = [
        each
        for each in numeric.values()
        if text(each, "standard_name").lower() == standard_name and not OTHER_DEPTH.search(each.name)
    ]
    return min(found, key=lambda each: each.name.lower() not in usual, default=None)


def _may_be(variable: Any, quantity: str) -> bool:
    """Whether nothing says that a variable is of another quantity."""
    said = text(variable, "standard_name").lower()
    return said in ("", "unknown", "none") or MEDIUM[quantity] in said


def _scale(path: Path, variable: Any) -> float:
    units = text(variable, "units")
    scale = meters_per_second(units)
    if scale is None:
        problem = f"has the units {units!r}, which are not of a speed" if units else "has no units"
        raise SeaError(
            f"{path} {variable.name}", problem, "set the attribute units = 'm s-1', if it is in meters per second"
        )
    return scale
