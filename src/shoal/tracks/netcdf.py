"""Fixes of a NetCDF file: CF trajectories, single, rectangular, ragged or indexed."""

import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from shoal.core.cf_time import unix_of
from shoal.core.crash import is_safe
from shoal.core.errors import MissingExtraError, ShoalError, TrackError
from shoal.tracks import names
from shoal.tracks.names import LAT_NAMES, LON_NAMES, TIME_NAMES
from shoal.tracks.table import Table, comparable, labels
from shoal.tracks.wanted import Wanted

if TYPE_CHECKING:
    import netCDF4

ROW_SIZE_NAMES = ("row_size", "rowsize")


def netcdf_table(path: Path, wanted: Wanted) -> Table:
    """Return the fixes of every trajectory of a CF file; a trajectory has an index and may have an id.

    Raises
    ------
    TrackError : it holds no trajectories, or times that cannot be decoded
    MissingExtraError : netCDF4 is not installed
    """
    _netcdf4()
    if not is_safe(_read, path, wanted):
        raise TrackError(str(path), "is damaged: the NetCDF library fails on it", "export it again")
    try:
        return _read(path, wanted)
    except (ShoalError, OSError):
        raise
    except Exception as error:  # what netCDF4 raises on a damaged file has no common class
        raise TrackError(str(path), f"cannot be read ({error})", "export it again") from error


def _read(path: Path, wanted: Wanted) -> Table:
    netcdf4 = _netcdf4()
    with warnings.catch_warnings(), netcdf4.Dataset(path) as dataset:
        warnings.simplefilter("ignore")  # netCDF4's own, of attributes that it does not use
        return _trajectories(path, netcdf4, dataset, wanted)


def _trajectories(path: Path, netcdf4: Any, dataset: "netCDF4.Dataset", wanted: Wanted) -> Table:
    lat = _variable(path, dataset, "latitude", LAT_NAMES, ("degree_north", "degrees_north"))
    lon = _variable(path, dataset, "longitude", LON_NAMES, ("degree_east", "degrees_east"))
    time = _variable(path, dataset, "time", TIME_NAMES, (" since ",))
    _check_dimensions(path, lat, lon, time)
    values = (_decoded_time(path, time), lat[...], lon[...])
    if lat.ndim == 1:
        owner, dimension = _ragged_owner(path, dataset, lat)
    else:
        dimension = _trajectory_dimension(dataset, lat, time)
        values = _by_trajectory(values, lat.dimensions.index(dimension))
        owner = np.indices(values[1].shape)[0].ravel()
    owner, id_name, ids = _ids(netcdf4, dataset, owner, dimension)
    return _table(path, values, owner, id_name, ids, wanted)


def _netcdf4() -> Any:
    try:
        import netCDF4
    except ImportError as error:
        raise MissingExtraError.of("netCDF4", "xarray", "reading a NetCDF track") from error
    return netCDF4


def _variable(
    path: Path, dataset: "netCDF4.Dataset", standard_name: str, known: Sequence[str],
    units: Sequence[str],
) -> Any:  # fmt: skip
    """The numeric variable most like `standard_name`, by standard_name, name and units."""

    def likeness(variable: Any) -> int:
        has_units = any(unit in _text(variable, "units").lower() for unit in units)
        has_standard_name = _text(variable, "standard_name") == standard_name
        return 4 * has_standard_name + 2 * (names.plain(variable.name) in known) + has_units

    there = dataset.variables
    numeric = [v for v in there.values() if v.dtype is not str and v.dtype.kind in "iuf"]
    best = max(numeric, key=likeness, default=None)
    if best is None or not likeness(best):
        raise TrackError(
            str(path),
            f"no numeric variable with standard_name {standard_name}; it has {', '.join(there)}",
            f"set the attribute standard_name = '{standard_name}' on the right one",
        )
    return best


def _text(variable: Any, attribute: str) -> str:
    return str(getattr(variable, attribute, ""))


def _check_dimensions(path: Path, lat: Any, lon: Any, time: Any) -> None:
    over = lat.dimensions
    shared = time.dimensions == over or (len(over) == 2 and time.dimensions in ((d,) for d in over))
    if lon.dimensions != over or not shared or len(over) not in (1, 2):
        described = ", ".join(f"{v.name}({', '.join(v.dimensions)})" for v in (lat, lon, time))
        raise TrackError(
            str(path),
            f"{described} is not a trajectory; is it a grid?",
            "store CF trajectories: lat, lon and time over (obs) or (trajectory, obs)",
        )


def _decoded_time(path: Path, variable: Any) -> Any:
    """Unix time [s], masked where missing."""
    try:
        return unix_of(variable[...], _text(variable, "units"), _text(variable, "calendar"))
    except ValueError as error:
        raise TrackError(f"{path} {variable.name}", *error.args) from error


