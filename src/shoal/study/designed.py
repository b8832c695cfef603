"""Design a fleet from Python: what to buy, as a front of cost and metric."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from shoal.core.errors import MissingExtraError, ScenarioError
from shoal.core.keywords import lists_keywords, split_keywords
from shoal.core.sheet import Sheet
from shoal.core.version import RESULTS_VERSION
from shoal.experiments.compiled_first import compiled_first
from shoal.experiments.executors import Executor
from shoal.experiments.fleet_front import Alternative, FleetFront, design_fleets
from shoal.experiments.fleet_range import FleetRange, check_fleets, fleet_range, parse_fleet
from shoal.experiments.fleet_trial import FleetSearch
from shoal.experiments.front import Spread
from shoal.experiments.objective import objective
from shoal.experiments.on_card import executor_on
from shoal.experiments.sweep import Progress
from shoal.experiments.variable import Variable
from shoal.scenario.edit import check_words
from shoal.scenario.load import Source
from shoal.study.design_words import fleet_text, names_of, sentences, spread, standing
from shoal.study.folder import positive, progress_of, store_folder
from shoal.study.searching import base_scenario, called, shown, variables_of
from shoal.study.varied import written

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

TRIALS, RUNS, FINAL_RUNS = 100, 3, 10


@dataclass(frozen=True, repr=False)
class Designed:
    """What a design found. A notebook shows the front; `plot` draws it, `report` is a page for who buys.

    Attributes
    ----------
    scenario : what was designed
    result : alternatives, trials, hypervolumes, exchange rates
    """

    scenario: str
    result: FleetFront

    @property
    def front(self) -> list[Alternative]:
        """Fleets that no other beats, cheapest first, on fresh seeds."""
        return self.result.front

    @property
    def alternatives(self) -> tuple[Alternative, ...]:
        """All fleets that were run again, cheapest first."""
        return self.result.alternatives

    def to_pandas(self) -> "pandas.DataFrame":
        """Return a row per fleet that was run again: counts, fields, both metrics with ends, standing (extra: sweep).

        Raises
        ------
        MissingExtraError : pandas is not installed
        """
        try:
            import pandas as pd
        except ImportError:
            raise MissingExtraError.of("pandas", "sweep", "a design as a DataFrame") from None
        return pd.DataFrame(self.rows())

    def rows(self) -> list[dict[str, Any]]:
        """What `to_pandas` makes a table of."""
        search = self.result.search
        names = [each.name for each in search.scenario.fleets]
        return [
            {
                **dict(zip(names, each.counts, strict=True)),
                **self._others(each),
                **_ends(search.less.metric, each.less), **_ends(search.more.metric, each.more),
                "searched": _finite(each.searched), "on_front": each.on_front, "present": each.present,
                "beaten_by": each.beaten_by,
            }
            for each in self.alternatives
        ]  # fmt: skip

    def to_dict(self) -> dict[str, Any]:
        """Return all of it as `shoal design --json` prints it."""
        result, search = self.result, self.result.search
        names = [each.name for each in search.scenario.fleets]
        return {
            "scenario": self.scenario, "minimize": search.less.metric, "maximize": search.more.metric,
            "trials": search.trials, "runs": search.runs, "final_runs": search.final_runs,
            "steps": search.scenario.steps, "seed": search.scenario.seed, "all_steps": result.steps,
            "results_version": RESULTS_VERSION,
            "hypervolume": {**result.hypervolumes, "reference": list(result.reference)},
            "exchange_rates": [
                {"one": names[each.fleet], "of": names[result.base], "worth": each.worth, "ci95": [each.low, each.high]}
                for each in result.rates
            ],
            "fleets": self.rows(),
            "failed": [each.reason for several in result.tried.values() for each in several if each.reason],
        }  # fmt: skip

    def plot(self) -> "Figure":
        """Draw the front: cost against metric, with intervals (extra: plots)."""
        from shoal.drawing.front import Place, front_figure

        search = self.result.search
        places = [
            Place(each.less.mean, each.more.mean, _finite(each.more.low), _finite(each.more.high),
                  fleet_text(each.counts), standing(each), each.present)
            for each in self.alternatives
        ]  # fmt: skip
        tried = [each.means for several in self.result.tried.values() for each in several if each.known]
        return front_figure(places, tried, (search.less.words, search.more.words), " + ".join(names_of(self.result)))

    def report(self, file: str | Path) -> None:
        """Write one self-contained HTML page for whoever buys; one of Shoal's of this name is replaced (extra: plots).

        Parameters
        ----------
        file : where, NAME.html

        Raises
        ------
        RecordError : it cannot be written
        MissingExtraError : matplotlib is not installed
        """
        from shoal.study.design_page import write_page

        write_page(self.scenario, self.result, self.plot(), file)

    def __repr__(self) -> str:
        """The table of the front, and what it says."""
        return "\n".join([self._sheet().text(), *sentences(self.result)])

    def _repr_html_(self) -> str:
        """The table for a notebook."""
        return self._sheet(" ".join(sentences(self.result))).html()

    def _sheet(self, note: str = "") -> Sheet:
        result, search = self.result, self.result.search
        kept = [each for each in self.alternatives if each.on_front or each.present]
        return Sheet(
            head=f"{self.scenario}: {search.trials} trials and as many at random, of {search.runs} runs of "
            f"{search.scenario.steps:,} steps; below, {search.final_runs} runs each on fresh seeds",
            titles=(search.less.words, *names_of(result), *(each.field for each in search.variables),
                    search.more.words, ""),
            rows=[
                (
                    spread(each.less, exact=True), *map(str, each.counts),
                    *(shown(value) for value in self._others(each).values()),
                    spread(each.more), "present" if each.present and each.on_front else
                    "present, dominated for sure" if each.present and each.beaten_by is not None else
                    "present, behind the front" if each.present else "",
                )
                for each in kept
            ],
            note=note,
            words=("",),
        )  # fmt: skip

    def _others(self, each: Alternative) -> dict[str, Any]:
        search = self.result.search
        values = {**search.start, **each.point}
        return {variable.field: values[variable.field] for variable in search.variables}


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
        executor=compiled_first(executor_on(options.device, options.jobs), _say_nothing),
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


def _ends(metric: str, value: Spread) -> dict[str, float | None]:
    return {
        metric: _finite(value.mean), f"{metric}_low": _finite(value.low), f"{metric}_high": _finite(value.high)
    }  # fmt: skip


def _finite(value: float) -> float | None:
    return value if abs(value) < float("inf") else None


def _say_nothing(message: str) -> None:
    """A library never prints."""
