"""Tune a scenario from Python: the best values of some fields, and what they are worth on fresh seeds."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from shoal.core.keywords import lists_keywords, split_keywords
from shoal.experiments.compiled_first import compiled_first, say_nothing
from shoal.experiments.conditions import conditions_of
from shoal.experiments.executors import Executor
from shoal.experiments.objective import one_objective
from shoal.experiments.on_card import executor_on
from shoal.experiments.sweep import Progress
from shoal.experiments.tune import Search
from shoal.experiments.tune import tune as run_tune
from shoal.experiments.variable import Variable, check_variables
from shoal.scenario.edit import check_words
from shoal.scenario.load import Source
from shoal.study.folder import positive, progress_of, store_folder
from shoal.study.searching import base_scenario, called, check_counted, variables_of
from shoal.study.tuned import Tuned
from shoal.study.varied import written

TRIALS, RUNS, FINAL_RUNS = 50, 5, 20


class TuneOptions(NamedTuple):
    """What `tune` looks for and how it runs, see there; its other words change the scenario."""

    maximize: str | None = None
    minimize: str | None = None
    conditions: Sequence[str] = ()
    trials: int = TRIALS
    runs: int = RUNS
    final_runs: int = FINAL_RUNS
    jobs: int | None = None
    device: str = "cpu"
    out: str | Path | None = None
    progress: Callable[[int, int], None] | None = None


@lists_keywords(TuneOptions)
def tune(scenario: Source, vary: Mapping[str, Any], **changes: Any) -> Tuned:
    """Look for the values of some fields that are best by a metric, and measure them on fresh seeds (extra: tune).

    >>> shoal.tune("oceans2020", {"strategy.delta": (0.002, 0.05), "neighbors": (5, 40)}, maximize="time_on_target")

    Parameters
    ----------
    scenario : a preset's name, a TOML file, a dict or a Scenario
    vary : {field: range or values}: a tuple of two ends or text such as "5:40" is a range, continuous where an end has
        a decimal point; a list or "5,10,20" are values
    maximize, minimize : the metric of which more, or less, is looked for; one of the two
    conditions : under which; the score is the mean over them: the arena's by name, or "target-speed=5,network.loss=0.2"
    trials : points to try; all share their seeds
    runs : of each trial under each condition
    final_runs : of start and winner, on fresh seeds
    jobs : threads, one run each; default one per core
    device : cpu, or cuda: on a graphics card, thousands at once, for what docs/how-to/gpu.md lists
    out : keep all runs in this folder; the same call again resumes, and more trials are added
    progress : called as progress(runs done, runs in all) after every run
    changes : to the scenario, for all trials, as in `Scenario.with_`

    Raises
    ------
    ScenarioError, StrategyError : a range or a scenario that cannot run; nothing was run then
    RecordError : `out` is another study's, is in use, or cannot be written
    MissingExtraError : optuna is not installed
    """
    options, changes = split_keywords(TuneOptions, changes)
    check_words(changes, also=("vary", *TuneOptions._fields))
    return tuned(
        scenario,
        variables_of(vary),
        {name: written(value) for name, value in changes.items()},
        options,
        executor=compiled_first(executor_on(options.device, options.jobs), say_nothing),
        report=progress_of(options.progress),
    )


def tuned(
    scenario: Source,
    variables: Sequence[Variable],
    changes: Mapping[str, Any],
    options: TuneOptions,
    *,
    executor: Executor,
    report: Callable[[Progress], None] | None,
) -> Tuned:
    """Search and measure; what `tune` and the command line have in common.

    Parameters
    ----------
    scenario, variables, changes : what is searched
    options : what for; its jobs and progress are ignored, the executor and the report have theirs
    executor : where runs happen
    report : called after every run
    """
    positive(trials=options.trials, runs=options.runs, final_runs=options.final_runs, jobs=options.jobs)
    goal = one_objective(options.maximize, options.minimize)
    check_variables(variables)
    base = base_scenario(scenario, changes)
    conditions = conditions_of(options.conditions, goal.metric, base)
    check_counted(base, [each.metric for each in conditions])
    search = Search(
        source=scenario,
        changes=dict(changes),
        scenario=base,
        variables=variables,
        objective=goal,
        conditions=conditions,
        trials=options.trials,
        runs=options.runs,
        final_runs=options.final_runs,
    )
    with store_folder(options.out) as folder:
        return Tuned(called(scenario), run_tune(search, folder, executor=executor, report=report))
