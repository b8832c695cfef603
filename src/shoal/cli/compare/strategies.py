"""shoal compare STRATEGIES: in one scenario, or in every variation of it."""

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from shoal.cli.compare.runs import store_folder, tell_failures
from shoal.cli.progress import note
from shoal.cli.sweep_progress import sweep_progress

RUNS = 20


def compare_strategies(
    named: Sequence[str],
    scenario: str,
    *,
    runs: int | None,
    steps: int | None,
    seed: int | None,
    vary: list[str],
    assignments: list[str],
    metric: str,
    baseline: str | None,
    jobs: int | None,
    out: Path | None,
    figure: Path | None,
    as_json: bool,
) -> None:
    """Run what is missing, and print a table per condition."""
    from shoal.cli.compare.data import comparison_data
    from shoal.cli.compare.figure import comparison_figure
    from shoal.cli.compare.table import print_comparison
    from shoal.cli.options import given_changes
    from shoal.core.errors import ScenarioError
    from shoal.experiments.cells import make_cells
    from shoal.experiments.compare import comparison_design, run_comparison, values_of
    from shoal.experiments.comparison import compare, direction_of
    from shoal.experiments.compiled_first import compiled_first
    from shoal.experiments.contenders import contenders
    from shoal.experiments.design import parse_vary
    from shoal.experiments.executors import in_threads
    from shoal.metrics.summary import METRICS

    if metric not in METRICS:
        raise ScenarioError(f"--metric {metric}", "is no metric", f"there are: {', '.join(METRICS)}")
    everybody = contenders(named)
    baseline = _baseline(baseline, [each.name for each in everybody])
    changes = given_changes(assignments, steps=steps, seed=seed)
    design = comparison_design(scenario, everybody, runs or RUNS, dict(map(parse_vary, vary)))
    shown = make_cells(design, changes)[0].scenario
    with store_folder(out) as folder, sweep_progress(out) as report:
        execute = compiled_first(in_threads(jobs), note)
        found = run_comparison(design, everybody, folder, changes=changes, executor=execute, report=report)
    tell_failures(row for _, strategies in found for rows in strategies.values() for row in rows)
    direction = direction_of(metric)
    table = {_told(point): (point, values_of(strategies, metric)) for point, strategies in found}
    comparison = compare(table, baseline, {each.name for each in everybody if each.informed}, direction)
    if figure:
        from shoal.drawing.files import save_figure

        save_figure(comparison_figure(comparison, metric), figure)
        note(f"figure: {figure}")
    about = {"scenario": scenario, "runs": design.runs, "steps": shown.steps, "seed": shown.seed}
    if as_json:
        sys.stdout.write(json.dumps(comparison_data(comparison, metric, direction, about)) + "\n")
    else:
        print_comparison(comparison, metric, direction, about)
    if out:
        note(f"all runs: {out} (shoal results {out})")


def _baseline(asked: str | None, names: list[str]) -> str:
    from shoal.core.errors import ScenarioError

    if asked is None:
        return names[0]
    if asked not in names:
        raise ScenarioError(f"--baseline {asked}", "is not compared", f"there are: {', '.join(names)}")
    return asked


def _told(point: dict[str, Any]) -> str:
    return ", ".join(f"{name.replace('_', ' ')} {value}" for name, value in point.items())
