"""shoal design: which fleets to buy, as a front of cost and metric, with intervals."""

import json
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from shoal.cli.numbers import MaybeInteger, MaybeSteps
from shoal.cli.output import write
from shoal.cli.places import check_places
from shoal.cli.progress import note
from shoal.cli.startup import load_compiler
from shoal.cli.sweep_progress import sweep_progress


def design(
    scenario: str,
    /,
    *,
    fleet: Annotated[list[str] | None, Parameter(negative=(), consume_multiple=False)] = None,
    vary: Annotated[list[str] | None, Parameter(negative=(), consume_multiple=False)] = None,
    minimize: str = "cost",
    maximize: str = "time_on_target",
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
    report: Path | None = None,
    json_: Annotated[bool, Parameter(name="--json", negative=())] = False,
) -> None:
    """Look for the fleets that are worth their cost; print the front, on fresh seeds, and what one buoy is worth.

    Parameters
    ----------
    scenario
        A preset's name or a scenario file; its own fleet is measured beside the others.
    fleet
        NAME=FROM:TO@COST: from FROM to TO agents of this fleet, 0 too, each for COST; without @COST at the scenario's
        fleets.cost; NAME=COUNT@COST: so many; may be repeated. Other fleets stay as they are.
    vary
        What else may change: FIELD=FROM:TO, a range, continuous where an end has a decimal point; FIELD=1,2,3, values.
        A k of more than all other agents is lowered to them.
    minimize
        The metric of which less is looked for.
    maximize
        The metric of which more is looked for.
    trials
        Fleets that the sampler tries, and as many at random; default 100.
    runs
        Runs of each, with the same seeds for all; default 3.
    final_runs
        Runs of each fleet of the front on fresh seeds; default 10.
    steps
        Time-steps of a run, or its duration, such as "2 h".
    seed
        Seed of all chance, the search's too.
    assignments
        Any field by its path, for all fleets; may be repeated.
    jobs
        Threads, one run each; default one per core.
    device
        Where runs happen: the processor's cores (cpu), or a graphics card (cuda), all at once; see docs/how-to/gpu.md.
    out
        Keep all runs in this folder; the same command again resumes, with more --trials it goes on.
    figure
        Draw the front to this file (.png, .svg or .pdf).
    width
        Of the figure: one column of a journal (single, 3.5 in) or two (double, 7.16 in).
    report
        Write one page of HTML for whoever buys to this file.
    json_
        Print one JSON object and nothing else.
    """
    load_compiler()
    from shoal.cli.options import as_options, check_asked, check_positive, given_changes
    from shoal.core.files import check_file
    from shoal.experiments.compiled_first import compiled_first
    from shoal.experiments.fleet_range import parse_fleet
    from shoal.experiments.on_card import executor_on
    from shoal.experiments.variable import parse_variable
    from shoal.study.design import FINAL_RUNS, RUNS, TRIALS, DesignOptions, designed

    check_places(out, figure)
    if report:
        from shoal.drawing.style import require_matplotlib

        require_matplotlib()
        check_file(report, ours=True)
    check_positive(trials=trials, runs=runs, final_runs=final_runs, jobs=jobs)
    options = [(f"--{name}", name) for name, value in (("steps", steps), ("seed", seed)) if value is not None]
    check_asked(scenario, [*options, *as_options("--set", assignments or []), *as_options("--vary", vary or [])])
    chosen = DesignOptions(minimize, maximize, trials or TRIALS, runs or RUNS, final_runs or FINAL_RUNS, out=out)
    searched = list(map(parse_fleet, fleet or [])), list(map(parse_variable, vary or []))
    changes = given_changes(assignments, steps=steps, seed=seed)
    execute = compiled_first(executor_on(device, jobs), note)
    with sweep_progress(out) as tell:
        found = designed(scenario, searched, changes, chosen, executor=execute, report=tell)
    write(json.dumps(found.to_dict()) + "\n" if json_ else f"{found!r}\n")
    if figure:
        from shoal.drawing.files import save_figure

        save_figure(found.plot(width), figure)
        note(f"figure: {figure}")
    if report:
        found.report(report)
        note(f"page: {report}")
    if out:
        note(f"all runs: {out / 'search'} and {out / 'final'} (shoal results {out / 'final'})")
