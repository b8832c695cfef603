"""Compare strategies from Python: the same seeds for all, beside the motionless lattice."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from shoal.core.errors import ScenarioError, UnknownNameError, did_you_mean
from shoal.core.keywords import lists_keywords, split_keywords
from shoal.core.sheet import Sheet
from shoal.experiments.cells import make_cells
from shoal.experiments.comparison import Comparison, Condition, Standing
from shoal.experiments.comparison import compare as compare_values
from shoal.experiments.comparison_words import (
    difference_text,
    family_text,
    name_text,
    p_text,
    rank_text,
    value_text,
)
from shoal.experiments.compiled_first import compiled_first, say_nothing
from shoal.experiments.contenders import contenders, with_parameters
from shoal.experiments.executors import Executor
from shoal.experiments.on_card import executor_on
from shoal.experiments.rows import Row
from shoal.experiments.run_comparison import comparison_design, run_comparison, values_of
from shoal.experiments.sweep import Progress
from shoal.metrics.summary import METRICS, bounds_of
from shoal.record.names import label_of
from shoal.record.tables import data_frame
from shoal.scenario.edit import check_words
from shoal.scenario.load import Source
from shoal.strategies.plugins import name_of
from shoal.study.folder import positive, progress_of, store_folder
from shoal.study.varied import Values, varied, written

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

    from shoal.drawing.style import Width

RUNS = 20
Found = list[tuple[dict[str, Any], dict[str, list[Row | None]]]]  # by condition, the rows of each strategy


@dataclass(frozen=True, repr=False)
class Compared:
    """What a comparison found. A notebook shows its table; `plot` draws it, `to_pandas` gives the numbers.

    Attributes
    ----------
    metric, direction : what was compared; 1 more is better, -1 less is better, 0 neither
    scenario, runs, steps, seed : of what
    comparison : baseline and standings under every condition
    found : by condition, the row of every run of each strategy
    """

    metric: str
    direction: int
    scenario: str
    runs: int
    steps: int
    seed: int
    comparison: Comparison
    found: Found

    @property
    def baseline(self) -> str:
        """The strategy that all others are compared with."""
        return self.comparison.baseline

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """Standings under every condition, best first."""
        return self.comparison.conditions

    @property
    def failures(self) -> list[str]:
        """The errors of runs that failed; they are left out in pairs."""
        return [row["error"] for row in self._rows() if row["status"] == "failed"]

    def to_pandas(self, what: Literal["standings", "runs"] = "standings") -> "pandas.DataFrame":
        """Return a tidy table (extra: sweep).

        Parameters
        ----------
        what : standings - a row per condition and strategy: rank, mean, low, high (95 %), runs, missing, and the
            difference from the baseline with its interval, p, adjusted p and verdict
            runs - a row per condition, strategy and run, with every metric

        Raises
        ------
        UnknownNameError : another table
        MissingExtraError : pandas is not installed
        """
        tables = {"standings": self._standings, "runs": self._runs}
        if what not in tables:
            raise UnknownNameError.of("table", what, tables)
        return data_frame(tables[what](), "a comparison as a DataFrame")

    def plot(self, width: "Width" = "double") -> "Figure":
        """Draw curves if one number varies, else bars: a panel per condition (extra: plots).

        Parameters
        ----------
        width : of one column of a journal (single), or of two (double)
        """
        from shoal.drawing.style import style
        from shoal.study.comparison_figure import comparison_figure

        with style():
            return comparison_figure(self.comparison, self.metric, width)

    def __repr__(self) -> str:
        """The table."""
        return self._sheet().text()

    def _repr_html_(self) -> str:
        """The table for a notebook."""
        return self._sheet().html()

    def _sheet(self) -> Sheet:
        several = len(self.conditions) > 1
        titles = ("", "strategy", METRICS[self.metric].words, f"minus {self.baseline}", "adj. p", "verdict")
        better = {1: "more is better", -1: "less is better", 0: "neither more nor less is better"}[self.direction]
        runs = f"{self.runs} run{'s' * (self.runs != 1)} of {self.steps:,} steps"
        failed = len(self.failures)
        return Sheet(
            head=f"{self.scenario}: {runs}, seed {self.seed}; {label_of(self.metric)}, {better}",
            titles=("condition", *titles) if several else titles,
            rows=[
                (condition.name, *_cells(each)) if several else _cells(each)
                for condition in self.conditions
                for each in condition.standings
            ],
            note=(f"{failed} runs failed and are left out in pairs. " if failed else "")
            + family_text(f"all {self.comparison.tests} comparisons"),
            words=("condition", "strategy", "verdict"),
        )

    def _standings(self) -> list[dict[str, Any]]:
        return [{**condition.point, **_numbers(each)} for condition in self.conditions for each in condition.standings]

    def _runs(self) -> list[dict[str, Any]]:
        return [
            {**point, "strategy": strategy, **{name: value for name, value in row.items() if name != "strategy"}}
            for point, strategies in self.found
            for strategy, rows in strategies.items()
            for row in rows
            if row
        ]

    def _rows(self) -> list[Row]:
        return [row for _, strategies in self.found for rows in strategies.values() for row in rows if row]


class CompareOptions(NamedTuple):
    """What `compare` compares and how it runs, see there; its other words change the scenario."""

    runs: int = RUNS
    vary: Mapping[str, Values] | None = None
    metric: str = "time_on_target"
    baseline: str | None = None
    jobs: int | None = None
    device: str = "cpu"
    out: str | Path | None = None
    progress: Callable[[int, int], None] | None = None


@lists_keywords(CompareOptions)
def compare(
    strategies: Sequence[Any] | str | Path | Callable[..., Any], scenario: Source = "oceans2020", **changes: Any
) -> Compared:
    """Run strategies with the same seeds, and return ranks, paired differences and what is left after correction.

    >>> shoal.compare(["knn-pso", "encircle"], runs=10, steps=5000)

    Parameters
    ----------
    strategies : names (see shoal.list_strategies), Python files, or functions made with @shoal.strategy; the motionless
        lattice is always added
    scenario : a preset's name, a TOML file, a dict or a Scenario; its own strategy keeps its parameters there
    runs : of each strategy under each condition
    vary : {field: values}: compare under every combination, as in shoal.sweep
    metric : what is compared, see shoal.list_metrics
    baseline : the strategy that all others are compared with; default the first
    jobs : threads, one run each; default one per core
    device : cpu, or cuda: on a graphics card, thousands at once, for what docs/how-to/gpu.md lists
    out : keep all runs in this folder, a store as of a sweep; the same call again resumes
    progress : called as progress(runs done, runs in all) after every run
    changes : to the scenario, in the words of the command line, as in `Scenario.with_`; or to a strategy by its name,
        such as **{"encircle.ring": 147}

    Raises
    ------
    ScenarioError, StrategyError : what cannot run; nothing was run then
    RecordError : `out` is another study's, is in use, or cannot be written
    """
    options, changes = split_keywords(CompareOptions, changes)
    positive(runs=options.runs, jobs=options.jobs)
    check_words(changes, also=CompareOptions._fields)
    named = [strategies] if isinstance(strategies, (str, Path)) or callable(strategies) else list(strategies)
    return compared(
        [str(name_of(each)) for each in named],
        scenario,
        {name: written(value) for name, value in changes.items()},
        options,
        executor=compiled_first(executor_on(options.device, options.jobs), say_nothing),
        report=progress_of(options.progress),
    )


def compared(
    named: Sequence[str],
    scenario: Source,
    changes: Mapping[str, Any],
    options: CompareOptions,
    *,
    executor: Executor,
    report: Callable[[Progress], None] | None,
) -> Compared:
    """Run what is missing and compare; what `compare` and the command line have in common.

    Parameters
    ----------
    named : strategies, by name or file
    scenario, changes : what they run in
    options : what is compared; its jobs and progress are ignored, the executor and the report have theirs
    executor : where runs happen
    report : called after every run
    """
    metric, baseline = options.metric, options.baseline
    if metric not in METRICS:
        hint = did_you_mean(metric, METRICS)
        raise ScenarioError(f"metric {metric}", "is not a metric", f"{hint}there are: {', '.join(METRICS)}")
    everybody, changes = with_parameters(contenders(named), changes)
    names = [each.name for each in everybody]
    if baseline is not None and baseline not in names:
        hint = did_you_mean(baseline, names)
        raise ScenarioError(f"baseline {baseline}", "is not compared", f"{hint}there are: {', '.join(names)}")
    design = comparison_design(scenario, everybody, options.runs, varied(options.vary or {}))
    first = make_cells(design, dict(changes))[0].scenario
    with store_folder(options.out) as folder:
        found = run_comparison(design, everybody, folder, changes=dict(changes), executor=executor, report=report)
    direction = METRICS[metric].direction
    table = {_told(point): (point, values_of(strategies, metric)) for point, strategies in found}
    informed = {each.name for each in everybody if each.informed}
    return Compared(
        metric=metric,
        direction=direction,
        scenario=str(scenario) if isinstance(scenario, (str, Path)) else first.name,
        runs=options.runs,
        steps=first.steps,
        seed=first.seed,
        comparison=compare_values(table, baseline or names[0], informed, direction, bounds_of(metric)),
        found=found,
    )


def _cells(each: Standing) -> tuple[str, ...]:
    return (
        rank_text(each),
        name_text(each),
        value_text(each),
        difference_text(each),
        p_text(each.adjusted_p),
        each.verdict,
    )


def _numbers(each: Standing) -> dict[str, Any]:
    low, high = each.value.ci95 or (None, None)
    known = each.difference
    difference_low, difference_high = (known.ci95 if known else None) or (None, None)
    return {
        "strategy": each.strategy,
        "rank": each.rank,
        "mean": each.value.mean,
        "low": low,
        "high": high,
        "runs": len(each.value.runs),
        "missing": each.missing,
        "difference": known.mean if known else None,
        "difference_low": difference_low,
        "difference_high": difference_high,
        "p": known.p if known else None,
        "adjusted_p": each.adjusted_p,
        "verdict": each.verdict,
        "informed": each.informed,
    }


def _told(point: dict[str, Any]) -> str:
    return ", ".join(f"{name.replace('_', ' ')} {value}" for name, value in point.items())
