"""Tune a scenario from Python: the best values of some fields, and what they are worth on fresh seeds."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from shoal.core.errors import MissingExtraError
from shoal.core.keywords import lists_keywords, split_keywords
from shoal.core.sheet import Sheet
from shoal.core.version import RESULTS_VERSION
from shoal.experiments.compiled_first import compiled_first
from shoal.experiments.conditions import conditions_of
from shoal.experiments.executors import Executor
from shoal.experiments.objective import one_objective
from shoal.experiments.on_card import executor_on
from shoal.experiments.start import value_of
from shoal.experiments.sweep import Progress
from shoal.experiments.tune import Search, TuneResult
from shoal.experiments.tune import tune as run_tune
from shoal.experiments.variable import Variable, check_variables
from shoal.record.statistics import Estimate
from shoal.record.words import interval_text, mean_text, spread_text
from shoal.scenario.edit import check_words
from shoal.scenario.load import Source
from shoal.scenario.schema import Scenario
from shoal.study.folder import positive, progress_of, store_folder
from shoal.study.searching import base_scenario, called, shown, variables_of
from shoal.study.varied import written

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

TRIALS, RUNS, FINAL_RUNS = 50, 5, 20


@dataclass(frozen=True, repr=False)
class Tuned:
    """What tuning found. A notebook shows start and best; `plot` draws the search, `to_pandas` gives the trials.

    Attributes
    ----------
    scenario : what was tuned
    result : trials, winner, and what start and winner are worth on fresh seeds
    """

    scenario: str
    result: TuneResult

    @property
    def best(self) -> dict[str, Any]:
        """The best values of all fields that varied."""
        return {**self.start, **self.result.winner.point}

    @property
    def start(self) -> dict[str, Any]:
        """The values that the scenario has."""
        search = self.result.search
        return {each.field: value_of(search.scenario, each.field) for each in search.variables}

    @property
    def best_scenario(self) -> Scenario:
        """The scenario with the best values, to be run or written down."""
        return self.result.search.scenario.with_(**self.result.winner.point)

    @property
    def best_value(self) -> Estimate:
        """What the best is worth on fresh seeds."""
        return self.result.winner_value

    @property
    def start_value(self) -> Estimate:
        """What the start is worth on fresh seeds."""
        return self.result.start_value

    def to_pandas(self) -> "pandas.DataFrame":
        """Return a row per trial: fields, mean over its runs, value of each run, why it has none (extra: sweep).

        Raises
        ------
        MissingExtraError : pandas is not installed
        """
        try:
            import pandas as pd
        except ImportError:
            raise MissingExtraError.of("pandas", "sweep", "a search as a DataFrame") from None
        trials = self.result.trials
        return pd.DataFrame([{**self.start, **trial.point, "mean": trial.mean, "runs": list(trial.values),
                              "reason": trial.reason} for trial in trials])  # fmt: skip

    def plot(self) -> "Figure":
        """Draw the value of every trial, and that of start and best on fresh seeds (extra: plots)."""
        from shoal.drawing.search import Measured, search_figure

        result = self.result
        measured = [
            Measured(name, value.mean, *(value.ci95 or (None, None)))
            for name, value in (("start", result.start_value), ("best", result.winner_value))
        ]
        at = result.trials.index(result.winner)
        return search_figure([each.mean for each in result.trials], at, measured, result.search.objective.words)

    def to_dict(self) -> dict[str, Any]:
        """Return all of it as `shoal tune --json` prints it."""
        result, search = self.result, self.result.search
        return {
            "scenario": self.scenario, "objective": search.objective.metric, "direction": search.objective.optuna,
            "conditions": [each.name for each in search.conditions],
            "trials": len(result.trials) - 1, "runs": search.runs, "final_runs": search.final_runs,
            "steps": search.scenario.steps, "seed": search.scenario.seed, "all_steps": result.steps,
            "results_version": RESULTS_VERSION,
            "start": {"values": self.start, "search": _finite(result.start.mean), **_numbers(result.start_value)},
            "best": {"values": self.best, "search": _finite(result.winner.mean), **_numbers(result.winner_value)},
            "difference": {"mean": _finite(result.difference.mean), "ci95": result.difference.ci95,
                           "p": result.difference.p, "pairs": result.difference.pairs},
            "flattered": _finite(result.flattered), "verdict": result.verdict,
            "failed": [each.reason for each in result.trials if each.reason],
        }  # fmt: skip

    def __repr__(self) -> str:
        """The table, and what it says."""
        return "\n".join([self._sheet().text(), *self._sentences()])

    def _repr_html_(self) -> str:
        """The table for a notebook."""
        return self._sheet(" ".join(self._sentences())).html()

    def _sheet(self, note: str = "") -> Sheet:
        result, search = self.result, self.result.search
        start, best = self.start, self.best
        values = (result.start_value, result.winner_value)
        where = f" under {len(search.conditions)} conditions" if len(search.conditions) > 1 else ""
        return Sheet(
            head=f"{self.scenario}: {len(result.trials) - 1} trials of {search.runs} runs of "
            f"{search.scenario.steps:,} steps{where}, seed {search.scenario.seed}; {search.objective.words}, "
            f"{'more' if search.objective.direction > 0 else 'less'} is better",
            titles=("", "start", "best"),
            rows=[
                *((name, shown(start[name]), shown(best[name])) for name in start),
                ("in the search", f"{result.start.mean:.4f}", f"{result.winner.mean:.4f}"),
                ("on fresh seeds", *map(mean_text, values)),
                ("95 % interval", *map(interval_text, values)),
            ],
            note=note,
            words=("",),
        )

    def _sentences(self) -> list[str]:
        result = self.result
        failed = [each.reason for each in result.trials if each.reason]
        told = [f"{len(failed)} trials have no value, the first: {failed[0]}"] if failed else []
        if result.winner is result.start:
            return [*told, "no trial was better than the start"]
        gap = result.difference
        low, high = gap.ci95 or (None, None)
        ends = spread_text(gap.mean, low, high, 4)
        p = "" if gap.p is None else f", p {gap.p:.2g}"
        return [
            *told,
            f"best - start, {gap.pairs} pairs of runs on fresh seeds: {gap.mean:+.4f}{ends}{p}: {result.verdict}",
            f"the search made the best look {abs(result.flattered):.4f} "
            f"{'better' if result.flattered >= 0 else 'worse'} than it is (winner's curse): trust the fresh seeds",
        ]


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
        executor=compiled_first(executor_on(options.device, options.jobs), _say_nothing),
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
    search = Search(
        source=scenario,
        changes=dict(changes),
        scenario=base,
        variables=variables,
        objective=goal,
        conditions=conditions_of(options.conditions, goal.metric, base),
        trials=options.trials,
        runs=options.runs,
        final_runs=options.final_runs,
    )
    with store_folder(options.out) as folder:
        return Tuned(called(scenario), run_tune(search, folder, executor=executor, report=report))


def _numbers(value: Estimate) -> dict[str, Any]:
    return {"mean": _finite(value.mean), "ci95": value.ci95, "runs": list(value.runs)}


def _finite(value: float) -> float | None:
    return value if abs(value) < float("inf") else None


def _say_nothing(message: str) -> None:
    """A library never prints."""
