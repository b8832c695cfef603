"""shoal compare STRATEGIES: in one scenario, or in every variation of it."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from shoal.cli.compare.runs import tell_failures
from shoal.cli.output import write
from shoal.cli.progress import note
from shoal.cli.sweep_progress import sweep_progress


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
    device: str,
    out: Path | None,
    figure: Path | None,
    width: Literal["single", "double"],
    as_json: bool,
) -> None:
    """Run what is missing, and print a table per condition."""
    from shoal.cli.compare.data import comparison_data
    from shoal.cli.compare.table import print_comparison
    from shoal.cli.options import as_options, check_asked, given_changes
    from shoal.experiments.compiled_first import compiled_first
    from shoal.experiments.design import parse_vary
    from shoal.experiments.on_card import executor_on
    from shoal.study.compared import RUNS, CompareOptions, compared

    options = [(f"--{name}", name) for name, value in (("steps", steps), ("seed", seed)) if value is not None]
    asked = [("STRATEGIES", "strategy"), *options, *as_options("--set", assignments), *as_options("--vary", vary)]
    check_asked(scenario, asked)
    with sweep_progress(out) as report:
        found = compared(
            named,
            scenario,
            given_changes(assignments, steps=steps, seed=seed),
            CompareOptions(runs or RUNS, dict(map(parse_vary, vary)), metric, baseline, out=out),
            executor=compiled_first(executor_on(device, jobs), note),
            report=report,
        )
    tell_failures(row for _, strategies in found.found for rows in strategies.values() for row in rows)
    about = {"scenario": scenario, "runs": found.runs, "steps": found.steps, "seed": found.seed}
    if as_json:
        write(json.dumps(comparison_data(found.comparison, metric, found.direction, about)) + "\n")
    else:
        print_comparison(found.comparison, metric, found.direction, about)
    if figure:
        from shoal.drawing.files import save_figure

        save_figure(found.plot(width), figure)
        note(f"figure: {figure}")
    if out:
        note(f"all runs: {out} (shoal results {out})")
