"""Run a design: what is pending is what the design wants less what the store has; safe to stop and start again."""

import math
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from shoal.core.version import RESULTS_VERSION
from shoal.experiments.cells import Cell, base_table, make_cells
from shoal.experiments.design import Design, Point
from shoal.experiments.executors import Done, Executor, Task, in_threads
from shoal.experiments.replicate import replicate
from shoal.experiments.rows import Row
from shoal.experiments.store import Store
from shoal.metrics.summary import bounds_of
from shoal.record.statistics import all_alike, estimate

FLUSH_SECONDS = 0.5  # rows are written together this often, or this many at a time
FLUSH_ROWS = 64


@dataclass
class Progress:
    """How far a sweep is: runs wanted, done before, done now, failed now; when the first run began."""

    total: int
    before: int
    done: int = 0
    failed: int = 0
    begun: float = field(default_factory=time.monotonic)

    @property
    def rate(self) -> float:
        """Runs per second."""
        return self.done / max(time.monotonic() - self.begun, 1e-9)

    @property
    def seconds_left(self) -> float:
        """Estimate from the rate so far; infinite before the first run is done."""
        left = self.total - self.before - self.done
        return left / self.rate if self.done else math.inf


@dataclass(frozen=True)
class Stop:
    """When a cell has enough replicates: its interval of time on target is narrower, or it has the most."""

    width: float
    most: int


def sweep(
    design: Design,
    out: str | Path,
    *,
    changes: Point | None = None,
    executor: Executor | None = None,
    until: Stop | None = None,
    independent: bool = False,
    retry_failed: bool = False,
    report: Callable[[Progress], None] | None = None,
) -> list[Row]:
    """Run what is missing of a design into the store at `out`, and return all its rows.

    Parameters
    ----------
    design : base scenario, points and replicates
    changes : changes to the base scenario, for all points
    executor : where runs happen, default threads on this machine
    until : add replicates to each cell until its interval is narrow enough
    independent : a seed of its own for every cell, instead of common random numbers
    retry_failed : run again what failed before
    report : called after every run

    Raises
    ------
    ScenarioError : a point that gives no scenario that can run; nothing was run then
    RecordError : the store is another sweep's, is in use, or cannot be written
    KeyboardInterrupt : interrupted; all finished runs are in the store
    """
    changes = changes or {}
    cells = make_cells(design, changes, independent=independent)
    identity = {
        "scenario": base_table(design, changes),
        "fields": design.fields,
        "changes": changes,
        "independent": independent,
        "results_version": RESULTS_VERSION,
    }
    execute = executor or in_threads()
    with Store(out, identity) as store:
        counts = {id(cell): design.runs for cell in cells}
        while True:
            tasks = _pending(cells, counts, store, retry_failed)
            wanted = sum(counts.values())
            progress = Progress(total=wanted, before=wanted - len(tasks))
            store_all(execute(tasks), store, progress, report)
            retry_failed = False
            if until is None or not _add_replicates(cells, counts, store, until):
                return store.rows()


def probe(cells: Sequence[Cell], runs: int, workers: int) -> float:
    """Estimate the seconds that all runs take, from a short run of up to three cells across the design."""
    spread = [cells[0], cells[len(cells) // 2], cells[-1]] if len(cells) >= 3 else list(cells)
    seconds = 0.0
    for cell in spread:
        steps = min(cell.scenario.steps, 2000)
        short = cell.scenario.model_copy(update={"steps": steps})
        replicate(short.model_copy(update={"steps": 1}), 0)  # compiles
        seconds += replicate(short, 0)["seconds"] * cell.scenario.steps / steps
    return seconds / len(spread) * len(cells) * runs / workers


def _pending(cells: Iterable[Cell], counts: dict[int, int], store: Store, retry_failed: bool) -> list[Task]:
    status = store.status()
    have = {run_id for run_id, state in status.items() if state == "done" or not retry_failed}
    return [(cell, run) for cell in cells for run in range(counts[id(cell)]) if cell.run_id(run) not in have]


def store_all(
    finished: Iterator[Done], store: Store, progress: Progress, report: Callable[[Progress], None] | None
) -> None:
    """Write rows as they come, several in one transaction; whatever ends this, finished rows are written."""
    waiting: list[Done] = []
    written = time.monotonic()
    try:
        for entry in finished:
            if not progress.done:  # what was compiled before it began says nothing of the rate
                progress.begun = max(progress.begun, time.monotonic() - entry[2].get("seconds", 0.0))
            waiting.append(entry)
            progress.done += 1
            progress.failed += entry[2]["status"] == "failed"
            if len(waiting) >= FLUSH_ROWS or time.monotonic() - written > FLUSH_SECONDS:
                store.add(waiting)
                waiting, written = [], time.monotonic()
            if report:
                report(progress)
    finally:
        if waiting:
            store.add(waiting)


def _add_replicates(cells: Iterable[Cell], counts: dict[int, int], store: Store, until: Stop) -> bool:
    """Give every cell whose interval is too wide half as many replicates more; return whether any got some."""
    values: dict[str, list[float]] = {}
    for row in store.rows():
        if row["status"] == "done":
            values.setdefault(f"{row['scenario_hash']}/{row['seed']}", []).append(row["time_on_target"])
    added = False
    for cell in cells:
        found = np.array(values.get(f"{cell.scenario.hash}/{cell.scenario.seed}", [math.nan]))
        known = estimate(found, bounds=bounds_of("time_on_target")).ci95
        wide = known[1] - known[0] > until.width if known else found.size < 2 or not all_alike(found)
        if wide and counts[id(cell)] < until.most:
            counts[id(cell)] = min(until.most, max(2, counts[id(cell)] + math.ceil(counts[id(cell)] / 2)))
            added = True
    return added
