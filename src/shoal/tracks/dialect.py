"""How a CSV file is written: encoding, separator, where its header stands and what its columns mean."""

import codecs
import csv
import re
from collections.abc import Iterator, Sequence
from itertools import islice
from pathlib import Path
from typing import NamedTuple, TextIO

from shoal.core.errors import TrackError
from shoal.tracks import names
from shoal.tracks.numbers import number

BLOCK = 1 << 20  # [bytes]
FIRST_LINES = 100  # among these the header must be
LONGEST_LINE = 100_000  # [characters]
SEPARATORS = (",", ";", "\t", "|", " ")
BYTE_ORDER_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
UNITS = re.compile(r"\(?(deg|°|decimal|dd|utc|gmt|iso|s\b|sec|ms\b|epoch|unix|yyyy|date|time|[-a-z]*\s+since)", re.I)
CLOCK = re.compile(r"\s*\d{1,2}:\d\d|\s*\d{6}(\.\d+)?\s*$", re.ASCII)


class Meaning(NamedTuple):
    """Which columns give time and place."""

    time: tuple[int, ...]  # one column, or date and clock, or year, month, day ...
    lat: int
    lon: int


class Dialect(NamedTuple):
    """How to read one file."""

    encoding: str
    separator: str
    lines: int  # before the first fix
    columns: Sequence[str]
    meaning: Meaning
    day_first: bool | None  # what the layout says of dates such as 10/03/2024
    notes: Sequence[str]


def dialect_of(path: Path) -> Dialect:
    """Look at the first lines of a file.

    Raises
    ------
    TrackError : no line names columns of time, latitude and longitude
    """
    encoding, notes = _encoding(path)
    with open_text(path, encoding) as file:
        lines = list(islice(bounded(file, path), FIRST_LINES))
    at, separator, columns, meaning = _header(path, lines)
    first = _cells(lines[at + 1], separator) if at + 1 < len(lines) else []
    count = at + 1
    if _is_units_row(first, meaning):
        notes.append(f"Line {at + 2} was skipped: it holds units.")
        count += 1
        first = _cells(lines[at + 2], separator) if at + 2 < len(lines) else []
    hashed = lines[at].lstrip("\ufeff \"'").startswith("#")
    danish = hashed and "typeofmobile" in map(names.plain, columns)
    return Dialect(
        encoding, separator, count, columns, _with_date(columns, meaning, first), True if danish else None, notes
    )


def open_text(path: Path, encoding: str) -> TextIO:
    """Open a file whose every byte is some text."""
    return path.open(encoding=encoding, errors="replace")


def bounded(file: TextIO, path: Path) -> Iterator[str]:
    """The lines of a file, none of them endless."""
    number_of = 0
    while line := file.readline(LONGEST_LINE):
        number_of += 1
        if len(line) == LONGEST_LINE and not line.endswith("\n"):
            raise TrackError(f"{path}:{number_of}", "is not CSV: the line does not end", "export the track again")
        yield line


def _encoding(path: Path) -> tuple[str, list[str]]:
    """By its mark, its zeros, or whether all of it is UTF-8."""
    with path.open("rb") as file:
        start = file.read(4096)
        for mark, name in BYTE_ORDER_MARKS:
            if start.startswith(mark):
                return name, []
        for name, zeros in (("utf-16-le", start[1::2]), ("utf-16-be", start[0::2])):
            if len(zeros) > 4 and zeros.count(0) > 0.7 * len(zeros):
                return name, []
        decoder = codecs.getincrementaldecoder("utf-8")()
        block = start
        try:
            while block:
                decoder.decode(block)
                block = file.read(BLOCK)
            decoder.decode(b"", final=True)
        except UnicodeDecodeError:
            return "cp1252", ["The text is not UTF-8; it was taken as Windows-1252 (Latin-1)."]
    return "utf-8", []


def _cells(line: str, separator: str) -> list[str]:
    try:
        return next(csv.reader([line], delimiter=separator, skipinitialspace=separator == " "), [])
    except csv.Error:
        return []


def _header(path: Path, lines: Sequence[str]) -> tuple[int, str, list[str], Meaning]:
    """The first line that names time, latitude and longitude, with the separator that shows it."""
    for at, line in enumerate(lines):
        for separator in SEPARATORS if len(line.split()) > 2 else SEPARATORS[:-1]:
            columns = _columns(line, separator)
            meaning = _meaning(columns)
            if meaning and len(set(meaning.time) | {meaning.lat, meaning.lon}) > 2:
                return at, separator, columns, meaning
    at = next((i for i, line in enumerate(lines) if line.strip() and not line.startswith("#")), 0)
    line = lines[at] if lines else ""
    columns = _columns(line, max(SEPARATORS[:-1], key=line.count))
    wanted = (
        ("time or timestamp", names.TIME_NAMES, names.TIME_LIKE),
        ("lat or latitude", names.LAT_NAMES, names.LAT_LIKE),
        ("lon or longitude", names.LON_NAMES, names.LON_LIKE),
    )
    absent = (what for what, known, like in wanted if names.find(columns, known, like) is None)
    missing = next(absent, "time or timestamp")
    shown = ", ".join(column[:40] for column in columns[:20] if column.isprintable()) or "none"
    raise TrackError(
        f"{path}:{at + 1}",
        f"no column {missing}; it has {shown}",
        "name the columns in the first line, with commas between: time,lat,lon",
    )


def _columns(line: str, separator: str) -> list[str]:
    return [cell.strip().lstrip("\ufeff#%").strip() for cell in _cells(line.strip("\r\n"), separator)]


def _meaning(columns: Sequence[str]) -> Meaning | None:
    lat = names.find(columns, names.LAT_NAMES, names.LAT_LIKE)
    lon = names.find(columns, names.LON_NAMES, names.LON_LIKE)
    time = names.find(columns, names.TIME_NAMES, names.TIME_LIKE)
    if lat is None or lon is None or lat == lon:
        return None
    if time is not None:
        return Meaning((time,), lat, lon)
    there = [names.PART_NAMES.get(names.plain(column), names.plain(column)) for column in columns]
    parts = tuple(there.index(part) for part in names.PARTS if part in there)
    return Meaning(parts, lat, lon) if {"year", "month", "day"} <= set(there) else None


def _is_units_row(cells: Sequence[str], meaning: Meaning) -> bool:
    if len(cells) <= max(*meaning.time, meaning.lat, meaning.lon):
        return False
    lat, lon, time = cells[meaning.lat], cells[meaning.lon], cells[meaning.time[0]]
    return number(lat) != number(lat) and number(lon) != number(lon) and any(map(UNITS.match, (lat, lon, time)))


def _with_date(columns: Sequence[str], meaning: Meaning, first: Sequence[str]) -> Meaning:
    """The column of the date beside that of the time of day, where these are two."""
    if len(meaning.time) > 1:
        return meaning
    date = names.find(columns, names.DATE_NAMES)
    clock = meaning.time[0] if date != meaning.time[0] else names.find(columns, names.CLOCK_NAMES)
    if date is None or clock is None or clock == date:
        return meaning
    if not (clock < len(first) and CLOCK.match(first[clock])):
        return meaning._replace(time=(date if date == meaning.time[0] else clock,))
    return meaning._replace(time=(date, clock))
