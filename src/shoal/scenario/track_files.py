"""Find the fixes of one track in a CSV, GPX or NetCDF file."""

import difflib
import math
from collections import Counter
from collections.abc import Sequence
from datetime import UTC, datetime
from decimal import Decimal
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import TrackError
from shoal.scenario.track_csv import csv_table
from shoal.scenario.track_gpx import gpx_table
from shoal.scenario.track_netcdf import netcdf_table
from shoal.scenario.track_table import Row, Table, comparable

SUPPORTED = ".csv, .gpx and .nc"

FIRST_UNIX, LAST_UNIX = -62135596800.0, 253402300799.0  # [s] the years 1 to 9999
ASSUMED = {
    "naive": "Times without a time zone were taken as UTC.",
    "plain": "Times that are plain numbers were taken as unix seconds.",
}


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
        return csv_table(path)
    if suffix == ".gpx":
        return gpx_table(path)
    return netcdf_table(path, track_id)


def _select(path: Path, table: Table, track_id: str | None) -> list[Row]:
    if track_id is None:
        rows = list(table.rows)
        if not rows:
            raise TrackError(str(path), "holds no fixes", "record or export the track again")
        _refuse_several(path, table, rows, "the file")
        return rows
    column, value = _split(path, table, track_id)
    at = table.columns.index(column)
    wanted = comparable(value)
    found: dict[Decimal | str, str] = {}
    rows = []
    for row in table.rows:
        key = comparable(row.cells[at])
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
        counts = Counter(comparable(row.cells[at]) for row in rows if row.cells[at].strip())
        numbers_the_rows = column.lower() == "id" and len(counts) == len(rows)
        if len(counts) > 1 and not numbers_the_rows:
            best, fixes = counts.most_common(1)[0]
            text = next(row.cells[at].strip() for row in rows if comparable(row.cells[at]) == best)
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


def _unknown_value(path: Path, column: str, value: str, there: list[str]) -> TrackError:
    if not there:
        return TrackError(str(path), f"no fix has a {column}", "check the file or --track-id")
    near = difflib.get_close_matches(value, there, n=3, cutoff=0.0)
    return TrackError(
        str(path),
        f"no fix has {column}={value}; nearest of the {len(there)} there: {', '.join(near)}",
        f"use --track-id {column}={near[0]}, or another of them",
    )


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
