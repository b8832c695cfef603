"""The runs of a search: points in, rows out, of every condition; what the stores hold is not run again.

A store per condition, each a sweep like any other. A search keeps nothing else: asked again with the same seed it asks
for the same points, finds their rows, and so goes on where it was, whatever had ended it.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any, Self

from shoal.core.errors import ScenarioError
from shoal.core.version import RESULTS_VERSION
from shoal.experiments.cells import Cell, base_table
from shoal.experiments.condition_point import followed_point
from shoal.experiments.design import Design, Point
from shoal.experiments.executors import Executor, Task
from shoal.experiments.rows import Row
from shoal.experiments.store import Store
from shoal.experiments.suite import SuiteCondition
from shoal.experiments.sweep import Progress, store_all
from shoal.scenario.change import change
from shoal.scenario.edit import apply, lower_degrees
from shoal.scenario.load import Source, name_of_source, scenario_from, table_of
from shoal.scenario.schema import Scenario

Rows = list[list[Row]]  # of a point: by condition, of each run


class Evaluator:
    """Where the points of a search are run, all with the same seeds; use as a context.

    Parameters
    ----------
    scenario, changes : what is searched
    conditions : under which; each has its store in a folder of its own, unless there is one only
    folder : of the stores
    start : what the scenario has of all fields that points may have; the stores show it where a point says nothing
    executor : where runs happen
    report : called after every run with `progress`
    """

    def __init__(
        self,
        scenario: Source,
        changes: Mapping[str, Any],
        conditions: Sequence[SuiteCondition],
        folder: Path,
        start: Point,
        executor: Executor,
        report: Callable[[Progress], None] | None = None,
    ) -> None:
        self.progress = Progress(total=0, before=0)
        self.steps = 0  # of all runs that were asked for, whenever they were run
        self._name = name_of_source(scenario)
        self._execute, self._report, self._start = executor, report, start
        self._searched = change(table_of(scenario), changes)
        self._places: list[tuple[dict[str, Any], Store]] = []
        for each in conditions:
            source = each.scenario or scenario
            said = {**changes, **each.changes}
            if each.scenario:
                said = {"seed": self._searched["seed"], **said, "steps": each.steps or self._searched["steps"]}
            place = folder / each.folder if len(conditions) > 1 else folder
            identity = _identity(Design(source, (start,), 1), said)
            self._places.append((change(table_of(source), said), Store(place, identity)))
        self._rows: list[dict[str, Row]] = []
        self._counted: set[str] = set()
        self._open = ExitStack()

    def __enter__(self) -> Self:
        with ExitStack() as opening:
            for _, store in self._places:
                opening.enter_context(store)
                self._rows.append({row["run_id"]: row for row in store.rows()})
            self._open = opening.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        self._open.close()

    def cells(self, point: Point) -> list[Cell]:
        """The scenario of a point under every condition; a k of more than all others is lowered to them.

        Lengths and times of a strategy that are varied are those of the searched scenario, see `followed_point`.

        Raises
        ------
        ScenarioError : it cannot run
        """
        return [self._cell(base, point) for base, _ in self._places]

    def _cell(self, base: dict[str, Any], point: Point) -> Cell:
        def at(table: dict[str, Any]) -> Callable[[], Scenario]:
            return lambda: cell_of(table, point, self._name).scenario

        cell = cell_of(base, followed_point(point, at(self._searched), at(base)), self._name)
        return Cell({**cell.point, **point, **_lowered(point, cell.scenario)}, cell.scenario)

    def evaluate(self, points: Sequence[Sequence[Cell]], runs: int) -> list[Rows]:
        """Run what is missing of the cells of points, and return their rows.

        Raises
        ------
        StrategyError, RecordError, KeyboardInterrupt : as `sweep`
        """
        for number, (_, store) in enumerate(self._places):
            known = self._rows[number]
            wanted = {cell.run_id(run): (cell, run) for cells in points for cell, run in _runs(cells[number], runs)}
            missing = [task for run_id, task in wanted.items() if run_id not in known]
            new = [run_id for run_id in wanted if run_id not in self._counted]
            self._counted.update(new)
            self.steps += sum(wanted[run_id][0].scenario.steps for run_id in new)
            self.progress.before += sum(run_id in known for run_id in new)
            store_all(self._kept(missing, known), store, self.progress, self._report)
        return [
            [[self._rows[number][cell.run_id(run)] for run in range(runs)] for number, cell in enumerate(cells)]
            for cells in points
        ]

    def _kept(self, missing: list[Task], known: dict[str, Row]) -> Iterator[tuple[Cell, int, Row]]:
        for cell, run, row in self._execute(missing) if missing else ():
            known[cell.run_id(run)] = row
            yield Cell({**self._start, **cell.shown}, cell.scenario), run, row


def cell_of(base: dict[str, Any], point: Point, name: str) -> Cell:
    """Return the cell of a point; where fewer agents are left than k, k is the number of others.

    Raises
    ------
    ScenarioError : it cannot run
    """
    table = apply(base, point)
    if _changes_counts(point):
        counts = [each.get("count") for each in table["fleets"]]
        lower_degrees(table, sum(count for count in counts if isinstance(count, int)))
    values = ", ".join(f"{field}={value}" for field, value in point.items())
    scenario = scenario_from(table, where=f"{name} ({values})" if values else name)
    return Cell({**point, **_lowered(point, scenario)}, scenario)


def _lowered(point: Point, scenario: Scenario) -> Point:
    return {"neighbors": scenario.network.neighbors} if isinstance(point.get("neighbors"), int) else {}


def _changes_counts(point: Point) -> bool:
    return any(field in ("agents", "fast") or field.startswith("fleets") for field in point)


def _runs(cell: Cell, runs: int) -> Iterator[Task]:
    for run in range(runs):
        yield cell, run


def _identity(design: Design, changes: Point) -> dict[str, Any]:
    return {
        "scenario": base_table(design, changes),
        "fields": design.fields,
        "changes": changes,
        "independent": False,
        "results_version": RESULTS_VERSION,
    }


def first_error(evaluator: Evaluator, points: Sequence[Point]) -> None:
    """Refuse points of which one cannot run.

    Raises
    ------
    ScenarioError : the first that cannot
    """
    for point in points:
        evaluator.cells(point)


def why_nothing(rows: Sequence[Row], values: Sequence[float], metric: str) -> str:
    """Why a trial has no value: the first error of its runs, or that the metric has none in one; else nothing."""
    failed = next((row["error"] for row in rows if row["status"] == "failed"), None)
    if failed is not None:
        return str(failed).splitlines()[0] if failed else "a run failed"
    return "" if all(map(math.isfinite, values)) else f"{metric} has no value in a run"


def cells_or_reason(evaluator: Evaluator, point: Point) -> tuple[list[Cell], str]:
    """Return the cells of a point, or none and why it cannot run."""
    try:
        return evaluator.cells(point), ""
    except ScenarioError as error:
        return [], str(error).splitlines()[0]
