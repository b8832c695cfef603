"""Fixes of a CSV file, read once, a block of lines at a time: a day of a whole coast fits into little memory."""

import csv
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from pathlib import Path
from typing import TextIO

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import TrackError
from shoal.tracks import names
from shoal.tracks.choose import choose
from shoal.tracks.dialect import Dialect, bounded, dialect_of, open_text
from shoal.tracks.numbers import numbers
from shoal.tracks.table import Labels, Table
from shoal.tracks.wanted import SeveralTracksError, Wanted, column_of, refuse_several

BLOCK = 1 << 20  # [characters]
ROWS = 10_000  # of a block that is parsed cell by cell
ENOUGH = 50_000  # rows, to see that there are several vehicles where no column's name says so
MOST_VALUES = 65_000  # a column with more, most of them once, tells no tracks apart

Block = tuple[list[list[str]], list[int]]  # cells and line of each row


def csv_table(path: Path, wanted: Wanted) -> Table:
    """Return the fixes of a CSV file; where `wanted` names a column, only those of its value.

    Raises
    ------
    TrackError : it is not CSV of time, lat and lon, or holds several vehicles and none is named
    """
    dialect = dialect_of(path)
    sieve = _Sieve(path, dialect, wanted)
    rows = _Rows(path, dialect)
    with open_text(path, dialect.encoding) as file:
        for block in _blocks(path, file, dialect, sieve):
            if sieve.open:
                rows.add(*block)
            else:
                sieve.count(block[0])
            if sieve.is_undecided and len(rows.line) >= ENOUGH:
                sieve.decide(rows.table(sieve))
    sieve.finish()
    return rows.table(sieve)


class _Sieve:
    """Which rows are kept: those that are wanted, or none any more once there are several vehicles.

    One column decides: that of --track-id, or the best identifier. Its values are counted in all rows.
    """

    def __init__(self, path: Path, dialect: Dialect, wanted: Wanted) -> None:
        self.path, self.wanted = path, wanted
        self.columns = columns = dialect.columns
        if wanted.column:
            self.column: str | None = column_of(path, columns, wanted)
        elif wanted.everything:
            self.column = None
        else:
            certain = [each for each in columns if names.is_certain(each)]
            self.column = min(certain, key=lambda each: names.rank(each) or 0, default=None)
        self.at = columns.index(self.column) if self.column is not None else -1
        self.counts: Counter[str] = Counter()
        self.matches: dict[str, bool] = {}
        self.open = True
        self.is_undecided = self.column is None and not wanted.everything

    def keeps(self, values: Sequence[str]) -> NDArray[np.bool_]:
        """Which rows of a block are kept, by their value in the column."""
        self.counts.update(values)
        if self.wanted.column:
            for value in self.counts.keys() - self.matches.keys():
                self.matches[value] = self.wanted.matches(value)
            return np.array([self.matches[value] for value in values], np.bool_)
        if self.open and len(self.counts) > 1:
            self.open = len({self.wanted.key(value) for value in self.counts if value.strip()}) < 2
        return np.full(len(values), self.open)

    def decide(self, table: Table) -> None:
        """Look whether the rows so far are several vehicles: then the others are only counted."""
        self.is_undecided = False
        try:
            choose(self.path, table, self.wanted, None)
        except SeveralTracksError as several:
            label = table.labels[several.column]
            self.counts.update(label.values[code] for code in label.codes.tolist())
            self.column, self.at, self.open = several.column, self.columns.index(several.column), False
        except TrackError:  # the error will name the whole file
            return

    def count(self, rows: list[list[str]]) -> None:
        """Count the values of rows that were read before the column was known."""
        self.counts.update(row[self.at] if len(row) > self.at else "" for row in rows)

    def finish(self) -> None:
        """Refuse several vehicles."""
        if not self.open and self.column is not None:
            refuse_several(self.path, "the file", self.column, self.counts)


