"""Fixes of a CSV file."""

import csv
from collections.abc import Iterator, Sequence
from pathlib import Path

from shoal.core.errors import TrackError
from shoal.scenario.track_table import ID_NAMES, LAT_NAMES, LON_NAMES, TIME_NAMES, Row, Table


def csv_table(path: Path) -> Table:
    """Return the rows of a CSV file, not yet read; a stream where the file is large."""
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
