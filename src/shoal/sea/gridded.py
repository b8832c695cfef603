"""Currents or wind of a CF NetCDF file, around an arena and during a run, as the engine samples them."""

import hashlib
from dataclasses import dataclass, field
from datetime import UTC, datetime
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import SeaError
from shoal.core.geodesy import Frame
from shoal.sea.blocks import MOST_SPEED, read, read_speeds
from shoal.sea.components import GRID, TRUE, UNKNOWN, Components, components_of
from shoal.sea.fill import bridge_gaps, fill_fringe
from shoal.sea.grid import Nodes, nodes_of, outside
from shoal.sea.levels import fixed_levels
from shoal.sea.opened import from_netcdf
from shoal.sea.resample import FINER, metric_axis, spacing, weights_of
from shoal.sea.span import Span, span_of
from shoal.sea.turn import angles_of, unstaggered
from shoal.sea.window import Window, box, window_of

MOST_VALUES = 50_000_000  # of a component in the window: 200 MB
NEXT_TO_POLE = 89.99  # [deg]
QUANTITIES = ("currents", "wind")

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Gridded:
    """A field of velocities on a grid, known everywhere.

    Parameters
    ----------
    u, v : float32 (T, J, I) rates of change of the frame's x and y [m/s]: turned and stretched as `Frame.turned`
    time : float64 (T,) [s] since the start of the run, ascending; one of them: a steady field
    first, second : float64 (I,), (J,) ascending: longitude, continuous around the origin, and latitude [deg]; or,
        if metric, x and y [m]
    metric : resampled onto a local grid, as a file's grid that bends is
    land : bool (J, I) missing at all times, where u and v are those of the nearest sea, or 0 farther in
    notes : what was assumed
    digest : of what was read, wherever the file lies
    """

    u: NDArray[np.float32]
    v: NDArray[np.float32]
    time: NDArray[np.float64]
    first: NDArray[np.float64]
    second: NDArray[np.float64]
    metric: bool
    land: Mask
    notes: list[str] = field(default_factory=list)
    digest: str = ""


def read_gridded(
    path: str | PathLike[str],
    quantity: str,
    frame: Frame,
    half_x: float,
    half_y: float,
    start: datetime,
    duration: float,
) -> Gridded:
    """Return currents or wind around an arena during a run; no more of the file is read.

    Parameters
    ----------
    path : a NetCDF file that follows the CF conventions, or nearly
    quantity : "currents" or "wind"
    frame : local meters of the arena
    half_x, half_y : [m] half the sides of the arena, whose center is the frame's origin
    start : of the run; without a zone, UTC
    duration : of the run [s]

    Raises
    ------
    SeaError : the file cannot be used: absent, damaged, without the variables, units, axes or times needed, or it does
        not cover the arena and the run
    MissingExtraError : netCDF4 is not installed
    """
    if quantity not in QUANTITIES:
        raise ValueError(f"quantity is {quantity!r}; there are: {', '.join(QUANTITIES)}")
    begin = (start if start.tzinfo else start.replace(tzinfo=UTC)).timestamp()
    window = window_of(frame, half_x, half_y)
    return from_netcdf(Path(path), _gridded, quantity, window, begin, begin + duration)


def _gridded(dataset: Any, path: Path, quantity: str, window: Window, begin: float, end: float) -> Gridded:
    found = components_of(dataset, path, quantity)
    span = span_of(dataset, path, found.u, begin, end)
    centers = _centers(dataset, path, found, span)
    nodes = nodes_of(dataset, path, centers, found.u, window)
    notes = [*found.notes, *span.notes]
    u, v = _read(dataset, path, found, span, nodes, quantity, notes)
    digest = _digest(u, v, nodes, span.unix)
    if u.shape != v.shape:
        u, v = unstaggered(u, v)
        notes.append(f"Components on the sides of cells were averaged to their centers ({path.name}).")
    u, v = _masked(dataset, u, v, nodes)
    _turn(dataset, path, found, nodes, window.frame, u, v, notes)
    time = span.unix - begin
    unknown, share = bridge_gaps(u, v, time)
    if unknown.all():
        raise SeaError(
            str(path),
            f"holds no {quantity} in the arena: all values in {window} are missing",
            "move area.origin to where the file has values",
        )
    if share:
        notes.append(f"Gaps in time, {share:.1%} of the values at sea, were bridged linearly ({path.name}).")
    fill_fringe(u, v, unknown)
    axes, land = (nodes.lon, nodes.lat), unknown
    if not nodes.straight:
        u, v, axes, land = _resampled(path, u, v, nodes, unknown, window)
        notes.append(
            f"The grid of {path.name} was resampled to one of local meters, {np.diff(axes[0])[0]:.0f} m apart."
        )
    return Gridded(u, v, time, *axes, metric=not nodes.straight, land=land, notes=notes, digest=digest)


