"""The store of a sweep: a folder with runs.sqlite, one row per run, written by one process at a time.

SQLite in WAL mode loses nothing that it has acknowledged, whatever is killed, and every language reads it
(docs/decisions/0003-store.md). Numbers that a rerun reproduces are in `runs`; when and how long is in `timing`.
"""

import json
import os
import sqlite3
from collections.abc import Iterable
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from shoal.core.errors import RecordError
from shoal.experiments.cells import Cell
from shoal.experiments.replicate import LIST_COLUMNS, Row
from shoal.metrics.summary import METRICS
from shoal.version import RESULTS_VERSION, VERSION

_IDENTITY = ("scenario", "fields", "changes", "independent", "results_version", "metrics")

_SCHEMA = f"""
CREATE TABLE IF NOT EXISTS meta (name TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE IF NOT EXISTS runs (
    run_id TEXT PRIMARY KEY, scenario_hash TEXT NOT NULL, seed INTEGER NOT NULL, run INTEGER NOT NULL,
    point TEXT NOT NULL, status TEXT NOT NULL, error TEXT NOT NULL,
    {", ".join(f"{name} REAL" for name in METRICS)},
    {", ".join(f"{name} TEXT" for name in LIST_COLUMNS)},
    shoal_version TEXT NOT NULL, results_version INTEGER NOT NULL);
CREATE TABLE IF NOT EXISTS timing (run_id TEXT PRIMARY KEY, started TEXT NOT NULL, seconds REAL NOT NULL);
"""


