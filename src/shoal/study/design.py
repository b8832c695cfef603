"""Design a fleet from Python: what to buy, as a front of cost and metric."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from shoal.core.errors import ScenarioError
from shoal.core.keywords import lists_keywords, split_keywords
from shoal.experiments.compiled_first import compiled_first, say_nothing
from shoal.experiments.executors import Executor
from shoal.experiments.fleet_front import design_fleets
from shoal.experiments.fleet_range import FleetRange, check_fleets, fleet_range, parse_fleet
from shoal.experiments.fleet_trial import FleetSearch
from shoal.experiments.objective import objective
from shoal.experiments.on_card import executor_on
from shoal.experiments.sweep import Progress
from shoal.experiments.variable import Variable
from shoal.scenario.edit import check_words
from shoal.scenario.load import Source
from shoal.study.designed import Designed
from shoal.study.folder import positive, progress_of, store_folder
from shoal.study.searching import base_scenario, called, check_counted, variables_of
from shoal.study.varied import written

TRIALS, RUNS, FINAL_RUNS = 100, 3, 10


class DesignOptions(NamedTuple):
    """What `design` looks for and how it runs, see there; its other words change the scenario."""

    minimize: str = "cost"
    maximize: str = "time_on_target"
    trials: int = TRIALS
    runs: int = RUNS
    final_runs: int = FINAL_RUNS
    jobs: int | None = None
    device: str = "cpu"
    out: str | Path | None = None
    progress: Callable[[int, int], None] | None = None


@lists_keywords(DesignOptions)
def design(
    scenario: Source, fleets: Mapping[str, Any], vary: Mapping[str, Any] | None = None, **changes: Any
) -> Designed:
    """Look for the fleets that are worth their cost, and measure them on fresh seeds (extra: tune).

    >>> shoal.design("oceans2020", {"BoB-1": (0, 30, 3), "BoB-0": (0, 45, 1)}, {"neighbors": (4, 40)}, steps=5000)

    Parameters
    ----------
    scenario : a preset's name, a TOML file, a dict or a Scenario; its own fleet is measured beside the others
    fleets : {name: (fewest, most, cost of one)}, or (fewest, most) at the scenario's cost, or text such as "0:30@3"
    vary : what else may change, as in `shoal.tune`; a k of more than all other agents is lowered to them
    minimize, maximize : the metric of which less, and the one of which more is looked for
    trials : fleets that the sampler tries, and as many at random; all share their seeds
    runs : of each trial
    final_runs : of every fleet of the front, on fresh seeds
    jobs : threads, one run each; default one per core
    device : cpu, or cuda: on a graphics card, thousands at once, for what docs/how-to/gpu.md lists
    out : keep all runs in this folder; the same call again resumes, and more trials are added
    progress : called as progress(runs done, runs in all) after every run
    changes : to the scenario, for all trials, as in `Scenario.with_`

    Raises
    ------
    ScenarioError, StrategyError : a fleet, a range or a scenario that cannot run; nothing was run then
    RecordError : `out` is another study's, is in use, or cannot be written
    MissingExtraError : optuna is not installed
    """
    options, changes = split_keywords(DesignOptions, changes)
    check_words(changes, also=("fleets", "vary", *DesignOptions._fields))
    return designed(
        scenario,
        (_ranges(fleets), variables_of(vary or {})),
        {name: written(value) for name, value in changes.items()},
        options,
        executor=compiled_first(executor_on(options.device, options.jobs), say_nothing),
        report=progress_of(options.progress),
    )


def designed(
    scenario: Source,
    searched: tuple[Sequence[FleetRange], Sequence[Variable]],
    changes: Mapping[str, Any],
    options: DesignOptions,
    *,
    executor: Executor,
    report: Callable[[Progress], None] | None,
) -> Designed:
    """Search and measure; what `design` and the command line have in common.

    Parameters
    ----------
    scenario, changes : what is designed
    searched : fleets, and what else varies
    options : what for; its jobs and progress are ignored, the executor and the report have theirs
    executor : where runs happen
    report : called after every run
    """
    positive(trials=options.trials, runs=options.runs, final_runs=options.final_runs, jobs=options.jobs)
    less, more = objective(options.minimize, -1), objective(options.maximize, 1)
    base = base_scenario(scenario, changes)
    check_counted(base, [less.metric, more.metric])
    fleets, variables = searched
    check_fleets(fleets, base, costs=less.metric == "cost")
    search = FleetSearch(
        source=scenario,
        changes=dict(changes),
        scenario=base,
        fleets=fleets,
        variables=variables,
        less=less,
        more=more,
        trials=options.trials,
        runs=options.runs,
        final_runs=options.final_runs,
    )
    with store_folder(options.out) as folder:
        return Designed(called(scenario), design_fleets(search, folder, executor=executor, report=report))


def _ranges(fleets: Mapping[str, Any]) -> list[FleetRange]:
    if not isinstance(fleets, Mapping):
        raise ScenarioError("fleets", f"is {fleets!r:.60}", 'write fleets={"BoB-1": (0, 30, 3)}')
    return [_range(name, value) for name, value in fleets.items()]


def _range(name: str, value: Any) -> FleetRange:
    if isinstance(value, str):
        return parse_fleet(f"{name}={value}")
    given = [written(each) for each in value] if isinstance(value, (tuple, list)) else [value, value]
    numbers = all(type(each) in (int, float) for each in given)
    if not (2 <= len(given) <= 3 and numbers and all(type(each) is int for each in given[:2])):
        raise ScenarioError(f"fleets {name}", f"is {value!r:.60}", "write (fewest, most, cost of one), or a count")
    return fleet_range(name, given[0], given[1], given[2] if len(given) == 3 else None, f"fleets {name}")
