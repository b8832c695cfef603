"""Find the fixes of one track in a CSV, GPX or NetCDF file."""

import csv
import difflib
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from datetime import UTC, datetime
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple
from xml.etree import ElementTree
from xml.parsers import expat

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import MissingExtraError, TrackError

if TYPE_CHECKING:
    import netCDF4

SUPPORTED = ".csv, .gpx and .nc"
TIME_NAMES = ("time", "timestamp", "datetime", "date_time", "basedatetime", "base_date_time")
LAT_NAMES = ("lat", "latitude")
LON_NAMES = ("lon", "longitude", "lng", "long")
ID_NAMES = (
    "track_id", "trajectory", "trajectory_id", "mmsi", "drifter_id", "buoy_id",
    "vessel_id", "ship_id", "platform_id", "imo", "id", "name", "vessel_name", "vesselname",
)  # fmt: skip
FIRST_UNIX, LAST_UNIX = -62135596800.0, 253402300799.0  # [s] the years 1 to 9999
ROW_SIZE_NAMES = ("row_size", "rowsize")
ASSUMED = {
    "naive": "Times without a time zone were taken as UTC.",
    "plain": "Times that are plain numbers were taken as unix seconds.",
}
SECONDS = {
    "nanosecond": 1e-9, "ns": 1e-9, "microsecond": 1e-6, "us": 1e-6, "millisecond": 1e-3,
    "ms": 1e-3, "second": 1.0, "sec": 1.0, "s": 1.0, "minute": 60.0, "min": 60.0,
    "hour": 3600.0, "hr": 3600.0, "h": 3600.0, "day": 86400.0, "d": 86400.0,
}  # fmt: skip
REAL_CALENDARS = ("standard", "gregorian", "proleptic_gregorian")


class Fixes(NamedTuple):
    """Fixes of one track in file order."""

    unix: NDArray[np.float64]  # (F,) [s] since 1970-01-01 UTC, whole microseconds
    lat: NDArray[np.float64]  # (F,) [deg]
    lon: NDArray[np.float64]  # (F,) [deg]
    places: Sequence[str]  # (F,) file and line, for errors
    notes: Sequence[str]  # what was dropped or assumed

    def where(self, kept: NDArray[np.bool_]) -> "Fixes":
        """The fixes that are kept."""
        places = [place for place, keep in zip(self.places, kept, strict=True) if keep]
        return Fixes(self.unix[kept], self.lat[kept], self.lon[kept], places, self.notes)


class Row(NamedTuple):
    """One fix as the file has it, unchecked."""

    place: str
    time: str | float  # text, or decoded unix time [s]
    lat: str | float
    lon: str | float
    cells: Sequence[str]  # one for each of the table's columns
    missing: bool = False  # the file marks its time or position so


class Table(NamedTuple):
    """All fixes of a file."""

    columns: Sequence[str]
    id_columns: Sequence[str]  # those that tell tracks apart, the best first
    rows: Iterable[Row]


def read_fixes(path: Path, track_id: str | None) -> Fixes:
    """Return the fixes of the track that `track_id` names, or of the only one.

    Raises
    ------
    TrackError : no such file, format, column, track or value; says which line
    MissingExtraError : netCDF4 is not installed and `path` is a .nc file
    """
    _check_file(path)
    try:
        table = _table(path, track_id)
        return _numbers(path, _select(path, table, track_id))
    except UnicodeDecodeError as error:
        raise TrackError(str(path), "is not UTF-8 text", "save it as UTF-8") from error
    except OSError as error:
        raise TrackError(str(path), f"cannot be read ({error.strerror or error})", "check the file") from error


def _check_file(path: Path) -> None:
    if path.suffix.lower() not in (".csv", ".gpx", ".nc"):
        raise TrackError(
            str(path),
            f"tracks are read from {SUPPORTED} files, not from '{path.suffix or path.name}'",
            "convert the file to one of these",
        )
    if not path.is_file():
        there = [entry.name for entry in path.parent.iterdir()] if path.parent.is_dir() else []
        near = difflib.get_close_matches(path.name, there, n=1)
        raise TrackError(str(path), "no such file", f"did you mean {near[0]}?" if near else "check the path")
    if path.stat().st_size == 0:
        raise TrackError(str(path), "is empty", "record or export the track again")


def _table(path: Path, track_id: str | None) -> Table:
    suffix = path.suffix.lower()
    if suffix == ".csv":
        return _csv_table(path)
    if suffix == ".gpx":
        return _gpx_table(path)
    return _netcdf_table(path, track_id)


