"""Run a comparison: several strategies, the same seeds, one store."""

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from shoal.core.errors import ScenarioError
from shoal.experiments.cells import Cell, make_cells
from shoal.experiments.comparison import Values
from shoal.experiments.contenders import Contender
from shoal.experiments.design import Design, Point, grid
from shoal.experiments.executors import Executor
from shoal.experiments.results import seal
from shoal.experiments.rows import Row
from shoal.experiments.sweep import Progress, sweep
from shoal.scenario.load import Source


def comparison_design(
    scenario: Source, contenders: Sequence[Contender], runs: int, vary: Mapping[str, Sequence[Any]] | None = None
) -> Design:
    """Return the design that runs every contender at every combination of varied fields.

    Raises
    ------
    ScenarioError : a varied field is the strategy's
    """
    own = next((name for name in vary or {} if name.split(".")[0] == "strategy"), None)
    if own:
        raise ScenarioError(f"vary {own}", "strategies are what is compared", "vary a field that all of them share")
    points = [{**each.changes(), **point} for each in contenders for point in grid(vary or {})]
    return Design(scenario, tuple(points), runs)


def run_comparison(
    design: Design,
    contenders: Sequence[Contender],
    out: Path,
    *,
    changes: Point,
    executor: Executor,
    report: Callable[[Progress], None] | None = None,
) -> list[tuple[Point, dict[str, list[Row | None]]]]:
    """Run what is missing into the store at `out`; return, for every condition, the row of each run of each strategy.

    Raises
    ------
    ScenarioError, StrategyError, RecordError, KeyboardInterrupt : as `sweep`
    """
    rows = sweep(design, out, changes=changes, executor=executor, report=report)
    seal(out, rows)
    names = {each.choice: each.name for each in contenders}
    return by_condition(make_cells(design, changes), rows, design.runs, names)


def by_condition(
    cells: Sequence[Cell], rows: Sequence[Row], runs: int, names: Mapping[str, str]
) -> list[tuple[Point, dict[str, list[Row | None]]]]:
    """Sort rows into conditions (the point without the strategy) and strategies, each in the order of its runs.

    A store may hold more than is wanted, of other strategies or older versions of a file: cells say what counts.
    """
    known = {row["run_id"]: row for row in rows}
    found: dict[str, tuple[Point, dict[str, list[Row | None]]]] = {}
    for cell in cells:
        point = {name: value for name, value in cell.point.items() if name.partition(".")[0] != "strategy"}
        _, strategies = found.setdefault(json.dumps(point), (point, {}))
        strategies[names[cell.point["strategy"]]] = [known.get(cell.run_id(run)) for run in range(runs)]
    return list(found.values())


def values_of(strategies: Mapping[str, Sequence[Row | None]], metric: str, out_of: float = 1.0) -> Values:
    """Return a metric / out_of of every run of each strategy, (R,); NaN for a run that failed or has none."""
    return {name: np.array([_value(row, metric) for row in rows]) / out_of for name, rows in strategies.items()}


def _value(row: Row | None, metric: str) -> float:
    return row[metric] if row and row["status"] == "done" and row[metric] is not None else float("nan")
