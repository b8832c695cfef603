"""What a store holds, and how it is known to be what was written.

`meta` has a name and JSON per row: the identity of the sweep, its format, the checksum of both, and `content`: how many
rows `runs` has and the sum of their checksums, changed in the same transaction as they are. Format 1 had no checksums,
format 2 the list of metrics in its identity.

A metric is a column of numbers. A store that is resumed with a metric more gains a column, behind `checksum`, where
rows from before have nothing; one whose package is not installed keeps its column, and new rows have nothing there.
"""

import hashlib
import json
import math
import sqlite3
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Self

from shoal.core.errors import RecordError
from shoal.core.version import RESULTS_VERSION, VERSION
from shoal.experiments.cells import Cell
from shoal.experiments.rows import LIST_COLUMNS, Row
from shoal.metrics.summary import METRICS

FORMAT = 3
IDENTITY = ("scenario", "fields", "changes", "independent", "results_version")

SCHEMA = f"""
CREATE TABLE meta (name TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE runs (
    run_id TEXT PRIMARY KEY, scenario_hash TEXT NOT NULL, seed NOT NULL, run INTEGER NOT NULL,
    point TEXT NOT NULL, status TEXT NOT NULL, error TEXT NOT NULL,
    {", ".join(f'"{name}" REAL' for name in METRICS)},
    {", ".join(f"{name} TEXT" for name in LIST_COLUMNS)},
    shoal_version TEXT NOT NULL, results_version INTEGER NOT NULL, checksum TEXT NOT NULL);
CREATE TABLE timing (run_id TEXT PRIMARY KEY, started TEXT NOT NULL, seconds REAL NOT NULL);
"""

_LARGEST = 1e30  # of what a metric can be
_WORDS = ("run_id", "scenario_hash", "point", "status", "error", "shoal_version")


@dataclass(frozen=True)
class Meta:
    """The format of a store and what its sweep runs."""

    format: int
    identity: dict[str, Any]


@dataclass(frozen=True)
class Content:
    """How many rows there are, and the sum of their checksums, whatever their order."""

    rows: int = 0
    total: int = 0

    def plus(self, checksum: str) -> Self:
        """With one row more."""
        return type(self)(self.rows + 1, (self.total + int(checksum, 16)) % 2**256)

    def less(self, checksum: str) -> Self:
        """With one row less."""
        return type(self)(self.rows - 1, (self.total - int(checksum, 16)) % 2**256)

    @classmethod
    def read(cls, database: sqlite3.Connection) -> Self:
        """As it was written last."""
        (value,) = database.execute("SELECT value FROM meta WHERE name = 'content'").fetchone()
        rows, total = json.loads(value)
        return cls(rows, int(total, 16))

    def write(self, database: sqlite3.Connection) -> None:
        """Remember it."""
        value = json.dumps([self.rows, f"{self.total:064x}"])
        database.execute("INSERT OR REPLACE INTO meta VALUES ('content', ?)", (value,))

    def check(self, stored: Iterable[dict[str, Any]], added: Collection[str]) -> None:
        """Refuse rows that are not those that were written; `added` are the columns that some are older than.

        Raises
        ------
        ValueError : a row was changed, removed or added
        """
        found = Content()
        for row in stored:
            if row["checksum"] != _sum_of_row(row, added):
                raise ValueError(f"run {row['run_id']} is not what was written")
            found = found.plus(row["checksum"])
        if found != self:
            raise ValueError(f"it has {found.rows} rows, which are not the {self.rows} that were written")


def check_tables(database: sqlite3.Connection) -> None:
    """Refuse a database of something else.

    Raises
    ------
    ValueError : it is not one of ours
    """
    kinds = {(each["type"], each["tbl_name"]) for each in database.execute("SELECT type, tbl_name FROM sqlite_master")}
    tables = {name for kind, name in kinds if kind == "table"}
    if not {"meta", "runs", "timing"} <= tables or {kind for kind, _ in kinds} - {"table", "index"}:
        raise ValueError("runs.sqlite has not the tables of a sweep")


@dataclass(frozen=True)
class Columns:
    """The metrics that a store has a column of, and those of them that some rows are older than."""

    metrics: tuple[str, ...]
    added: tuple[str, ...]

    @classmethod
    def read(cls, database: sqlite3.Connection) -> Self:
        """As the table is."""
        kinds = {each["name"]: each["type"] for each in database.execute("PRAGMA table_info(runs)")}
        names = list(kinds)
        added = names[names.index("checksum") + 1 :] if "checksum" in names else []  # format 1 had none
        if any(kinds[name] != "REAL" for name in added):
            raise ValueError(f"runs.sqlite has a column {added[0]!r}, which is not a metric")
        return cls(tuple(name for name, kind in kinds.items() if kind == "REAL"), tuple(added))

    @property
    def missing(self) -> list[str]:
        """Metrics that there are, and have no column."""
        return [name for name in METRICS if name not in self.metrics]

    @property
    def unknown(self) -> list[str]:
        """Metrics that have a column, and whose package is not installed."""
        return [name for name in self.metrics if name not in METRICS]


def add_columns(database: sqlite3.Connection, names: Iterable[str], identity: dict[str, Any]) -> None:
    """Give a store columns of new metrics, which its rows have nothing in."""
    database.execute("BEGIN IMMEDIATE")
    for name in names:
        database.execute(f'ALTER TABLE runs ADD COLUMN "{name}" REAL')
    write_meta(database, identity)