# --- choosing one track ---


def _select(path: Path, table: Table, track_id: str | None) -> list[Row]:
    if track_id is None:
        rows = list(table.rows)
        if not rows:
            raise TrackError(str(path), "holds no fixes", "record or export the track again")
        _refuse_several(path, table, rows, "the file")
        return rows
    column, value = _split(path, table, track_id)
    at = table.columns.index(column)
    wanted = _key(value)
    found: dict[Decimal | str, str] = {}
    rows = []
    for row in table.rows:
        key = _key(row.cells[at])
        found.setdefault(key, row.cells[at].strip())
        if key == wanted:
            rows.append(row)
    if not rows:
        raise _unknown_value(path, column, value, [text for text in found.values() if text])
    if column not in table.id_columns:
        _refuse_several(path, table, rows, f"{column}={value}")
    return rows


def _refuse_several(path: Path, table: Table, rows: list[Row], what: str) -> None:
    for column in table.id_columns:
        at = table.columns.index(column)
        counts = Counter(_key(row.cells[at]) for row in rows if row.cells[at].strip())
        numbers_the_rows = column.lower() == "id" and len(counts) == len(rows)
        if len(counts) > 1 and not numbers_the_rows:
            best, fixes = counts.most_common(1)[0]
            text = next(row.cells[at].strip() for row in rows if _key(row.cells[at]) == best)
            raise TrackError(
                str(path),
                f"{what} holds {len(counts)} tracks, told apart by {column}; a target follows one",
                f"name one: --track-id {column}={text} has the most fixes, {fixes}",
            )


def _split(path: Path, table: Table, track_id: str) -> tuple[str, str]:
    name, equals, value = (part.strip() for part in track_id.partition("="))
    if not (name and equals and value):
        raise TrackError(f"--track-id {track_id}", "is not COLUMN=VALUE", "write it like mmsi=235070762")
    for column in table.columns:
        if column.lower() == name.lower():
            return column, value
    near = difflib.get_close_matches(name, table.columns, n=1)
    raise TrackError(
        str(path),
        f"no column {name} for --track-id; it has {', '.join(table.columns)}",
        f"did you mean {near[0]}={value}?" if near else "use one of these columns",
    )


def _key(text: str) -> Decimal | str:
    """Equal for '235070762' and '235070762.0'; exact, so long numbers stay apart."""
    try:
        number = Decimal(text.strip())
    except InvalidOperation:
        return text.strip()
    return number if number.is_finite() else text.strip()


def _unknown_value(path: Path, column: str, value: str, there: list[str]) -> TrackError:
    if not there:
        return TrackError(str(path), f"no fix has a {column}", "check the file or --track-id")
    near = difflib.get_close_matches(value, there, n=3, cutoff=0.0)
    return TrackError(
        str(path),
        f"no fix has {column}={value}; nearest of the {len(there)} there: {', '.join(near)}",
        f"use --track-id {column}={near[0]}, or another of them",
    )


# --- text to numbers ---


def _numbers(path: Path, rows: list[Row]) -> Fixes:
    full = [row for row in rows if not row.missing]
    if not full:
        raise TrackError(str(path), "every fix lacks its time or position", "export it again")
    times = [_unix_seconds(row) for row in full]
    kinds = {kind for _, kind in times}
    notes = [sentence for kind, sentence in ASSUMED.items() if kind in kinds]
    if len(full) < len(rows):
        notes.append(f"Fixes dropped because the file marks them missing: {len(rows) - len(full)}.")
    return Fixes(
        unix=np.round([unix for unix, _ in times], 6),
        lat=np.array([_degrees(row.place, "lat", row.lat) for row in full]),
        lon=np.array([_degrees(row.place, "lon", row.lon) for row in full]),
        places=[row.place for row in full],
        notes=notes,
    )


def _unix_seconds(row: Row) -> tuple[float, str]:
    """Unix time [s], and whether the file gave it decoded, plain, naive or as UTC."""
    try:
        unix = float(row.time)
        kind = "plain" if isinstance(row.time, str) else "decoded"
    except ValueError:
        moment = _moment(row)
        kind = "utc" if moment.tzinfo else "naive"
        unix = (moment if moment.tzinfo else moment.replace(tzinfo=UTC)).timestamp()
    if not FIRST_UNIX <= unix <= LAST_UNIX:
        raise TrackError(
            row.place,
            f"time {row.time} is no unix time [s] in the years 1 to 9999",
            "write seconds, not milliseconds, since 1970-01-01 UTC, or ISO 8601",
        )
    return unix, kind


