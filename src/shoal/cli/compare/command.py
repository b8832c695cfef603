"""shoal compare: strategies side by side, with the same seeds, beside the motionless lattice."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from shoal.cli.numbers import MaybeInteger
from shoal.cli.places import check_places
from shoal.cli.startup import load_compiler

SCENARIO, METRIC = "oceans2020", "time_on_target"


def compare(
    *strategies: str,
    scenario: str | None = None,
    suite: str | None = None,
    runs: MaybeInteger = None,
    steps: MaybeInteger = None,
    seed: MaybeInteger = None,
    vary: Annotated[list[str] | None, Parameter(negative=(), consume_multiple=False)] = None,
    assignments: Annotated[list[str] | None, Parameter(name="--set", negative=(), consume_multiple=False)] = None,
    metric: str | None = None,
    baseline: str | None = None,
    jobs: MaybeInteger = None,
    device: Literal["cpu", "cuda"] = "cpu",
    out: Path | None = None,
    figure: Path | None = None,
    width: Literal["single", "double"] = "double",
    markdown: Path | None = None,
    json_: Annotated[bool, Parameter(name="--json", negative=())] = False,
) -> None:
    """Run strategies with the same seeds; print ranks, paired differences and what is left of them after correction.

    Parameters
    ----------
    strategies
        Names (see `shoal strategies`) or Python files that define one; the lattice is always added. With --suite and
        none named: all that come with Shoal.
    scenario
        A preset's name or a TOML file; default oceans2020. Every strategy has its own defaults there; the scenario's
        own strategy keeps the parameters that the scenario gives it.
    suite
        Run a fixed suite of conditions instead, and print a leaderboard: arena or arena-wide.
    runs
        Runs of each strategy under each condition; default 20, or the suite's.
    steps
        Time-steps of a run; default the scenario's, or the suite's.
    seed
        Seed of all chance; run r of every strategy shares its target path and its starts.
    vary
        FIELD=1,2,3 or FIELD=from:to:step (end included): compare under every combination; may be repeated.
    assignments
        Any field by its path, under all conditions, or a strategy's parameter by its name, encircle.ring=147; may be
        repeated.
    metric
        What is compared; default time_on_target.
    baseline
        The strategy that all others are compared with; default the first one named.
    jobs
        Threads, one run each; default one per core.
    device
        Where runs happen: the processor's cores (cpu), or a graphics card (cuda), all at once; see docs/how-to/gpu.md.
    out
        Keep all runs in this folder, a store like any sweep's; the same command again resumes.
    figure
        Draw bars, or curves if one number varies, to this file (.png, .svg or .pdf).
    width
        Of the figure: one column of a journal (single, 3.5 in) or two (double, 7.16 in).
    markdown
        With --suite, write the leaderboard into this page, between its two markers.
    json_
        Print one JSON object and nothing else.
    """
    load_compiler()
    from shoal.cli.compare.strategies import compare_strategies
    from shoal.cli.compare.suite import compare_suite
    from shoal.cli.options import check_positive
    from shoal.core.errors import ScenarioError

    check_places(out, figure)
    check_positive(runs=runs, steps=steps, jobs=jobs)
    if not suite:
        if markdown:
            raise ScenarioError("--markdown", "needs --suite", "add --suite arena; --json gives other comparisons")
        compare_strategies(
            strategies, scenario or SCENARIO, runs=runs, steps=steps, seed=seed, vary=vary or [],
            assignments=assignments or [], metric=metric or METRIC, baseline=baseline, jobs=jobs,
            device=device, out=out, figure=figure, width=width, as_json=json_,
        )  # fmt: skip
        return
    fixed = {"--scenario": scenario, "--vary": vary, "--metric": metric, "--baseline": baseline}
    for name, given in fixed.items():
        if given:
            raise ScenarioError(name, f"does not go with --suite: {suite} has its own", "leave out one of the two")
    if assignments and markdown:
        raise ScenarioError("--set", "does not go with --markdown: its page is of defaults", "leave out one of the two")
    compare_suite(
        strategies, suite, assignments=assignments or [], runs=runs, steps=steps, seed=seed, jobs=jobs, device=device,
        out=out, figure=figure, width=width, markdown=markdown, as_json=json_,
    )  # fmt: skip
