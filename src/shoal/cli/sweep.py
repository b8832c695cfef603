"""shoal sweep: many scenarios, many runs, a store that can be interrupted and resumed."""

import os
from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import Parameter

from shoal.cli.numbers import Integer, MaybeInteger, MaybeNumber, MaybeSteps
from shoal.cli.output import write
from shoal.cli.progress import note
from shoal.cli.startup import load_compiler
from shoal.cli.sweep_progress import sweep_progress

_MOST_RUNS = 10_000_000


def sweep(
    scenario: str,
    /,
    *,
    out: Path | None = None,
    vary: Annotated[list[str] | None, Parameter(negative=(), consume_multiple=False)] = None,
    runs: MaybeInteger = None,
    jobs: MaybeInteger = None,
    device: Literal["cpu", "cuda"] = "cpu",
    executor: Literal["local", "dask"] = "local",
    scheduler: str | None = None,
    steps: MaybeSteps = None,
    seed: MaybeInteger = None,
    assignments: Annotated[list[str] | None, Parameter(name="--set", negative=(), consume_multiple=False)] = None,
    until_ci: MaybeNumber = None,
    max_runs: Integer = 50,
    independent: Annotated[bool, Parameter(negative=())] = False,
    retry_failed: Annotated[bool, Parameter(negative=())] = False,
    dry_run: Annotated[bool, Parameter(negative=())] = False,
) -> None:
    """Run every combination of varied fields, several times each; the same command again resumes.

    Parameters
    ----------
    scenario
        A preset's name, a scenario file, or a design file (TOML with [vary] or [[points]]).
    out
        Folder of the store: runs.sqlite while running, results.csv when done.
    vary
        FIELD=1,2,3 or FIELD=from:to:step (end included); may be repeated. Shorthands: neighbors, fast, agents,
        target-speed, strategy; any other field by its path, such as strategy.delta.
    runs
        Replicates of each combination; default 5. Run r shares its chance in all of them (see --independent).
    jobs
        Threads, or Dask workers; default one per core.
    device
        Where runs happen: the processor's cores (cpu), or a graphics card (cuda), all at once; see docs/how-to/gpu.md.
    executor
        Where runs happen: threads here, or Dask.
    scheduler
        Address of a running Dask scheduler; without it, worker processes are started here.
    steps
        Time-steps of a run, or its duration, such as "2 h".
    seed
        Seed of all chance.
    assignments
        Any field by its path, for all combinations; may be repeated.
    until_ci
        Add replicates to each combination until the 95 % interval of its time on target is narrower than this.
    max_runs
        The most replicates of each combination then.
    independent
        Give every combination a seed of its own.
    retry_failed
        Run again what failed before.
    dry_run
        Print the design, the number of runs and an estimate of the time; run nothing.
    """
    load_compiler()
    from shoal.cli.options import as_options, check_asked, check_positive, given_changes
    from shoal.core.errors import ScenarioError
    from shoal.experiments.cells import make_cells
    from shoal.experiments.executors import on_dask
    from shoal.experiments.on_card import executor_on
    from shoal.experiments.results import seal
    from shoal.experiments.sweep import Stop, probe
    from shoal.experiments.sweep import sweep as run_sweep
    from shoal.run.on_card import check_device

    design = _design(scenario, vary or [], runs)
    check_positive(runs=design.runs, jobs=jobs, max_runs=max_runs, until_ci=until_ci)
    if scheduler and executor != "dask":
        raise ScenarioError("--scheduler", "is of Dask", "add --executor dask, or leave it out")
    if device == "cuda" and executor == "dask":
        raise ScenarioError("--device cuda", "is a card of this machine, not of Dask's", "leave out one of the two")
    options = [(f"--{name}", name) for name, value in (("steps", steps), ("seed", seed)) if value is not None]
    varied = as_options("--vary", vary or []) or [(f"{scenario} {field}", field) for field in design.fields]
    check_asked(design.scenario, [*options, *as_options("--set", assignments or []), *varied])
    changes = given_changes(assignments, steps=steps, seed=seed)
    cells = make_cells(design, changes, independent=independent)
    total = len(cells) * design.runs
    if total > _MOST_RUNS:
        raise ScenarioError("--runs", f"makes {total:,} runs in all", f"ask for {_MOST_RUNS:,} at most")
    if dry_run:
        for cell in cells:
            write(", ".join(f"{name}={value}" for name, value in cell.shown.items()) + "\n")
        seconds = probe(cells, design.runs, jobs or os.cpu_count() or 1)
        write(f"{len(cells)} combinations x {design.runs} runs = {total} runs, about {seconds:.0f} s\n")
        return
    if out is None:
        raise ScenarioError("--out", "is missing", "name the folder of the store: --out DIR")
    check_device(device, [cell.scenario for cell in cells])
    execute = on_dask(scheduler, jobs) if executor == "dask" else executor_on(device, jobs)
    with sweep_progress(out) as report:
        rows = run_sweep(
            design,
            out,
            changes=changes,
            executor=execute,
            until=Stop(until_ci, max_runs) if until_ci else None,
            independent=independent,
            retry_failed=retry_failed,
            report=report,
        )
    failed = sum(row["status"] == "failed" for row in rows)
    table = seal(out, rows)
    note(f"{len(rows)} runs in {out} ({failed} failed); table: {table}")
    note(f"next: shoal results {out}   shoal plot {out}")
    if failed:
        first = next(row["error"] for row in rows if row["status"] == "failed")
        note(f"first failure: {first}\n  fix: correct it, then add --retry-failed")


def _design(source: str, vary: list[str], runs: int | None) -> Any:
    from dataclasses import replace

    from shoal.core.errors import ScenarioError
    from shoal.experiments.design import Design, grid, is_design_file, parse_vary, read_design

    if is_design_file(source):
        if vary:
            raise ScenarioError("--vary", f"{source} is a design already", "put the field under [vary] there")
        design = read_design(source)
        return replace(design, runs=runs) if runs else design
    return Design(source, tuple(grid(dict(map(parse_vary, vary)))), runs or 5)