def _moment(row: Row) -> datetime:
    try:
        return datetime.fromisoformat(str(row.time).strip())
    except ValueError as error:
        raise TrackError(
            row.place,
            f"time {str(row.time)!r} cannot be read",
            "write ISO 8601, such as 2022-01-03T00:05:07Z, or unix seconds",
        ) from error


def _degrees(place: str, name: str, value: str | float) -> float:
    try:
        degrees = float(value)
    except ValueError:
        degrees = math.nan
    if not math.isfinite(degrees):
        given = str(value).strip()
        problem = f"{name} {given!r} is not a number" if given else f"{name} is empty"
        raise TrackError(place, problem, "write decimal degrees, or remove the line")
    return degrees


# --- CSV ---


def _csv_table(path: Path) -> Table:
    lines = _csv_lines(path)
    _, header = next(lines, ("", []))
    columns = [name.strip() for name in header]
    at = [_column(path, columns, names) for names in (TIME_NAMES, LAT_NAMES, LON_NAMES)]
    id_columns = [column for name in ID_NAMES for column in columns if column.lower() == name]
    return Table(columns, id_columns, _csv_rows(lines, len(columns), at))


def _csv_lines(path: Path) -> Iterator[tuple[str, list[str]]]:
    """Place and cells of each line."""
    with path.open(newline="", encoding="utf-8-sig") as file:
        reader = csv.reader(file)
        try:
            for cells in reader:
                yield f"{path}:{reader.line_num}", cells
        except csv.Error as error:
            raise TrackError(f"{path}:{reader.line_num}", f"is not CSV ({error})", "export the track again") from error


def _column(path: Path, columns: Sequence[str], names: Sequence[str]) -> int:
    lower = [column.lower() for column in columns]
    for name in names:
        if name in lower:
            return lower.index(name)
    raise TrackError(
        f"{path}:1",
        f"no column {' or '.join(names[:2])}; it has {', '.join(columns) or 'none'}",
        "name the columns in the first line, with commas between: time,lat,lon",
    )


def _csv_rows(lines: Iterator[tuple[str, list[str]]], width: int, at: Sequence[int]) -> Iterator[Row]:
    for place, cells in lines:
        if cells:
            full = cells + [""] * (width - len(cells))
            time, lat, lon = (full[i] for i in at)
            yield Row(place, time, lat, lon, full)


# --- GPX ---


def _gpx_table(path: Path) -> Table:
    root = _gpx_root(path)
    tracks = root.findall("trk")
    if root.tag != "gpx" or not tracks:
        raise TrackError(str(path), "holds no <trk> inside <gpx>", "export a recorded track, not a route")
    rows = [
        Row(
            place=f"{path}:{point.get('line')}",
            time=point.findtext("time", ""),
            lat=point.get("lat", ""),
            lon=point.get("lon", ""),
            cells=(str(index), track.findtext("name", "")),
        )
        for index, track in enumerate(tracks)
        for point in track.iterfind("trkseg/trkpt")
    ]
    return Table(("track", "name"), ("track",), rows)


def _gpx_root(path: Path) -> ElementTree.Element:
    """The tree, tags without namespace, each element with its line as attribute `line`."""
    builder = ElementTree.TreeBuilder()
    parser = expat.ParserCreate()

    def start(tag: str, attributes: dict[str, str]) -> None:
        builder.start(tag.rpartition(":")[2], {**attributes, "line": str(parser.CurrentLineNumber)})

    def end(tag: str) -> None:
        builder.end(tag.rpartition(":")[2])

    def refuse_doctype(*_: object) -> None:  # it can define entities: bombs, other files
        raise TrackError(f"{path}:{parser.CurrentLineNumber}", "has a DOCTYPE, which GPX needs not", "remove it")

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = builder.data
    parser.StartDoctypeDeclHandler = refuse_doctype
    try:
        with path.open("rb") as file:
            parser.ParseFile(file)
    except expat.ExpatError as error:
        raise TrackError(
            f"{path}:{error.lineno}",
            f"is not XML ({expat.ErrorString(error.code)})",
            "export the track again",
        ) from error
    return builder.close()


# --- NetCDF ---


