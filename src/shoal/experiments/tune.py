"""Tune: look for the values of some fields that are best by one metric, then measure what they are really worth.

All trials share their seeds (common random numbers). The best of many noisy values is flattered by chance: what is
reported is the winner's value on fresh seeds, that no trial has seen, beside that of the start on the same seeds.
"""

import hashlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.core.errors import ScenarioError
from shoal.core.files import check_folder
from shoal.experiments.asker import Asker
from shoal.experiments.design import Point
from shoal.experiments.evaluator import Evaluator, Rows, cells_or_reason, first_error, why_nothing
from shoal.experiments.executors import Executor
from shoal.experiments.objective import Objective
from shoal.experiments.paired import SIGNIFICANT, Difference, paired_difference
from shoal.experiments.rows import Row
from shoal.experiments.start import value_of
from shoal.experiments.suite import SuiteCondition
from shoal.experiments.sweep import Progress
from shoal.experiments.variable import Variable
from shoal.metrics.summary import Bounds
from shoal.record.statistics import Estimate, estimate
from shoal.scenario.edit import refuse_contradictions
from shoal.scenario.load import Source
from shoal.scenario.schema import Scenario

TOGETHER = 4  # trials that are asked for before the first of them is told; more would learn later
STORES = ("search", "final")

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Search:
    """What is tuned.

    Attributes
    ----------
    source, changes, scenario : as given, its changes, and the two as one
    variables, objective, conditions : what may change, what for, and where
    trials, runs, final_runs : points to try, runs of each under each condition, and of start and winner at the end
    """

    source: Source
    changes: Point
    scenario: Scenario
    variables: Sequence[Variable]
    objective: Objective
    conditions: Sequence[SuiteCondition]
    trials: int = 50
    runs: int = 5
    final_runs: int = 20

    @property
    def bounds(self) -> Bounds:
        """Between which values the score lies."""
        shares = all(each.metric != self.objective.metric or each.out_of != 1 for each in self.conditions)
        return Bounds(0.0, 1.0) if shares else self.objective.bounds


@dataclass(frozen=True)
class Trial:
    """A point that was tried: its value in every run, (R,), or why it has none."""

    point: Point
    values: tuple[float, ...]
    reason: str = ""

    @property
    def mean(self) -> float:
        """Over the runs; NaN where one of them failed."""
        return float(np.mean(self.values)) if self.values else float("nan")


@dataclass(frozen=True)
class TuneResult:
    """What a search found.

    Attributes
    ----------
    trials : every point that was tried, in order; the first is the start
    winner : the best of them, by the runs of the search
    start_value, winner_value : on fresh seeds
    difference : winner less start, in pairs, on fresh seeds
    steps : of all runs
    """

    search: Search
    trials: tuple[Trial, ...]
    winner: Trial
    start_value: Estimate
    winner_value: Estimate
    difference: Difference
    steps: int

    @property
    def start(self) -> Trial:
        """The scenario as it is, in the search."""
        return self.trials[0]

    @property
    def flattered(self) -> float:
        """By how much the search thought the winner better than it is: the winner's curse."""
        return (self.winner.mean - self.winner_value.mean) * self.search.objective.direction

    @property
    def verdict(self) -> str:
        """Better, worse, or no difference shown, of the winner against the start."""
        p = self.difference.p
        if self.winner is self.start or p is None or p >= SIGNIFICANT:
            return "no difference shown"
        return "better" if self.difference.mean * self.search.objective.direction > 0 else "worse"


