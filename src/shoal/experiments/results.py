"""The rows of a sweep for people: aggregated with intervals, as a table for others, as a DataFrame."""

import csv
import io
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from shoal.core.errors import MissingExtraError, ScenarioError
from shoal.core.files import MARK, write_atomic
from shoal.core.version import VERSION
from shoal.experiments.rows import LIST_COLUMNS, Row
from shoal.experiments.store import Store
from shoal.metrics.summary import METRICS, bounds_of
from shoal.record.statistics import estimate

_OF_A_RUN = ("run_id", "run", "seed", "scenario_hash", "status", "error", "started", "seconds")  # columns, no fields


def read_rows(folder: str | Path) -> tuple[list[str], list[Row]]:
    """Return the fields that a sweep varies and all its rows, in the order of their values.

    Raises
    ------
    RecordError : the folder holds no sweep
    """
    with Store(folder, read_only=True) as store:
        return store.fields, store.rows()


def unknown_metrics(folder: str | Path) -> list[str]:
    """Metrics that a sweep has numbers of, of packages that are not installed; rows leave them out.

    Raises
    ------
    RecordError : the folder holds no sweep
    """
    with Store(folder, read_only=True) as store:
        return store.unknown_metrics


def varied_rows(results: Any) -> tuple[list[str], list[Row]]:
    """Return the fields that vary and all rows of a sweep: its folder, its rows, or the DataFrame of `load_results`.

    Raises
    ------
    RecordError : the folder holds no sweep
    """
    if isinstance(results, (str, Path)):
        return read_rows(results)
    table = results.to_dict("records") if hasattr(results, "to_dict") else results
    rows = [{"status": "done", **row} for row in table]
    fields = [name for name in (rows[0] if rows else {}) if name not in (*METRICS, *LIST_COLUMNS, *_OF_A_RUN)]
    return [name for name in fields if len({str(row[name]) for row in rows}) > 1], rows


def default_x(fields: Sequence[str], rows: Sequence[Row]) -> str:
    """Return the numeric field with most values.

    Raises
    ------
    ScenarioError : there is none
    """
    numeric = [name for name in fields if all(isinstance(row[name], (int, float)) for row in rows)]
    if not numeric:
        known = f"choose one of: {', '.join(fields)}" if fields else "vary one, such as --vary neighbors=10,20,30"
        raise ScenarioError("x", "no varied field is a number", known)
    return max(numeric, key=lambda name: len({row[name] for row in rows}))


def aggregate(rows: Sequence[Row], by: Sequence[str], metrics: Sequence[str] = tuple(METRICS)) -> list[Row]:
    """Return one row per combination of the fields `by`: runs, and mean, low, high of each metric (95 %, over runs).

    Raises
    ------
    ScenarioError : a field that no row has
    """
    unknown = [name for name in by if rows and name not in rows[0]]
    if unknown:
        known = [name for name in rows[0] if name not in LIST_COLUMNS]
        raise ScenarioError(f"--by {unknown[0]}", "is not a column of this sweep", f"there are: {', '.join(known)}")
    groups: dict[tuple[Any, ...], list[Row]] = {}
    for row in rows:
        if row["status"] == "done":
            groups.setdefault(tuple(row[name] for name in by), []).append(row)
    return [
        {**dict(zip(by, key, strict=True)), "runs": len(group), **_intervals(group, metrics)}
        for key, group in groups.items()
    ]


def to_csv(rows: Sequence[Row]) -> str:
    """Rows as CSV; lists as JSON in their cell."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    names = list(rows[0]) if rows else []
    writer.writerow(names)
    for row in rows:
        writer.writerow([json.dumps(row[name]) if isinstance(row[name], list) else row[name] for name in names])
    return stream.getvalue()


def write_parquet(rows: Sequence[Row], file: Path) -> None:
    """Write rows to a parquet file, atomically.

    Raises
    ------
    MissingExtraError : pyarrow is absent
    RecordError : the file cannot be written
    """
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError:
        raise MissingExtraError.of("pyarrow", "sweep", "writing parquet") from None
    stream = io.BytesIO()
    table = pa.Table.from_pylist(list(rows))
    pq.write_table(table.replace_schema_metadata({MARK: VERSION}), stream)
    write_atomic(file, stream.getvalue(), ours=True)


def seal(folder: Path, rows: Sequence[Row]) -> Path:
    """Write the finished table beside the store as results.csv, for those who have no Shoal; return its path.

    It holds what a rerun reproduces, so an interrupted and resumed sweep ends with the same bytes.
    """
    file = folder / "results.csv"
    write_atomic(file, to_csv(rows).encode())
    return file


def _intervals(group: Sequence[Row], metrics: Sequence[str]) -> Row:
    numbers: Row = {}
    for name in metrics:
        known = estimate([row[name] for row in group], bounds=bounds_of(name))
        low, high = known.ci95 or (None, None)
        numbers |= {name: known.mean, f"{name}_low": low, f"{name}_high": high}
    return numbers