class Store:
    """The open store of a sweep; use as a context.

    Parameters
    ----------
    folder : where it is or shall be
    identity : what the sweep runs; a store made by another sweep refuses it
    read_only : look only, needs no identity

    Raises
    ------
    RecordError : another process is writing, another sweep made it, no store to read, or the disk refuses
    """

    def __init__(self, folder: str | Path, identity: dict[str, Any] | None = None, *, read_only: bool = False) -> None:
        self.folder = Path(folder)
        self._identity = identity
        self._read_only = read_only
        self._lock: sqlite3.Connection | None = None

    def __enter__(self) -> Self:
        file = self.folder / "runs.sqlite"
        if self._read_only and not file.is_file():
            raise RecordError(
                str(self.folder), "holds no sweep (it has no runs.sqlite)", "name a folder of shoal sweep"
            )
        try:
            if not self._read_only:
                self.folder.mkdir(parents=True, exist_ok=True)
                self._lock = self._take_lock()
            self._database = sqlite3.connect(file, check_same_thread=False, timeout=30.0)
            self._database.row_factory = sqlite3.Row
            if not self._read_only:
                self._database.execute("PRAGMA journal_mode=WAL")
                self._database.execute("PRAGMA synchronous=NORMAL")
                with self._database:
                    self._database.executescript(_SCHEMA)
                    self._check_identity()
        except (OSError, sqlite3.Error) as error:
            self.close()
            raise RecordError(str(self.folder), f"cannot be opened: {error}", "name a folder you may write") from error
        except RecordError:
            self.close()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Release the database and the lock."""
        for connection in (getattr(self, "_database", None), self._lock):
            if connection is not None:
                connection.close()

    def status(self) -> dict[str, str]:
        """Status of every run that has a row, by run id."""
        return {row["run_id"]: row["status"] for row in self._database.execute("SELECT run_id, status FROM runs")}

    def add(self, entries: Iterable[tuple[Cell, int, Row]]) -> None:
        """Write rows in one transaction; a run that has a row gets the new one.

        Raises
        ------
        RecordError : the disk refuses; what was acknowledged before stays
        """
        runs, timing = [], []
        for cell, run, row in entries:
            run_id = cell.run_id(run)
            runs.append(
                {
                    "run_id": run_id,
                    "scenario_hash": cell.scenario.hash,
                    "seed": str(cell.scenario.seed),
                    "run": run,
                    "point": json.dumps(cell.shown),
                    **{name: row[name] for name in ("status", "error", *METRICS)},
                    **{name: json.dumps(row[name]) for name in LIST_COLUMNS},
                    "shoal_version": VERSION,
                    "results_version": RESULTS_VERSION,
                }
            )
            timing.append({"run_id": run_id, "started": row["started"], "seconds": row["seconds"]})
        try:
            with self._database:
                for table, rows in (("runs", runs), ("timing", timing)):
                    for each in rows:
                        names = ", ".join(each)
                        values = ", ".join(f":{name}" for name in each)
                        self._database.execute(f"INSERT OR REPLACE INTO {table} ({names}) VALUES ({values})", each)
        except sqlite3.Error as error:
            raise RecordError(
                str(self.folder), f"cannot be written: {error}", "free space, then run it again"
            ) from error

    def rows(self) -> list[Row]:
        """All rows, ordered by their point's values and run; the point's fields are keys of their own."""
        fields: list[str] = json.loads(self.meta()["fields"])
        rows = []
        for stored in self._database.execute("SELECT * FROM runs"):
            row = dict(stored)
            point = json.loads(row.pop("point"))
            for name in LIST_COLUMNS:
                row[name] = json.loads(row[name])
            rows.append({**{field: point.get(field) for field in fields}, **row})
        return sorted(rows, key=lambda row: (*(_sortable(row[field]) for field in fields), row["run"], row["run_id"]))

    def timing(self) -> dict[str, dict[str, Any]]:
        """When each run started and how long it took, by run id."""
        return {row["run_id"]: dict(row) for row in self._database.execute("SELECT * FROM timing")}

    def meta(self) -> dict[str, str]:
        """What the sweep runs, as stored when it was begun."""
        return {row["name"]: row["value"] for row in self._database.execute("SELECT name, value FROM meta")}

    def _take_lock(self) -> sqlite3.Connection:
        """Hold an exclusive lock that the operating system releases however this process ends."""
        lock = sqlite3.connect(self.folder / "lock.sqlite", timeout=0.0, isolation_level=None, check_same_thread=False)
        holder = self.folder / "lock.pid"
        try:
            lock.execute("BEGIN EXCLUSIVE")
        except sqlite3.OperationalError:
            lock.close()
            who = holder.read_text(encoding="utf-8").strip() if holder.is_file() else "another process"
            raise RecordError(
                str(self.folder), f"is being written by {who}", "wait until it ends, or use another folder"
            ) from None
        holder.write_text(f"process {os.getpid()}\n", encoding="utf-8")
        return lock

    def _check_identity(self) -> None:
        """Remember what this sweep runs, or refuse to mix it with what another one ran."""
        wanted = {name: json.dumps((self._identity or {})[name]) for name in _IDENTITY}
        known = self.meta()
        differences = [
            difference
            for name, value in known.items()
            for difference in _differences(name, json.loads(value), json.loads(wanted[name]))
        ]
        if differences:
            raise RecordError(
                str(self.folder),
                f"was made by another sweep: {'; '.join(differences)}",
                "use another folder, or the same command as before",
            )
        for name, value in wanted.items():
            self._database.execute("INSERT OR IGNORE INTO meta VALUES (?, ?)", (name, value))


def _differences(path: str, then: Any, now: Any) -> list[str]:
    """Every field that two identities do not share, as "path: value then, value now"."""
    if isinstance(then, dict) and isinstance(now, dict):
        names = dict.fromkeys([*then, *now])
        return [each for name in names for each in _differences(f"{path}.{name}", then.get(name), now.get(name))]
    return [] if then == now else [f"{path}: {json.dumps(then)} then, {json.dumps(now)} now"]


def _sortable(value: Any) -> tuple[int, Any]:
    """Numbers by value before words, fields without a value first."""
    if value is None:
        return (0, 0)
    return (1, value) if isinstance(value, (int, float)) else (2, str(value))