def tune(
    search: Search, folder: Path, *, executor: Executor, report: Callable[[Progress], None] | None = None
) -> TuneResult:
    """Search, and measure start and winner on fresh seeds; the same call again goes on in the folder.

    Raises
    ------
    ScenarioError : the start, or an end of a range, cannot run; nothing was run then
    StrategyError, RecordError, KeyboardInterrupt : as `sweep`
    MissingExtraError : optuna is not installed
    """
    asker = Asker(search.variables, [search.objective], "tpe", search.scenario.seed)
    start = {each.field: value_of(search.scenario, each.field) for each in search.variables}
    check_fields(search.scenario, list(start), search.changes, search.conditions)
    evaluator = Evaluator(search.source, search.changes, search.conditions, folder / "search", start, executor, report)
    ends = [{each.field: end} for each in search.variables for end in each.ends]
    first_error(evaluator, [{}, *ends])
    check_folder(folder, STORES)
    with evaluator:
        total = len(search.conditions) * (search.runs * (search.trials + 1) + 2 * search.final_runs)
        evaluator.progress.total = total
        trials = _trials(search, start, asker, evaluator)
        progress, steps = evaluator.progress, evaluator.steps
    winner = best_of(trials, search.objective)
    fresh = {**search.changes, "seed": fresh_seed(search.scenario.seed)}
    with Evaluator(search.source, fresh, search.conditions, folder / "final", start, executor, report) as evaluator:
        evaluator.progress = progress
        rows = evaluator.evaluate([evaluator.cells({}), evaluator.cells(winner.point)], search.final_runs)
        steps += evaluator.steps
    start_values, winner_values = (scores(each, search.conditions) for each in rows)
    return TuneResult(
        search=search,
        trials=tuple(trials),
        winner=winner,
        start_value=_estimate(start_values, search.bounds),
        winner_value=_estimate(winner_values, search.bounds),
        difference=paired_difference(winner_values, start_values, search.bounds),
        steps=steps,
    )


def scores(rows: Rows, conditions: Sequence[SuiteCondition]) -> Floats:
    """Return the mean over conditions of what counts there, in every run, (R,); NaN where a run failed."""
    values = [
        [_value(row, each.metric) / each.out_of for row in found] for each, found in zip(conditions, rows, strict=True)
    ]
    mean: Floats = np.array(values, float).mean(axis=0)
    return mean


def fresh_seed(seed: int) -> int:
    """Return a seed whose chance no run of the search has seen."""
    return int.from_bytes(hashlib.sha256(f"fresh/{seed}".encode()).digest()[:6], "big")


def best_of(trials: Sequence[Trial], objective: Objective) -> Trial:
    """Return the trial with the best mean, the first of equals.

    Raises
    ------
    ScenarioError : none has a value
    """
    known = [each for each in trials if np.isfinite(each.mean)]
    if not known:
        reason = trials[0].reason or "every run failed or has no value"
        raise ScenarioError(objective.metric, f"no trial has a value: {reason}", "correct the scenario or the metric")
    return max(known, key=lambda each: each.mean * objective.direction)


def _trials(search: Search, start: Point, asker: Asker, evaluator: Evaluator) -> list[Trial]:
    """The start, then what the sampler asks for, some at a time."""
    cells = evaluator.cells({})
    (rows,) = evaluator.evaluate([cells], search.runs)
    found = [_trial({}, rows, search)]
    if np.isfinite(found[0].mean):
        asker.learn(start, [found[0].mean])
    for begun in range(0, search.trials, TOGETHER):
        asked = [asker.ask() for _ in range(min(TOGETHER, search.trials - begun))]
        settled = [(trial, point, *cells_or_reason(evaluator, point)) for trial, point in asked]
        rows_of = iter(evaluator.evaluate([cells for _, _, cells, _ in settled if cells], search.runs))
        for trial, point, cells, reason in settled:
            known = _trial(cells[0].point, next(rows_of), search) if cells else Trial(point, (), reason)
            asker.tell(trial, [known.mean] if np.isfinite(known.mean) else None)
            found.append(known)
    return found


def _trial(point: Point, rows: Rows, search: Search) -> Trial:
    values = scores(rows, search.conditions)
    reason = why_nothing([row for found in rows for row in found], values.tolist(), search.objective.metric)
    return Trial(point, tuple(map(float, values)), reason)


def check_fields(
    scenario: Scenario, varied: Sequence[str], changes: Iterable[str], conditions: Sequence[SuiteCondition] = ()
) -> None:
    """Refuse a field that is set by two, of what varies, changes and conditions.

    Raises
    ------
    ScenarioError : it names both
    """
    table: dict[str, Any] = scenario.model_dump(mode="json")
    asked = [(f"--vary {field}", field) for field in varied] + [(f"--set {name}", name) for name in changes]
    refuse_contradictions(table, asked)
    for each in conditions:
        refuse_contradictions(table, [*asked, *((f"--condition {each.name}", name) for name in each.changes)])


def _value(row: Row, metric: str) -> float:
    return float(row[metric]) if row["status"] == "done" and row[metric] is not None else float("nan")


def _estimate(values: Floats, bounds: Bounds) -> Estimate:
    """Of the runs that have a value; none where none has."""
    known = values[np.isfinite(values)]
    return estimate(known if known.size else values, bounds=bounds)