def write_meta(database: sqlite3.Connection, identity: dict[str, Any]) -> None:
    """Write what the sweep runs."""
    values = {name: json.dumps(identity[name]) for name in IDENTITY} | {"format": json.dumps(FORMAT)}
    database.execute("DELETE FROM meta WHERE name != 'content'")
    database.executemany("INSERT INTO meta VALUES (?, ?)", [*values.items(), ("checksum", _sum_of(values))])


def read_meta(database: sqlite3.Connection, where: str) -> Meta:
    """What the sweep runs.

    Raises
    ------
    RecordError : of a newer Shoal
    ValueError, KeyError : damaged
    """
    values = {row["name"]: row["value"] for row in database.execute("SELECT name, value FROM meta")}
    layout = json.loads(values.get("format", "1"))
    identity = {name: json.loads(values[name]) for name in IDENTITY}
    for name, version, newest in (
        ("format", layout, FORMAT),
        ("results version", identity["results_version"], RESULTS_VERSION),
    ):
        if type(version) is not int or version < 1:
            raise ValueError(f"{name} {version!r} has never been")
        if version > newest:
            problem = f"is of {name} {version}; this Shoal ({VERSION}) knows up to {newest}"
            raise RecordError(where, problem, "install a newer Shoal to read it")
    if layout > 1 or "checksum" in values:
        written = {name: value for name, value in values.items() if name not in ("checksum", "content")}
        if layout < 2 or values["checksum"] != _sum_of(written):
            raise ValueError("what it says of the sweep is not what was written")
    fields = identity["fields"]
    if not isinstance(fields, list) or not all(isinstance(each, str) for each in fields):
        raise ValueError("the fields that it varies are not names")
    return Meta(layout, identity)


def make_rows(
    entries: Iterable[tuple[Cell, int, Row]], columns: Columns
) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
    """Yield what is stored of each finished run: its row of `runs`, and of `timing`."""
    for cell, run, row in entries:
        seed = cell.scenario.seed
        stored = {
            "run_id": cell.run_id(run),
            "scenario_hash": cell.scenario.hash,
            "seed": seed if seed < 2**63 else str(seed),  # SQLite's whole numbers end there
            "run": run,
            "point": json.dumps(cell.shown),
            "status": row["status"],
            "error": row["error"].encode("utf-8", "backslashreplace").decode(),
            **{name: _number(row.get(name)) for name in columns.metrics},
            **{name: json.dumps(row[name]) for name in LIST_COLUMNS},
            "shoal_version": VERSION,
            "results_version": RESULTS_VERSION,
        }
        timing = {"run_id": stored["run_id"], "started": row["started"], "seconds": row["seconds"]}
        yield stored | {"checksum": _sum_of_row(stored, columns.added)}, timing


def read_row(stored: dict[str, Any], meta: Meta, columns: Columns) -> Row:
    """A row for people, its point's fields as keys of their own; a metric that it is older than is None.

    Metrics that this Shoal does not know are left out.

    Raises
    ------
    ValueError, KeyError, TypeError : damaged
    """
    row = dict(stored)
    row.pop("checksum", None)
    who = f"run {row['run_id']!r}"
    for name, kind in (*((name, str) for name in _WORDS), ("run", int), ("results_version", int)):
        if type(row[name]) is not kind:
            raise ValueError(f"{who}: {name} is {row[name]!r}")
    rounded = isinstance(row["seed"], float)  # one of 2**63 or more, in format 1
    row["seed"] = int(row["seed"])
    content = f"{row['scenario_hash']}/{row['seed']}/{row['run']}/{row['results_version']}"
    run_id = hashlib.sha256(content.encode()).hexdigest()[:24]
    if row["run"] < 0 or (row["run_id"] != run_id and not (rounded and meta.format == 1)):
        raise ValueError(f"{who} is not the run that it says it is")
    if row["results_version"] != meta.identity["results_version"]:
        raise ValueError(f"{who} is of results version {row['results_version']}")
    point = json.loads(row.pop("point"))
    if not isinstance(point, dict) or not point.keys() <= set(meta.identity["fields"]):
        raise ValueError(f"{who}: its point is {point!r}")
    if row["status"] not in ("done", "failed"):
        raise ValueError(f"{who}: status is {row['status']!r}")
    for name in (*columns.metrics, *columns.missing):
        value = row.setdefault(name, None)
        if value is not None and not (isinstance(value, float) and abs(value) < _LARGEST and row["status"] == "done"):
            raise ValueError(f"{who}: {name} is {value!r}")
    for name in LIST_COLUMNS:
        row[name] = json.loads(row.get(name) or "null")
        if not isinstance(row[name], list if row["status"] == "done" and name in stored else type(None)):
            raise ValueError(f"{who}: {name} is not a list")
    row = {name: value for name, value in row.items() if name not in columns.unknown}
    return {**{field: point.get(field) for field in meta.identity["fields"]}, **row}


def _number(value: Any) -> float | None:
    """As SQLite gives it back."""
    return None if value is None or math.isnan(value) else float(value)


def _sum_of_row(row: dict[str, Any], added: Collection[str]) -> str:
    """SHA-256 of a row; a column that was added counts only where the row has something, for older ones had it not."""
    return _sum_of({name: value for name, value in row.items() if value is not None or name not in added})


def _sum_of(values: dict[str, Any]) -> str:
    """SHA-256 of a row's values, its checksum excepted."""
    rest = {name: value for name, value in values.items() if name != "checksum"}
    return hashlib.sha256(json.dumps(rest, sort_keys=True, separators=(",", ":")).encode()).hexdigest()
