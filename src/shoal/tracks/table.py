"""What a file of tracks holds, before any of it is judged."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal, InvalidOperation
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Labels(NamedTuple):
    """A column of text, each different value once."""

    codes: NDArray[np.int32]  # (F,) index into values
    values: Sequence[str]  # "" where a cell is empty

    def of(self, rows: NDArray[np.bool_] | NDArray[np.intp]) -> "Labels":
        """Those of the rows that are kept; the values stay."""
        return Labels(self.codes[rows], self.values)


@dataclass(frozen=True, eq=False)
class Table:
    """All fixes of a file, in its order."""

    columns: Sequence[str]  # all that may be named by --track-id
    time: Sequence[str] | NDArray[np.float64]  # (F,) text, or unix time [s], NaN where missing
    lat: NDArray[np.float64]  # (F,) [deg], NaN where missing
    lon: NDArray[np.float64]  # (F,) [deg], NaN where missing
    line: NDArray[np.int64]  # (F,) where each stands
    labels: Mapping[str, Labels]  # of the columns that may tell tracks apart
    place: Callable[[int], str]  # from a line to file and line, for errors
    identifiers: Sequence[str] | None = None  # those labels that tell tracks apart; None: judged by name
    bad: Mapping[int, tuple[str, str]] = field(default_factory=dict)  # row: "lat" or "lon", and the unreadable text
    notes: Sequence[str] = ()
    day_first: bool | None = None  # what the layout says of dates such as 10/03/2024
    untimed: str = "export it again"  # what to do when no fix has a time


class Fixes(NamedTuple):
    """Fixes of one track."""

    unix: NDArray[np.float64]  # (F,) [s] since 1970-01-01 UTC, whole microseconds
    lat: NDArray[np.float64]  # (F,) [deg]
    lon: NDArray[np.float64]  # (F,) [deg]
    line: NDArray[np.int64]  # (F,) where each stands in the file
    place: Callable[[int], str]  # from a line to file and line, for errors
    notes: Sequence[str]  # what was dropped or assumed

    def where(self, kept: NDArray[np.bool_] | NDArray[np.intp]) -> "Fixes":
        """The fixes that are kept, or in another order."""
        return self._replace(unix=self.unix[kept], lat=self.lat[kept], lon=self.lon[kept], line=self.line[kept])


def labels(texts: Iterable[str]) -> Labels:
    """Return a column of text as codes and values."""
    index: dict[str, int] = {}
    codes = [index.setdefault(text.strip(), len(index)) for text in texts]
    return Labels(np.array(codes, np.int32), list(index))


def same(column: Labels) -> Labels:
    """The column with one value for all that mean the same, such as '235070762' and '235070762.0'."""
    index: dict[Decimal | str, int] = {}
    values: list[str] = []
    code_of = np.zeros(max(len(column.values), 1), np.int32)
    for code, text in enumerate(column.values):
        code_of[code] = index.setdefault(comparable(text), len(index))
        if len(index) > len(values):
            values.append(text)
    return Labels(code_of[column.codes], values)


def comparable(text: str) -> Decimal | str:
    """Equal for '235070762' and '235070762.0'; exact, so long numbers stay apart."""
    text = text.strip()
    try:
        number = Decimal(text)
    except InvalidOperation:
        return text
    return number if number.is_finite() and text.isascii() and "_" not in text else text