class _Rows:
    """The rows kept, by column."""

    def __init__(self, path: Path, dialect: Dialect) -> None:
        self.path, self.dialect = path, dialect
        self.time: list[str] = []
        self.lat: list[NDArray[np.float64]] = []
        self.lon: list[NDArray[np.float64]] = []
        self.bad: dict[int, tuple[str, str]] = {}
        self.line: list[int] = []
        self.repeated_headers = 0
        meaning = dialect.meaning
        taken = {*meaning.time, meaning.lat, meaning.lon}
        self.index: dict[int, defaultdict[str, int]] = {}
        for i in range(len(dialect.columns)):
            if i not in taken:
                self.index[i] = defaultdict()
                self.index[i].default_factory = self.index[i].__len__
        self.codes: dict[int, list[NDArray[np.int32]]] = {i: [] for i in self.index}

    def add(self, rows: list[list[str]], line: list[int]) -> None:
        """Take the rows of a block."""
        if not rows:
            return
        meaning, width = self.dialect.meaning, len(self.dialect.columns)
        if set(map(len, rows)) != {width}:
            rows = [row[:width] + [""] * (width - len(row)) for row in rows]
        columns = list(zip(*rows, strict=True))
        start = len(self.line)
        for name, at, parts in (("lat", meaning.lat, self.lat), ("lon", meaning.lon, self.lon)):
            values, bad = numbers(columns[at])
            parts.append(values)
            for i, text in bad.items():
                if names.plain(text) == names.plain(self.dialect.columns[at]):
                    self.repeated_headers += name == "lat"
                else:
                    self.bad.setdefault(start + i, (name, text))
        self.time += columns[meaning.time[0]] if len(meaning.time) == 1 else _joined(columns, meaning.time)
        self.line += line
        for i in list(self.index):
            self.codes[i].append(np.fromiter(map(self.index[i].__getitem__, columns[i]), np.int32, len(rows)))
            if len(self.index[i]) > max(MOST_VALUES, len(self.line) // 2):
                del self.index[i], self.codes[i]

    def table(self, sieve: _Sieve) -> Table:
        """What was kept."""
        none = np.empty(0)
        notes = list(self.dialect.notes)
        if self.repeated_headers:
            notes.append(f"Lines skipped because they repeat the header: {self.repeated_headers}.")
        labels = {
            self.dialect.columns[i]: Labels(
                np.concatenate([*self.codes[i], np.empty(0, np.int32)]), [text.strip() for text in index]
            )
            for i, index in self.index.items()
        }
        if sieve.wanted.column and sieve.column is not None:  # every value of the file, to name the nearest
            kept = labels.get(sieve.column)
            old = list(kept.values) if kept else []
            others = [text.strip() for text in sieve.counts if not sieve.matches[text]]
            codes = kept.codes if kept else np.zeros(len(self.line), np.int32)
            labels[sieve.column] = Labels(codes, [*old, *others])
        return Table(
            columns=self.dialect.columns,
            time=self.time,
            lat=_signed(np.concatenate([none, *self.lat]), labels, "lat", "NS"),
            lon=_signed(np.concatenate([none, *self.lon]), labels, "lon", "EW"),
            line=np.array(self.line, np.int64),
            labels=labels,
            place=lambda line: f"{self.path}:{line}",
            bad=self.bad,
            notes=notes,
            day_first=self.dialect.day_first,
        )


def _signed(degrees: NDArray[np.float64], labels: Mapping[str, Labels], axis: str, sides: str) -> NDArray[np.float64]:
    """Degrees south or west below zero, where a column of letters says so."""
    for name, column in labels.items():
        letters = [value[:1].upper() for value in column.values]
        if names.HEMISPHERES[axis].fullmatch(names.plain(name)) and {""} != {*letters} <= {*sides, ""}:
            negative = np.array([letter == sides[1] for letter in letters])
            return np.where(negative[column.codes], -np.abs(degrees), degrees)
    return degrees


def _joined(columns: Sequence[tuple[str, ...]], at: Sequence[int]) -> list[str]:
    """Date and clock, or year, month, day, hour, minute and second, as one text."""
    rows = zip(*(columns[i] for i in at), strict=True)
    if len(at) == 2:
        return [f"{date.strip()} {clock.strip()}" if date.strip() else "" for date, clock in rows]
    return [_from_parts(cells) for cells in rows]


def _from_parts(cells: Sequence[str]) -> str:
    year, month, day, hour, minute, second = ([cell.strip() for cell in cells] + ["0"] * 3)[:6]
    return f"{year}-{month:0>2}-{day:0>2} {hour:0>2}:{minute:0>2}:{second:0>2}" if year else ""


def _blocks(path: Path, file: TextIO, dialect: Dialect, sieve: _Sieve) -> Iterator[Block]:
    """Rows that are kept. Lines without quotes are split by hand, and most of them not at all."""
    lines = iter(bounded(file, path))
    for _ in range(dialect.lines):
        next(lines, "")
    first = dialect.lines + 1
    separator = dialect.separator
    while block := file.readlines(BLOCK):
        if separator == " " or any('"' in line for line in block):
            yield from _csv_blocks(path, chain(block, file), first, dialect, sieve)
            return
        line = list(range(first, first + len(block)))
        first += len(block)
        if sieve.at >= 0:
            values = [_cell(text, separator, sieve.at) for text in block]
            kept = np.flatnonzero(sieve.keeps(values)).tolist()
            block = [block[i] for i in kept]
            line = [line[i] for i in kept]
        for start in range(0, len(block), ROWS):
            some = block[start : start + ROWS]
            rows = [text.rstrip("\r\n").split(separator) for text in some]
            yield _without_blank(rows, line[start : start + ROWS])


def _cell(text: str, separator: str, at: int) -> str:
    cells = text.split(separator, at + 1)
    return cells[at].rstrip("\r\n") if len(cells) > at else ""


def _csv_blocks(path: Path, lines: Iterator[str], first: int, dialect: Dialect, sieve: _Sieve) -> Iterator[Block]:
    spaced = dialect.separator == " "
    reader = csv.reader(lines, delimiter=dialect.separator, skipinitialspace=spaced)
    rows: list[list[str]] = []
    line: list[int] = []
    try:
        for row in reader:
            rows.append(row)
            line.append(first + reader.line_num - 1)
            if len(rows) == ROWS:
                yield _sifted(rows, line, sieve)
                rows, line = [], []
    except csv.Error as error:
        where = f"{path}:{first + reader.line_num - 1}"
        raise TrackError(where, f"is not CSV ({error})", "export the track again") from error
    yield _sifted(rows, line, sieve)


def _sifted(rows: list[list[str]], line: list[int], sieve: _Sieve) -> Block:
    rows, line = _without_blank(rows, line)
    if sieve.at < 0:
        return rows, line
    kept = np.flatnonzero(sieve.keeps([row[sieve.at] if len(row) > sieve.at else "" for row in rows])).tolist()
    return [rows[i] for i in kept], [line[i] for i in kept]


def _without_blank(rows: list[list[str]], line: list[int]) -> Block:
    """Without empty lines and comments."""
    kept = [i for i, row in enumerate(rows) if any(row) and not row[0].startswith("#")]
    if len(kept) == len(rows):
        return rows, line
    return [rows[i] for i in kept], [line[i] for i in kept]
