"""shoal tune: the best values of some fields, and what they are worth on fresh seeds."""

import json
from pathlib import Path
from shlex import quote
from typing import Annotated, Literal

from cyclopts import Parameter

from shoal.cli.numbers import MaybeInteger, MaybeSteps
from shoal.cli.output import write
from shoal.cli.places import check_places
from shoal.cli.progress import note
from shoal.cli.startup import load_compiler
from shoal.cli.sweep_progress import sweep_progress


def tune(
    scenario: str,
    /,
    *,
    vary: Annotated[list[str] | None, Parameter(negative=(), consume_multiple=False)] = None,
    maximize: str | None = None,
    minimize: str | None = None,
    condition: Annotated[list[str] | None, Parameter(negative=(), consume_multiple=False)] = None,
    trials: MaybeInteger = None,
    runs: MaybeInteger = None,
    final_runs: MaybeInteger = None,
    steps: MaybeSteps = None,
    seed: MaybeInteger = None,
    assignments: Annotated[list[str] | None, Parameter(name="--set", negative=(), consume_multiple=False)] = None,
    jobs: MaybeInteger = None,
    device: Literal["cpu", "cuda"] = "cpu",
    out: Path | None = None,
    figure: Path | None = None,
    width: Literal["single", "double"] = "double",
    json_: Annotated[bool, Parameter(name="--json", negative=())] = False,
) -> None:
    """Look for the best values of some fields; print what they are worth on fresh seeds, beside the start.

    Parameters
    ----------
    scenario
        A preset's name or a scenario file; its values are the start.
    vary
        FIELD=FROM:TO, a range, continuous where an end has a decimal point; FIELD=1,2,3 or FIELD=from:to:step, values;
        may be repeated.
    maximize
        The metric of which more is looked for; this or --minimize.
    minimize
        The metric of which less is looked for.
    condition
        Look at several conditions at once, by their mean; may be repeated: one of the arena's by its name, such as
        "half lost"; as-it-is; or changes, target-speed=5,network.loss=0.2.
    trials
        Points to try; default 50.
    runs
        Runs of each point under each condition, with the same seeds for all; default 5.
    final_runs
        Runs of start and best on fresh seeds; default 20.
    steps
        Time-steps of a run, or its duration, such as "2 h".
    seed
        Seed of all chance, the search's too.
    assignments
        Any field by its path, for all trials; may be repeated.
    jobs
        Threads, one run each; default one per core.
    device
        Where runs happen: the processor's cores (cpu), or a graphics card (cuda), all at once; see docs/how-to/gpu.md.
    out
        Keep all runs in this folder; the same command again resumes, with more --trials it goes on.
    figure
        Draw the search to this file (.png, .svg or .pdf).
    width
        Of the figure: one column of a journal (single, 3.5 in) or two (double, 7.16 in).
    json_
        Print one JSON object and nothing else.
    """
    load_compiler()
    from shoal.cli.options import as_options, check_asked, check_positive, given_changes
    from shoal.experiments.compiled_first import compiled_first
    from shoal.experiments.on_card import executor_on
    from shoal.experiments.variable import parse_variable
    from shoal.study.tune import FINAL_RUNS, RUNS, TRIALS, TuneOptions, tuned

    check_places(out, figure)
    check_positive(trials=trials, runs=runs, final_runs=final_runs, jobs=jobs)
    options = [(f"--{name}", name) for name, value in (("steps", steps), ("seed", seed)) if value is not None]
    check_asked(scenario, [*options, *as_options("--set", assignments or []), *as_options("--vary", vary or [])])
    chosen = TuneOptions(
        maximize, minimize, condition or (), trials or TRIALS, runs or RUNS, final_runs or FINAL_RUNS, out=out
    )
    variables = list(map(parse_variable, vary or []))
    changes = given_changes(assignments, steps=steps, seed=seed)
    execute = compiled_first(executor_on(device, jobs), note)
    with sweep_progress(out) as report:
        found = tuned(scenario, variables, changes, chosen, executor=execute, report=report)
    write(json.dumps(found.to_dict()) + "\n" if json_ else f"{found!r}\n")
    if figure:
        from shoal.drawing.files import save_figure

        save_figure(found.plot(width), figure)
        note(f"figure: {figure}")
    if not json_ and found.result.verdict == "better":
        best = [f"{name}={value}" for name, value in found.result.winner.point.items()]
        assigned = " ".join(f"--set {quote(each)}" for each in [*(assignments or []), *best])
        note(f"next: shoal run {quote(scenario)} {assigned}")
    if out:
        note(f"all runs: {out / 'search'} and {out / 'final'} (shoal results {out / 'final'})")
