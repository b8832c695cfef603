"""Which track of a file is wanted: COLUMN=VALUE, all, or the only one."""

import difflib
from collections import Counter
from collections.abc import Mapping, Sequence
from decimal import Decimal
from fnmatch import fnmatchcase
from pathlib import Path
from typing import NamedTuple, NoReturn

from shoal.core.errors import TrackError
from shoal.tracks.names import JOURNEYS, rank
from shoal.tracks.table import comparable

ALL = "all"
SHOWN_COLUMNS = 30


class Wanted(NamedTuple):
    """What --track-id says."""

    column: str = ""
    value: str = ""
    everything: bool = False

    def matches(self, text: str) -> bool:
        """Whether a value is the one that is wanted; a * in that stands for anything."""
        if "*" in self.value:
            return fnmatchcase(text.strip(), self.value.replace("[", "[[]").replace("?", "[?]"))
        return comparable(text) == comparable(self.value)

    @staticmethod
    def key(text: str) -> Decimal | str:
        """Equal for values that mean the same."""
        return comparable(text)


class SeveralTracksError(TrackError):
    """A file of several tracks, of which none is named; `column` tells them apart."""

    def __init__(self, where: str, problem: str, fix: str, column: str = "") -> None:
        super().__init__(where, problem, fix)
        self.column = column


def parse_wanted(track_id: str | None) -> Wanted:
    """Read a --track-id.

    Raises
    ------
    TrackError : it is neither COLUMN=VALUE nor all
    """
    if track_id is None:
        return Wanted()
    if track_id.strip().lower() == ALL:
        return Wanted(everything=True)
    name, equals, value = (part.strip() for part in track_id.partition("="))
    if not (name and equals and value):
        raise TrackError(f"--track-id {track_id}", "is not COLUMN=VALUE", "write it like mmsi=235070762")
    return Wanted(name, value)


def column_of(path: Path, columns: Sequence[str], wanted: Wanted) -> str:
    """Return the column that is wanted as the file spells it.

    Raises
    ------
    TrackError : there is none of this name
    """
    for column in columns:
        if column.lower() == wanted.column.lower():
            return column
    near = difflib.get_close_matches(wanted.column, columns, n=1)
    more = f" and {len(columns) - SHOWN_COLUMNS} more" if len(columns) > SHOWN_COLUMNS else ""
    raise TrackError(
        str(path),
        f"no column {wanted.column} for --track-id; it has {', '.join(columns[:SHOWN_COLUMNS])}{more}",
        f"did you mean {near[0]}={wanted.value}?" if near else "use one of these columns",
    )


def refuse_several(path: Path, what: str, column: str, counts: Mapping[str, int]) -> NoReturn:
    """Raise the error that says how many tracks there are, and how to name the one with most fixes."""
    number = rank(column)
    may_be_parts = number is None or number >= JOURNEYS
    alike: Counter[Decimal | str] = Counter()
    text: dict[Decimal | str, str] = {}
    for value, count in counts.items():
        if value.strip():
            alike[comparable(value)] += count
            text.setdefault(comparable(value), value.strip())
    (best, fixes), *_ = alike.most_common(1)
    if fixes < 2:
        raise SeveralTracksError(
            str(path),
            f"{what} holds {len(alike)} tracks, told apart by {column}, and no track has two fixes",
            "record longer, or export more of one track: a path needs two fixes",
            column,
        )
    raise SeveralTracksError(
        str(path),
        f"{what} holds {len(alike)} tracks, told apart by {column}; a target follows one",
        f"name one: --track-id {column}={text[best]} has the most fixes, {fixes}"
        + ("; if they are parts of one trip, --track-id all joins them" if may_be_parts else ""),
        column,
    )


def unknown_value(path: Path, column: str, wanted: Wanted, values: Sequence[str]) -> TrackError:
    """Return the error that names the values nearest to the one that is wanted."""
    there = list({comparable(text): text for text in values if text}.values())
    if not there:
        return TrackError(str(path), f"no fix has a {column}", "check the file or --track-id")
    near = difflib.get_close_matches(wanted.value, there, n=3, cutoff=0.0)
    return TrackError(
        str(path),
        f"no fix has {column}={wanted.value}; nearest of the {len(there)} there: {', '.join(near)}",
        f"use --track-id {column}={near[0]}, or another of them",
    )