def _centers(dataset: Any, path: Path, found: Components, span: Span) -> dict[str, int]:
    """Dimensions that may be horizontal, with their sizes: of both components, or of the centers of their cells."""
    sizes = [
        {name: size for name, size in zip(each.dimensions, each.shape, strict=True) if name != span.dimension}
        for each in (found.u, found.v)
    ]
    if not found.staggered:
        return sizes[0]
    (rows_u, columns_u), (rows_v, columns_v) = (each.shape[-2:] for each in (found.u, found.v))
    if (rows_u - rows_v, columns_v - columns_u) == (1, 1):
        for name in ("lon_rho", *dataset.variables):
            there = dataset.variables.get(name)
            if there is not None and there.ndim == 2 and there.shape == (rows_u, columns_v):
                return dict(zip(there.dimensions, there.shape, strict=True))
    described = " and ".join(f"{each.name}({', '.join(each.dimensions)})" for each in (found.u, found.v))
    raise SeaError(
        str(path),
        f"{described} are on different grids, and there are no longitudes and latitudes of the centers between them",
        "add lon_rho and lat_rho, or interpolate both to one grid first",
    )


def _read(
    dataset: Any, path: Path, found: Components, span: Span, nodes: Nodes, quantity: str, notes: list[str]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Both components as the file has them [m/s] (T, J, I); on sides of cells, there are fewer of them."""
    values = len(span.index) * len(nodes.rows) * len(nodes.columns)
    if values > MOST_VALUES:
        raise SeaError(
            str(path),
            f"has {values:.3g} values in the arena during the run, more than {MOST_VALUES:.3g}",
            "make the area smaller, or take fewer steps",
        )
    marks, both = 0, []
    for variable, scale, cut in ((found.u, found.scale_u, (0, 1)), (found.v, found.scale_v, (1, 0))):
        rows, columns = nodes.rows, nodes.columns
        over = nodes.dimensions
        if found.staggered:
            over = variable.dimensions[-2:]
            rows, columns = rows[: len(rows) - cut[0]], columns[: len(columns) - cut[1]]
        needed = {*over, span.dimension} - {""}
        if not needed <= set(variable.dimensions) or len(set(variable.dimensions)) < variable.ndim:
            described = " and ".join(f"{each.name}({', '.join(each.dimensions)})" for each in (found.u, found.v))
            raise SeaError(str(path), f"{described} are not on one grid, at the same times", "export both alike")
        fixed, said = fixed_levels(dataset, path, variable, {span.dimension, *over}, quantity)
        at = {**fixed, span.dimension: span.index, over[0]: rows, over[1]: columns}
        field_, missing = read_speeds(variable, at, (span.dimension, *over), scale)
        both.append(field_)
        marks += missing
        notes += [note for note in said if variable is found.u]
    if marks:
        notes.append(f"{marks} values faster than {MOST_SPEED:g} m/s were taken as missing ({path.name}).")
    return both[0], both[1]


def _masked(
    dataset: Any, u: NDArray[np.float32], v: NDArray[np.float32], nodes: Nodes
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Both missing where one is, or where the file's own mask of the grid says land (ROMS)."""
    missing = ~(np.isfinite(u) & np.isfinite(v))
    mask = dataset.variables.get("mask_rho")
    if mask is not None and mask.dimensions == nodes.dimensions:
        sea = read(mask, dict(zip(nodes.dimensions, (nodes.rows, nodes.columns), strict=True)))
        missing |= ~(sea > 0.0)
    u[missing], v[missing] = np.nan, np.nan
    return u, v


def _turn(
    dataset: Any,
    path: Path,
    found: Components,
    nodes: Nodes,
    frame: Frame,
    u: NDArray[np.float32],
    v: NDArray[np.float32],
    notes: list[str],
) -> None:
    """Turn both components in place into the frame."""
    lon, lat = np.meshgrid(nodes.lon, nodes.lat) if nodes.straight else (nodes.lon, nodes.lat)
    known = np.isfinite(lon) & np.isfinite(lat)
    lon, lat = np.where(known, lon, frame.origin[0]), np.where(known, lat, frame.origin[1])
    lat = np.clip(lat, -NEXT_TO_POLE, NEXT_TO_POLE)  # at the pole itself, east is nowhere
    a, b, c, d = frame.turn(lon, lat)
    if found.along != TRUE:
        if found.along == UNKNOWN and not (nodes.straight or found.staggered or "angle" in dataset.variables):
            raise SeaError(
                f"{path} {found.u.name}",
                "says neither that it points east nor that it points along the rows of its grid, which bends",
                "set standard_name: eastward_sea_water_velocity or sea_water_x_velocity; eastward_wind or x_wind",
            )
        if found.along == GRID or not nodes.straight:
            angle, how = angles_of(dataset, path, nodes)
            cos, sin = np.where(known, np.cos(angle), 1.0), np.where(known, np.sin(angle), 0.0)
            a, b, c, d = a * cos + b * sin, b * cos - a * sin, c * cos + d * sin, d * cos - c * sin
            notes += [f"{found.u.name} and {found.v.name} were turned to the east and north {how}."] if how else []
    for k in range(len(u)):
        u[k], v[k] = a * u[k] + b * v[k], c * u[k] + d * v[k]


def _resampled(
    path: Path, u: NDArray[np.float32], v: NDArray[np.float32], nodes: Nodes, unknown: Mask, window: Window
) -> tuple[NDArray[np.float32], NDArray[np.float32], tuple[NDArray[np.float64], NDArray[np.float64]], Mask]:
    """Components, axes and land on a grid of local meters."""
    x, y = window.frame.local(nodes.lon, nodes.lat)
    x, y = np.where(np.isfinite(x), x, np.nan), np.where(np.isfinite(y), y, np.nan)
    cell = spacing(x, y)
    most = MOST_VALUES / (len(u) * 4.0 * window.half_x * window.half_y / cell**2)
    cell /= np.clip(np.sqrt(most), 1.0, FINER)
    axes = metric_axis(window.half_x, cell), metric_axis(window.half_y, cell)
    at_x, at_y = (each.ravel() for each in np.meshgrid(*axes))
    found = weights_of(x, y, at_x, at_y, unknown)
    arena = (np.abs(at_x) <= window.half_x * (1 + 1e-9)) & (np.abs(at_y) <= window.half_y * (1 + 1e-9))
    if not found.covered[arena].all():
        lon, lat = nodes.lon, nodes.lat
        covered = box(*(float(each) for each in (np.nanmin(lon), np.nanmax(lon), np.nanmin(lat), np.nanmax(lat))))
        raise outside(
            path, window, f"{covered} near it, and {(~found.covered[arena]).mean():.0%} of the arena is beyond"
        )
    shape = len(axes[1]), len(axes[0])
    fields = []
    for values in (u, v):
        flat = values.reshape(len(values), -1)
        result = np.empty((len(values), len(at_x)), np.float32)
        for k, each in enumerate(flat):
            result[k] = (found.weights * each[found.corners]).sum(axis=0)
        fields.append(result.reshape(-1, *shape))
    return fields[0], fields[1], axes, (found.covered & ~found.sea).reshape(shape)


def _digest(u: NDArray[np.float32], v: NDArray[np.float32], nodes: Nodes, unix: NDArray[np.float64]) -> str:
    digest = hashlib.sha256()
    for part in (u, v):
        digest.update(np.where(np.isfinite(part), part, np.float32(np.nan)).astype("<f4").tobytes())
    for axis in (nodes.lon, nodes.lat, unix):
        digest.update(np.round(axis, 9).astype("<f8").tobytes())
    return digest.hexdigest()