def _ragged_owner(path: Path, dataset: "netCDF4.Dataset", lat: Any) -> tuple[NDArray[np.intp] | None, str]:
    """Whose each fix is, None if nothing says so, and the dimension that counts trajectories.

    Contiguous: a variable with `sample_dimension` counts the fixes of each trajectory.
    Indexed: a variable with `instance_dimension` gives each fix the index of its trajectory.
    """
    (obs,) = lat.dimensions
    for variable in dataset.variables.values():
        if _text(variable, "instance_dimension") and variable.dimensions == (obs,):
            owner = np.ma.filled(variable[...], -1).astype(np.intp)
            dimension = _text(variable, "instance_dimension")
            count = len(dataset.dimensions[dimension]) if dimension in dataset.dimensions else 0
            if owner.min(initial=0) < 0 or owner.max(initial=-1) >= count:
                raise TrackError(
                    f"{path} {variable.name}",
                    f"an index lies outside the {count} trajectories of {dimension!r}",
                    "store indices from 0 to the number of trajectories - 1",
                )
            return owner, dimension
        if _text(variable, "sample_dimension") == obs or variable.name.lower() in ROW_SIZE_NAMES:
            sizes = np.ma.filled(np.ma.atleast_1d(variable[...]), 0).astype(np.intp)
            if sizes.sum() != lat.size or sizes.min(initial=0) < 0:
                raise TrackError(
                    f"{path} {variable.name}",
                    f"its sum is {sizes.sum()}, but there are {lat.size} fixes",
                    "store the number of fixes of each trajectory",
                )
            return np.repeat(np.arange(len(sizes)), sizes), (*variable.dimensions, obs)[0]
    return None, obs


def _trajectory_dimension(dataset: "netCDF4.Dataset", lat: Any, time: Any) -> str:
    first, second = lat.dimensions
    if time.ndim == 1:
        return str(second if time.dimensions == (first,) else first)
    ids = _id_variables(dataset)
    return str(second if any(v.dimensions[:1] == (second,) for v in ids) else first)


def _by_trajectory(values: tuple[Any, Any, Any], axis: int) -> tuple[Any, Any, Any]:
    """time, lat and lon over (trajectory, obs); a shared 1-D time is repeated."""
    time, lat, lon = (value.T if axis == 1 else value for value in values)
    return time + np.zeros(lat.shape), lat, lon


def _id_variables(dataset: "netCDF4.Dataset") -> list[Any]:
    there = list(dataset.variables.values())
    ranked = [(rank, v) for v in there if (rank := names.rank(v.name)) is not None]
    named = [v for _, v in sorted(ranked, key=lambda each: each[0])]
    return [v for v in there if _text(v, "cf_role") == "trajectory_id"] + named


def _ids(
    netcdf4: Any, dataset: "netCDF4.Dataset", owner: NDArray[np.intp] | None, dimension: str
) -> tuple[NDArray[np.intp], str, list[str]]:
    """Whose each fix is, the name of the identifiers and the identifier of each trajectory."""
    length = len(dataset.dimensions[dimension])
    single = owner is None
    for variable in _id_variables(dataset):
        ids = _id_texts(netcdf4, variable, dimension)
        if variable.dimensions[:1] == (dimension,):
            if owner is None:  # a flat table: an identifier beside each fix
                index = {text: i for i, text in enumerate(dict.fromkeys(ids))}
                return np.array([index[text] for text in ids]), variable.name, list(index)
            return owner, variable.name, ids
        if single and len(ids) == 1:
            return np.zeros(length, dtype=np.intp), variable.name, ids
    if owner is None:
        return np.zeros(length, dtype=np.intp), "trajectory", ["0"]
    return owner, "trajectory", [str(i) for i in range(length)]


def _id_texts(netcdf4: Any, variable: Any, dimension: str) -> list[str]:
    values = np.ma.filled(variable[...]) if variable.dtype is not str else variable[...]
    values = np.asarray(values)
    if values.dtype == "S1" and values.ndim and variable.dimensions[-1] != dimension:
        values = netcdf4.chartostring(values)
    texts = values.astype(str) if values.dtype.kind == "S" else values
    return [str(text).strip("\0 ") for text in np.atleast_1d(texts).ravel()]


def _table(
    path: Path, values: tuple[Any, Any, Any], owner: NDArray[np.intp], id_name: str, ids: list[str], wanted: Wanted
) -> Table:
    """All fixes but those that only fill up a row."""
    shape = values[1].shape
    time, lat, lon = map(_with_nan, values)
    fixes = np.flatnonzero(~(np.isnan(time) & np.isnan(lat) & np.isnan(lon)))

    def place(index: int) -> str:
        return f"{path}[{', '.join(str(k) for k in np.unravel_index(index, shape))}]"

    named, own = _labels(ids, wanted), owner[fixes].tolist()
    by_name = {id_name: labels(ids[i] for i in own), "trajectory": labels(named[i] for i in own)}
    return Table(
        columns=list(dict.fromkeys(("trajectory", id_name))),
        time=time[fixes],
        lat=lat[fixes],
        lon=lon[fixes],
        line=fixes,
        labels=by_name,
        place=place,
        identifiers=(id_name,),
    )


def _with_nan(values: Any) -> NDArray[np.float64]:
    """One row of numbers, NaN where one is missing."""
    known = np.ma.masked_invalid(np.ma.asarray(values, np.float64))
    return np.asarray(np.ma.filled(known, np.nan)).ravel()


def _labels(ids: list[str], wanted: Wanted) -> list[str]:
    """What trajectory=VALUE is compared with: the identifiers, or where none fits the indices."""
    by_index = (
        wanted.column.lower() == "trajectory"
        and wanted.value.isdecimal()
        and int(wanted.value) < len(ids)
        and comparable(wanted.value) not in {comparable(text) for text in ids}
    )
    return [str(i) for i in range(len(ids))] if by_index else ids