def _netcdf_table(path: Path, track_id: str | None) -> Table:
    netcdf4 = _netcdf4()
    with netcdf4.Dataset(path) as dataset:
        lat = _variable(path, dataset, "latitude", LAT_NAMES, ("degree_north", "degrees_north"))
        lon = _variable(path, dataset, "longitude", LON_NAMES, ("degree_east", "degrees_east"))
        time = _variable(path, dataset, "time", TIME_NAMES, (" since ",))
        _check_dimensions(path, lat, lon, time)
        values = (_decoded_time(path, netcdf4, time), lat[...], lon[...])
        if lat.ndim == 1:
            owner, dimension = _ragged_owner(path, dataset, lat)
        else:
            dimension = _trajectory_dimension(dataset, lat, time)
            values = _by_trajectory(values, lat.dimensions.index(dimension))
            owner = np.indices(values[1].shape)[0].ravel()
        owner, id_name, ids = _ids(netcdf4, dataset, owner, dimension)
    labels = _labels(ids, track_id)
    rows = _netcdf_rows(path, values, [(labels[i], ids[i]) for i in owner])
    return Table(tuple(dict.fromkeys(("trajectory", id_name))), (id_name,), rows)


def _netcdf4() -> Any:
    try:
        import netCDF4
    except ImportError as error:
        raise MissingExtraError.of("netCDF4", "xarray", "reading a NetCDF track") from error
    return netCDF4


def _variable(
    path: Path, dataset: "netCDF4.Dataset", standard_name: str, names: Sequence[str],
    units: Sequence[str],
) -> Any:  # fmt: skip
    """The numeric variable most like `standard_name`, by standard_name, name and units."""

    def likeness(variable: Any) -> int:
        has_units = any(unit in _text(variable, "units").lower() for unit in units)
        has_standard_name = _text(variable, "standard_name") == standard_name
        return 4 * has_standard_name + 2 * (variable.name.lower() in names) + has_units

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
            f"{described} is no trajectory; is it a grid?",
            "store CF trajectories: lat, lon and time over (obs) or (trajectory, obs)",
        )


def _decoded_time(path: Path, netcdf4: Any, variable: Any) -> Any:
    """Unix time [s], masked where missing."""
    units, calendar = _text(variable, "units"), _text(variable, "calendar") or "standard"
    word, _, reference = units.partition(" since ")
    word = word.strip().lower()
    scale = SECONDS.get(word, SECONDS.get(word.removesuffix("s")))
    if scale is None or not reference or calendar.lower() not in REAL_CALENDARS:
        raise TrackError(
            f"{path} {variable.name}",
            f"units {units!r} in calendar {calendar!r} is no time that was recorded",
            "use units such as 'seconds since 1970-01-01' and the standard calendar",
        )
    seconds = np.ma.masked_invalid(variable[...].astype(np.float64)) * scale
    if not seconds.count():
        return seconds
    first = float(seconds.compressed()[0])
    try:
        date = netcdf4.num2date(first, f"seconds since {reference}", calendar)
        moment = datetime.fromisoformat(date.isoformat()).replace(tzinfo=UTC)
    except (ValueError, OverflowError) as error:
        raise TrackError(
            f"{path} {variable.name}",
            f"{first:g} s since {reference!r} cannot be read ({error})",
            "use units such as 'seconds since 1970-01-01' and times in the years 1 to 9999",
        ) from error
    return moment.timestamp() + (seconds - first)


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
    named = [v for name in ID_NAMES for v in there if v.name.lower() == name]
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


def _labels(ids: list[str], track_id: str | None) -> list[str]:
    """What trajectory=VALUE is compared with: the identifiers, or where none fits the indices."""
    name, _, value = (part.strip() for part in (track_id or "").partition("="))
    by_index = (
        name.lower() == "trajectory"
        and value.isdecimal()
        and int(value) < len(ids)
        and _key(value) not in {_key(text) for text in ids}
    )
    return [str(i) for i in range(len(ids))] if by_index else ids


def _netcdf_rows(path: Path, values: tuple[Any, Any, Any], cells: Sequence[Sequence[str]]) -> Iterator[Row]:
    shape = values[1].shape
    masks = np.array([np.ma.getmaskarray(value).ravel() for value in values])
    padding, missing = np.logical_and.reduce(masks), np.logical_or.reduce(masks)
    time, lat, lon = (np.ma.getdata(value).ravel().tolist() for value in values)
    for i in np.flatnonzero(~padding).tolist():
        index = ", ".join(str(k) for k in np.unravel_index(i, shape))
        yield Row(f"{path}[{index}]", time[i], lat[i], lon[i], cells[i], missing[i])
