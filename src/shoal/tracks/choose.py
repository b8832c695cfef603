"""Choose the one track of a file: the fixes of the vehicle that is named, or of the only one."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import TrackError
from shoal.tracks import names
from shoal.tracks.numbers import without_fills
from shoal.tracks.table import Fixes, Labels, Table, same
from shoal.tracks.times import FIRST_UNIX, LAST_UNIX, unix_times
from shoal.tracks.vehicles import tells_vehicles_apart
from shoal.tracks.wanted import Wanted, column_of, refuse_several, unknown_value

MOST_NOTED = 20  # values of a column of text that may be vehicles


def choose(path: Path, table: Table, wanted: Wanted, day_first: bool | None) -> Fixes:
    """Return the fixes of one track, in the order of the file, those without time or place left out.

    Raises
    ------
    TrackError : the file holds several tracks and none is named, the one that is named is missing, or a value
        cannot be read
    """
    rows = np.arange(len(table.line))
    if not wanted.column and not rows.size:
        raise TrackError(str(path), "holds no fixes", "record or export the track again")
    tried, joined = "", False
    if wanted.column:
        tried = column_of(path, table.columns, wanted)
        rows, joined = _of_value(path, table, tried, wanted)
    named = tried in _identifiers(table) or names.rank(tried) is not None
    settled = wanted.everything or (named and not joined)
    decided = settled or joined
    if not decided:
        decided = _refuse_named(path, table, rows, f"{tried}={wanted.value}" if tried else "the file", tried)
    fixes, present = _fixes(path, table, rows, day_first)
    if not settled:
        _refuse_unnamed(path, table, rows[present], fixes)
    if not decided and not tried:
        fixes = fixes._replace(notes=[*fixes.notes, *_note_columns(table, rows[present])])
    return fixes


def _of_value(path: Path, table: Table, column: str, wanted: Wanted) -> tuple[NDArray[np.intp], bool]:
    """The rows with the value that is wanted, and whether several values are joined."""
    label = table.labels.get(column, Labels(np.zeros(0, np.int32), []))
    matching = np.array([wanted.matches(text) for text in label.values], np.bool_)
    rows = np.flatnonzero(matching[label.codes]) if matching.size else np.zeros(0, np.intp)
    if not rows.size:
        raise unknown_value(path, column, wanted, label.values)
    return rows, len(np.unique(same(label).codes[rows])) > 1


def _identifiers(table: Table) -> list[str]:
    """The columns that tell tracks apart, the best first."""
    if table.identifiers is not None:
        return list(table.identifiers)
    ranked = [(rank, column) for column in table.labels if (rank := names.rank(column)) is not None]
    return [column for _, column in sorted(ranked, key=lambda each: each[0])]


def _refuse_named(path: Path, table: Table, rows: NDArray[np.intp], what: str, tried: str) -> bool:
    """Refuse several tracks by the best identifier, which decides alone; return whether there is one."""
    for column in _identifiers(table):
        label = same(table.labels[column])
        counts = {label.values[code]: count for code, count in Counter(label.codes[rows].tolist()).items()}
        known = sum(count for text, count in counts.items() if text)
        values = len(counts) - ("" in counts)
        once = sum(count == 1 for text, count in counts.items() if text)
        is_the_fix_s = 2 * once > known and not (table.identifiers or names.is_certain(column))
        if not values or column == tried or (is_the_fix_s and values > 1):
            continue
        if values > 1:
            refuse_several(path, what, column, counts)
        return True
    return False


def _fixes(path: Path, table: Table, rows: NDArray[np.intp], day_first: bool | None) -> tuple[Fixes, NDArray[np.bool_]]:
    """The fixes that have time and place, and which rows these are."""
    bad = next((int(row) for row in rows if int(row) in table.bad), None) if table.bad else None
    if bad is not None:
        name, text = table.bad[bad]
        raise TrackError(
            table.place(int(table.line[bad])),
            f"{name} {text.strip()[:40]!r} is not a number",
            "write decimal degrees, or remove the line",
        )
    lat, lon = without_fills(table.lat[rows], table.lon[rows])
    present = ~np.isnan(lat)
    unix, notes = _times(table, rows, present, day_first)
    present &= ~np.isnan(unix)
    if not present.any():
        timeless = not np.isfinite(unix).any()
        raise TrackError(
            str(path),
            "no fix has a time" if timeless and not np.isnan(lat).all() else "every fix lacks its time or position",
            table.untimed if timeless else "export it again",
        )
    missing = int(np.sum(~present))
    fixes = Fixes(
        unix=unix[present],
        lat=lat[present],
        lon=lon[present],
        line=table.line[rows][present],
        place=table.place,
        notes=[*table.notes, *notes, *_note_missing(missing)],
    )
    _check_positions(fixes)
    return fixes, present


def _times(
    table: Table, rows: NDArray[np.intp], present: NDArray[np.bool_], day_first: bool | None
) -> tuple[NDArray[np.float64], list[str]]:
    """Unix times [s] of the rows, NaN where one has no position or time."""
    if isinstance(table.time, np.ndarray):
        unix = np.where(present, np.round(table.time[rows], 6), np.nan)
        outside = np.flatnonzero((unix < FIRST_UNIX) | (unix > LAST_UNIX))
        if outside.size:
            raise TrackError(
                table.place(int(table.line[rows[outside[0]]])),
                f"time {unix[outside[0]]:g} is not a Unix time in the years 1 to 9999",
                "check the units of time, or remove the fix",
            )
        return unix, []
    kept = rows[present]
    texts = [table.time[i] for i in kept.tolist()]
    times, notes = unix_times(
        texts, lambda i: table.place(int(table.line[kept[i]])), day_first=day_first, layout=table.day_first
    )
    unix = np.full(len(rows), np.nan)
    unix[present] = times
    return unix, notes


def _check_positions(fixes: Fixes) -> None:
    for name, values, low, high in (("lat", fixes.lat, -90, 90), ("lon", fixes.lon, -180, 360)):
        outside = np.flatnonzero(~((values >= low) & (values <= high)))
        if outside.size:
            raise TrackError(
                fixes.place(int(fixes.line[outside[0]])),
                f"{name} {values[outside[0]]:g} is outside [{low}, {high}]",
                "correct or remove it; lat and lon are in degrees, and may be swapped",
            )


def _refuse_unnamed(path: Path, table: Table, rows: NDArray[np.intp], fixes: Fixes) -> None:
    """Refuse a column, whatever its name, whose values lie on tracks of their own."""
    for column, label in table.labels.items():
        alike = same(label)
        if not names.is_motion(column) and tells_vehicles_apart(
            fixes, alike.of(rows), attribute=names.is_attribute(column)
        ):
            counts = Counter(alike.values[code] for code in alike.codes[rows].tolist())
            refuse_several(path, "the file", column, counts)


def _note_columns(table: Table, rows: NDArray[np.intp]) -> list[str]:
    """Columns of words, or of numbers one after the other, that repeat: the user may know them as vehicles."""
    notes = []
    for column, label in table.labels.items():
        codes = label.codes[rows]
        counts = Counter(label.values[code] for code in codes.tolist())
        counts.pop("", None)
        words = all(any(map(str.isalpha, text)) for text in counts)
        in_turn = int(np.sum(np.diff(codes) != 0)) == len(counts) - 1
        few = 2 <= len(counts) <= MOST_NOTED and min(counts.values()) > 1
        if few and (words or in_turn) and not names.is_attribute(column):
            notes.append(
                f"All fixes were taken as one track, though {column} has {len(counts)} values: {_shown(counts)}; "
                f"if these are vehicles, name one: --track-id {column}=VALUE."
            )
    return notes


def _shown(counts: Counter[str]) -> str:
    three: Sequence[tuple[str, int]] = counts.most_common(3)
    return ", ".join(f"{text[:30]} ({count} fixes)" for text, count in three) + (" ..." if len(counts) > 3 else "")


def _note_missing(count: int) -> list[str]:
    return [f"Fixes dropped because the file marks them missing: {count}."] if count else []
