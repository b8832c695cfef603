"""Fixes gathered one by one, for files that are read as a tree."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numpy as np

from shoal.tracks.numbers import numbers
from shoal.tracks.table import Table, labels

PLANNED = "it holds a planned route; export the recorded track, with its times"


class Points:
    """A growing table: add fixes, then ask for the table."""

    def __init__(self, columns: Sequence[str] = ()) -> None:
        self.time: list[str] = []
        self.lat: list[str] = []
        self.lon: list[str] = []
        self.line: list[int] = []
        self.cells: dict[str, list[str]] = {column: [] for column in columns}

    def add(self, time: str, lat: str, lon: str, line: int, cells: Mapping[str, str]) -> None:
        """Take one fix; `cells` are its columns, new ones are empty for the fixes before."""
        for column in cells.keys() - self.cells.keys():
            self.cells[column] = [""] * len(self.line)
        for column, texts in self.cells.items():
            texts.append(cells.get(column, ""))
        self.time.append(time)
        self.lat.append(lat)
        self.lon.append(lon)
        self.line.append(line)

    def table(
        self,
        path: Path,
        identifiers: Sequence[str] | None = None,
        place: Callable[[int], str] | None = None,
        untimed: str = PLANNED,
        notes: Sequence[str] = (),
    ) -> Table:
        """Return what was gathered."""
        lat, bad_lat = numbers(self.lat)
        lon, bad_lon = numbers(self.lon)
        bad = {row: ("lon", text) for row, text in bad_lon.items()} | {
            row: ("lat", text) for row, text in bad_lat.items()
        }
        return Table(
            columns=list(self.cells),
            time=self.time,
            lat=lat,
            lon=lon,
            line=np.array(self.line, np.int64),
            labels={column: labels(texts) for column, texts in self.cells.items()},
            place=place or (lambda line: f"{path}:{line}"),
            identifiers=identifiers,
            bad=bad,
            untimed=untimed,
            notes=notes,
        )
