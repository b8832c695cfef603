"""What tuning found, as a table and a figure."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from shoal.core.sheet import Sheet
from shoal.core.version import RESULTS_VERSION
from shoal.experiments.start import value_of
from shoal.experiments.tune import TuneResult
from shoal.record.statistics import Estimate
from shoal.record.tables import data_frame
from shoal.record.words import difference_text, interval_text, mean_text, told
from shoal.scenario.schema import Scenario
from shoal.study.searching import shown

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

    from shoal.drawing.style import Width


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
        trials = self.result.trials
        return data_frame([{**self.start, **trial.point, "mean": trial.mean, "runs": list(trial.values),
                              "reason": trial.reason} for trial in trials], "a search as a DataFrame")  # fmt: skip

    def plot(self, width: "Width" = "double") -> "Figure":
        """Draw the value of every trial, and that of start and best on fresh seeds (extra: plots).

        Parameters
        ----------
        width : of one column of a journal (single), or of two (double)
        """
        from shoal.drawing.search import Measured, search_figure

        result = self.result
        measured = [
            Measured(name, value.mean, *(value.ci95 or (None, None)))
            for name, value in (("start", result.start_value), ("best", result.winner_value))
        ]
        at = result.trials.index(result.winner)
        return search_figure([each.mean for each in result.trials], at, measured, result.search.objective.words, width)

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
                ("in the search", told(result.start.mean), told(result.winner.mean)),
                ("on fresh seeds", *map(mean_text, values)),
                ("95 % interval", *map(interval_text, values)),
            ],
            note=note,
            words=("",),
        )

    def _sentences(self) -> list[str]:
        result = self.result
        failed = [each.reason for each in result.trials if each.reason]
        failures = [f"{len(failed)} trials have no value, the first: {failed[0]}"] if failed else []
        if result.winner is result.start:
            return [*failures, "no trial was better than the start"]
        gap = result.difference
        ends = difference_text(gap.mean, *(gap.ci95 or (None, None)))
        p = "" if gap.p is None else f", p {gap.p:.2g}"
        return [
            *failures,
            f"best - start, {gap.pairs} pairs of runs on fresh seeds: {ends}{p}: {result.verdict}",
            f"the search made the best look {told(abs(result.flattered))} "
            f"{'better' if result.flattered >= 0 else 'worse'} than it is (winner's curse): trust the fresh seeds",
        ]


def _numbers(value: Estimate) -> dict[str, Any]:
    return {"mean": _finite(value.mean), "ci95": value.ci95, "runs": list(value.runs)}


def _finite(value: float) -> float | None:
    return value if abs(value) < float("inf") else None
