"""The store of a sweep: a folder with runs.sqlite, one row per run, written by one process at a time.

SQLite in WAL mode loses nothing that it has acknowledged, whatever is killed, and every language reads it
(docs/decisions/0003-store.md). Numbers that a rerun reproduces are in `runs`; when and how long is in `timing`.
Every row has a checksum, and so has the store (store_rows.py): what was damaged later is refused.
"""

import json
import os
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any, Self
from urllib.parse import quote
from uuid import uuid4

from shoal.core.errors import RecordError, ShoalError, reason_of
from shoal.core.files import OwnFolder
from shoal.core.version import RESULTS_VERSION, VERSION
from shoal.experiments.cells import Cell
from shoal.experiments.rows import Row
from shoal.experiments.store_rows import (
    IDENTITY,
    SCHEMA,
    Columns,
    Content,
    Meta,
    add_columns,
    check_tables,
    make_rows,
    read_meta,
    read_row,
    write_meta,
)
from shoal.scenario.load import scenario_from

_PATIENCE = 30.0  # [s] for readers, which are quick


class Store:
    """The open store of a sweep; use as a context.

    Parameters
    ----------
    folder : where it is or will be
    identity : what the sweep runs; a store made by another sweep refuses it
    read_only : look only, needs no identity

    Raises
    ------
    RecordError : another process is writing, another sweep or results version made it, the folder holds something else,
        it is damaged or of a newer Shoal, or the disk refuses
    """

    def __init__(self, folder: str | Path, identity: dict[str, Any] | None = None, *, read_only: bool = False) -> None:
        self.folder = Path(folder)
        self._where = str(folder)
        self._identity = identity
        self._own = None if read_only else OwnFolder(folder, must_lock=True)
        self._database: sqlite3.Connection | None = None

    def __enter__(self) -> Self:
        try:
            if self._own is not None:
                self._own.claim()
                with self._told():
                    self._make(self._own)
            file = self.folder / "runs.sqlite"
            with self._told():
                if not file.is_file():
                    raise RecordError(
                        self._where, "holds no sweep (it has no runs.sqlite)", "name a folder of shoal sweep"
                    )
                self._database = _connect(file, "rw" if self._own else None)
                check_tables(self._database)
                self._meta = read_meta(self._database, self._where)
                self._columns = Columns.read(self._database)
                if self._own:
                    self._check_identity(self._meta)
                    self.rows()  # before anything is added to it
                    self._add_columns(self._database)
                    self._database.execute("PRAGMA journal_mode=WAL")
                    self._database.execute("PRAGMA synchronous=NORMAL")
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Release the database and the folder."""
        if self._database is not None:
            self._database.close()
            self._database = None
        if self._own is not None:
            self._own.release()

    @property
    def fields(self) -> list[str]:
        """Names of the fields that the sweep varies."""
        return list(self._meta.identity["fields"])

    @property
    def results_version(self) -> int:
        """Of which its numbers are."""
        return int(self._meta.identity["results_version"])

    @property
    def unknown_metrics(self) -> list[str]:
        """Metrics that it has numbers of, and that come from a package which is not installed."""
        return self._columns.unknown

    def status(self) -> dict[str, str]:
        """Status of every run that has a row, by run id."""
        with self._told():
            return {row["run_id"]: row["status"] for row in self._open.execute("SELECT run_id, status FROM runs")}

    def add(self, entries: Iterable[tuple[Cell, int, Row]]) -> None:
        """Write rows in one transaction; a run that has a row gets the new one.

        Raises
        ------
        RecordError : the disk refuses; what was acknowledged before stays
        """
        database = self._open
        try:
            with database:
                content = Content.read(database)
                for stored, timing in make_rows(entries, self._columns):
                    old = database.execute("SELECT checksum FROM runs WHERE run_id = ?", (stored["run_id"],)).fetchone()
                    content = content.less(old["checksum"]) if old else content
                    content = content.plus(stored["checksum"])
                    for table, each in (("runs", stored), ("timing", timing)):
                        names = ", ".join(f'"{name}"' for name in each)
                        values = ", ".join(f":{name}" for name in each)
                        database.execute(f"INSERT OR REPLACE INTO {table} ({names}) VALUES ({values})", each)
                content.write(database)
        except sqlite3.Error as error:
            raise RecordError(self._where, f"cannot be written: {error}", "free space, then run it again") from error

    def rows(self) -> list[Row]:
        """All rows, ordered by their point's values and run; the point's fields are keys of their own.

        Raises
        ------
        RecordError : damaged
        """
        fields = self.fields
        with self._told():
            self._open.execute("BEGIN")  # rows and their sum at one moment, whoever writes
            try:
                stored = [dict(row) for row in self._open.execute("SELECT * FROM runs")]
                if self._meta.format > 1:
                    Content.read(self._open).check(stored, self._columns.added)
            finally:
                self._open.execute("ROLLBACK")
            rows = [read_row(each, self._meta, self._columns) for each in stored]
        return sorted(rows, key=lambda row: (*(_sortable(row[field]) for field in fields), row["run"], row["run_id"]))

    def timing(self) -> dict[str, dict[str, Any]]:
        """When each run started and how long it took, by run id."""
        with self._told():
            return {row["run_id"]: dict(row) for row in self._open.execute("SELECT * FROM timing")}

    @property
    def _open(self) -> sqlite3.Connection:
        assert self._database is not None  # within the context
        return self._database

    def _make(self, own: OwnFolder) -> None:
        """Make an empty store, atomically, where there is none."""
        file = own.place / "runs.sqlite"
        if file.exists():
            return
        own.clean()
        if own.content():
            raise RecordError(self._where, "is not empty, and holds no sweep", "name a new or empty folder")
        partial = own.place / f".shoal-{uuid4().hex}.partial"
        try:
            database = _connect(partial, "rwc", patience=0.0)  # nobody else knows it
            try:
                database.execute("PRAGMA journal_mode=MEMORY")  # no second file that a kill could leave
                with database:
                    database.executescript(SCHEMA)
                    write_meta(database, self._identity or {})
                    Content().write(database)
            finally:
                database.close()
            partial.replace(file)
        finally:
            partial.unlink(missing_ok=True)

    def _add_columns(self, database: sqlite3.Connection) -> None:
        """Make room for metrics that the store is older than."""
        if self._columns.missing:
            with database:
                add_columns(database, self._columns.missing, self._meta.identity)
            self._columns = Columns.read(database)

    def _check_identity(self, meta: Meta) -> None:
        """Refuse to mix what this sweep runs with what another one ran."""
        if meta.identity["results_version"] != (self._identity or {})["results_version"]:
            raise RecordError(
                self._where,
                f"holds numbers of results version {meta.identity['results_version']}, which this Shoal ({VERSION}, "
                f"results version {RESULTS_VERSION}) must not mix with its own",
                "use another folder; shoal results and shoal plot still read this one",
            )
        if meta.format < 2:  # no checksums
            raise RecordError(self._where, "was made by an older Shoal", "use another folder")
        now = _as_json(self._identity or {})
        pairs = {name: (meta.identity[name], now[name]) for name in IDENTITY}
        pairs["scenario"] = _of_today(*pairs["scenario"])
        differences = [each for name, (one, other) in pairs.items() for each in _differences(name, one, other)]
        if differences:
            raise RecordError(
                self._where,
                f"was made by another sweep: {'; '.join(differences)}",
                "use another folder, or the same command as before",
            )

    @contextmanager
    def _told(self) -> Iterator[None]:
        """One error for everything that can be wrong with a file that was not always in our hands."""
        try:
            yield
        except RecordError:
            raise
        except OSError as error:
            raise RecordError(
                self._where, f"cannot be opened: {error.strerror or error}", "name a folder you may write"
            ) from error
        except sqlite3.OperationalError as error:
            raise RecordError(self._where, *_refused(error)) from error
        except Exception as error:
            raise RecordError(self._where, f"is damaged: {reason_of(error)}", _MEND) from error


_MEND = "take runs.sqlite from a backup, or run the sweep again in another folder"


def _refused(error: sqlite3.OperationalError) -> tuple[str, str]:
    """What SQLite refuses and what to do about it."""
    name = getattr(error, "sqlite_errorname", "")
    if name.startswith(("SQLITE_BUSY", "SQLITE_LOCKED", "SQLITE_IOERR_LOCK", "SQLITE_PROTOCOL")):
        problem = "is locked, though no sweep writes it: another program holds it, or this file system does not lock"
        return problem, "close that program, or use a folder on a local disk"
    if name.startswith(("SQLITE_CANTOPEN", "SQLITE_READONLY", "SQLITE_IOERR", "SQLITE_FULL", "SQLITE_PERM")):
        return f"cannot be opened: {error}", "free space, or name a folder that you may write"
    return f"is damaged: {error}", _MEND


def _connect(file: Path, mode: str | None, patience: float | None = None) -> sqlite3.Connection:
    """Open a database; where nothing can be written, as it lies there."""
    if mode is None:
        mode = "rw" if os.access(file, os.W_OK) and os.access(file.parent, os.W_OK) else "ro&immutable=1"
    address = f"file:{quote(os.path.abspath(file))}?mode={mode}"
    database: sqlite3.Connection = sqlite3.connect(
        address, uri=True, check_same_thread=False, timeout=_PATIENCE if patience is None else patience
    )
    database.row_factory = sqlite3.Row
    database.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, 100_000_000)
    database.execute("PRAGMA trusted_schema=OFF")
    database.execute("PRAGMA cell_size_check=ON")
    return database


def _as_json(value: Any) -> Any:
    return json.loads(json.dumps(value))


def _of_today(*tables: Any) -> tuple[Any, ...]:
    """Scenarios with all fields that this Shoal knows, at their defaults where they say nothing; else as they are."""
    try:
        return tuple(scenario_from(table).model_dump(mode="json") for table in tables)
    except ShoalError:
        return tables


def _differences(path: str, then: Any, now: Any) -> list[str]:
    """Every field that two identities do not share, as "path: value then, value now".

    A field that only one of them knows, as another version added it, is no difference where it says nothing.
    """
    if isinstance(then, dict) and isinstance(now, dict):
        both = then.keys() & now.keys()
        says = {name for each in (then, now) for name, value in each.items() if value not in (None, [], {})}
        names = [name for name in dict.fromkeys([*then, *now]) if name in both or name in says]
        return [each for name in names for each in _differences(f"{path}.{name}", then.get(name), now.get(name))]
    if isinstance(then, list) and isinstance(now, list) and len(then) == len(now):
        pairs = enumerate(zip(then, now, strict=True))
        return [each for n, (one, other) in pairs for each in _differences(f"{path}.{n}", one, other)]
    return [] if then == now else [f"{path}: {json.dumps(then)} then, {json.dumps(now)} now"]


def _sortable(value: Any) -> tuple[int, Any]:
    """Numbers by value before words, fields without a value first."""
    if value is None:
        return (0, 0)
    return (1, value) if isinstance(value, (int, float)) else (2, str(value))
