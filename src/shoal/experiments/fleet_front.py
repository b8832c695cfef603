"""Which fleets to buy: the front of cost and metric, measured on fresh seeds, with intervals.

Whatever fleet is on the front of the search, by its runs or as a surrogate expects it, or on that of the sampler or of
the trials at random alone, is run again on seeds that the search has not seen: only those values are reported, since
the best of many noisy ones are flattered by chance.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from shoal.core.errors import ScenarioError
from shoal.core.files import check_folder
from shoal.experiments.asker import Asker
from shoal.experiments.design import Point
from shoal.experiments.evaluator import Evaluator, first_error
from shoal.experiments.exchange_rate import ExchangeRate, exchange_rates
from shoal.experiments.executors import Executor
from shoal.experiments.fleet_range import costs_of
from shoal.experiments.fleet_search import search_fleets, values_of
from shoal.experiments.fleet_trial import FleetSearch, FleetTrial, Tried
from shoal.experiments.front import Spread, dominated_for_sure, front, hypervolume
from shoal.experiments.objective import Objective
from shoal.experiments.promising import expected_front
from shoal.experiments.rows import Row
from shoal.experiments.suite import SuiteCondition
from shoal.experiments.sweep import Progress
from shoal.experiments.tune import STORES, check_fields, fresh_seed
from shoal.record.statistics import estimate

EXACT = ("cost",)  # metrics that the scenario decides, not chance: alike in all runs they are known, not untold
SEARCHES = ("sampler", "random")


@dataclass(frozen=True)
class Alternative:
    """A fleet that was run again on fresh seeds.

    Attributes
    ----------
    point : counts and other fields
    counts : agents of every fleet of the scenario, in its order
    less, more : its values there, with the ends of their 95 % intervals
    searched : the second as the search had it
    present : it is the fleet that the scenario has
    on_front : no other is better, by means
    beaten_by : the place of one that dominates it for sure, beyond both intervals
    """

    point: Point
    counts: tuple[int, ...]
    less: Spread
    more: Spread
    searched: float
    present: bool = False
    on_front: bool = False
    beaten_by: int | None = None


@dataclass(frozen=True)
class FleetFront:
    """What a design found.

    Attributes
    ----------
    alternatives : fleets that were run again, cheapest first
    tried : all trials, of the present fleet, the sampler, and the search at random
    hypervolumes : on fresh seeds, of the front of the sampler, of that at random, and of all
    reference : the point that they end at: the most that was paid, and nothing
    base, rates : the number of a fleet of the scenario, and what one agent of others is worth of it
    steps : of all runs
    """

    search: FleetSearch
    alternatives: tuple[Alternative, ...]
    tried: Tried
    hypervolumes: dict[str, float]
    reference: tuple[float, float]
    base: int
    rates: tuple[ExchangeRate, ...]
    steps: int

    @property
    def front(self) -> list[Alternative]:
        """Those that no other beats."""
        return [each for each in self.alternatives if each.on_front]

    @property
    def costs(self) -> tuple[float, ...]:
        """Of one agent of every fleet of the scenario; 0 where it is not known."""
        return costs_of_one(self.search)

    @property
    def free(self) -> list[int]:
        """Numbers of the fleets whose count was searched."""
        names = [each.name for each in self.search.scenario.fleets]
        return [names.index(each.name) for each in self.search.fleets if not each.fixed]

    @property
    def present(self) -> Alternative:
        """The fleet that the scenario has."""
        return next(each for each in self.alternatives if each.present)


def design_fleets(
    search: FleetSearch, folder: Path, *, executor: Executor, report: Callable[[Progress], None] | None = None
) -> FleetFront:
    """Search, and measure every fleet of the front on fresh seeds; the same call again goes on in the folder.

    Raises
    ------
    ScenarioError : the present fleet, or an end of a variable, cannot run, or no fleet has a value
    StrategyError, RecordError, KeyboardInterrupt : as `sweep`
    MissingExtraError : optuna is not installed
    """
    seed, goals = search.scenario.seed, [search.less, search.more]
    sampler = Asker(search.searched, goals, "tpe", seed)
    random = Asker(search.searched, goals, "random", fresh_seed(seed))
    check_fields(search.scenario, list(search.start), search.changes)
    changes = {**search.changes, **costs_of(search.fleets, search.scenario)}
    only = [SuiteCondition("all", "the scenario as it is", search.more.metric)]
    evaluator = Evaluator(search.source, changes, only, folder / "search", search.start, executor, report)
    ends = [{**search.present, each.field: end} for each in search.variables for end in each.ends]
    first_error(evaluator, [search.present, *ends])
    check_folder(folder, STORES)
    with evaluator:
        evaluator.progress.total = search.runs * (2 * search.trials + 1)
        tried = search_fleets(search, sampler, random, evaluator)
        progress, steps = evaluator.progress, evaluator.steps
    finalists = _finalists(search, tried)
    progress.total = progress.before + progress.done + search.final_runs * len(finalists)
    fresh = {**changes, "seed": fresh_seed(seed)}
    with Evaluator(search.source, fresh, only, folder / "final", search.start, executor, report) as evaluator:
        evaluator.progress = progress
        cells = [evaluator.cells(each.point) for each in finalists]
        rows = [found[0] for found in evaluator.evaluate(cells, search.final_runs)]
        steps += evaluator.steps
    return _measured(search, tried, finalists, rows, steps)


def _finalists(search: FleetSearch, tried: Tried) -> list[FleetTrial]:
    """The present fleet, and the fronts of the sampler, of the search at random, and of all together, each once."""
    everything = [each for several in tried.values() for each in several]
    found = list(tried["present"])
    for group in (*(tried[name] for name in SEARCHES), everything):
        found += [group[at] for at in front(*zip(*(each.means for each in group), strict=True))]
    found += expected_front(search, everything)
    if not any(each.known for each in everything):
        raise _nothing(search, next((each.reason for each in everything if each.reason), "no run has one"))
    return list({each.key: each for each in reversed(found)}.values())[::-1]


def _measured(
    search: FleetSearch, tried: Tried, finalists: Sequence[FleetTrial], rows: Sequence[Sequence[Row]], steps: int
) -> FleetFront:
    less, more = ([_spread(found, goal) for found in rows] for goal in (search.less, search.more))
    costs, values = [each.mean for each in less], [each.mean for each in more]
    order = sorted(range(len(finalists)), key=lambda at: (costs[at], -values[at]))
    best, beaten = set(front(costs, values)), dominated_for_sure(less, more)
    if not best:
        raise _nothing(search, "on fresh seeds")
    places: dict[int | None, int] = {at: place for place, at in enumerate(order)}
    alternatives = tuple(
        Alternative(
            point=finalists[at].point,
            counts=finalists[at].counts,
            less=less[at],
            more=more[at],
            searched=finalists[at].means[1],
            present=finalists[at] is tried["present"][0],
            on_front=at in best,
            beaten_by=places.get(beaten[at]),
        )
        for at in order
    )
    reference = (np.nanmax([each.means[0] for several in tried.values() for each in several]), _worst(search, values))
    areas = {}
    for name in (*SEARCHES, "all"):
        own = {each.key for group, several in tried.items() if name in (group, "all") for each in several}
        chosen = [at for at, each in enumerate(finalists) if each.key in own]
        areas[name] = hypervolume([costs[at] for at in chosen], [values[at] for at in chosen], reference)
    base, rates = _rates(search, tried)
    return FleetFront(search, alternatives, tried, areas, reference, base, tuple(rates), steps)


def _nothing(search: FleetSearch, reason: str) -> ScenarioError:
    return ScenarioError(search.more.metric, f"no fleet has a value: {reason}", "correct the scenario or the metric")


def _spread(rows: Sequence[Row], goal: Objective) -> Spread:
    """Mean and interval over the runs that have a value."""
    values = np.array(values_of(rows, goal.metric))
    known = values[np.isfinite(values)]
    if not known.size:
        return Spread(*[float("nan")] * 3)
    found = estimate(known, bounds=goal.bounds)
    if goal.metric in EXACT:
        return Spread(*[found.mean] * 3)
    return Spread(found.mean, *(found.ci95 or (float("nan"), float("nan"))))


def _worst(search: FleetSearch, values: Sequence[float]) -> float:
    """The least that a value can be; where it has no least, the least that was found."""
    low = search.more.bounds.low
    return low if np.isfinite(low) else float(np.nanmin(values))


def costs_of_one(search: FleetSearch) -> tuple[float, ...]:
    """What one agent of every fleet of the scenario costs; 0 where that is not known."""
    costs = {each.name: each.cost or 0.0 for each in search.scenario.fleets}
    costs |= {each.name: each.cost for each in search.fleets if each.cost is not None}
    return tuple(costs.values())


def _rates(search: FleetSearch, tried: Tried) -> tuple[int, list[ExchangeRate]]:
    """Exchange rates against the cheapest fleet whose count varies, from every trial."""
    names, costs = [each.name for each in search.scenario.fleets], costs_of_one(search)
    base = min((names.index(each.name) for each in search.fleets if not each.fixed), key=lambda at: costs[at])
    known = [each for several in tried.values() for each in several if each.known]
    others = [[each.place({**search.start, **trial.point}[each.field]) for each in search.variables] for trial in known]
    inside = [at for at, row in enumerate(others) if None not in row]
    return base, exchange_rates(
        [known[at].counts for at in inside],
        np.array([others[at] for at in inside], float).reshape(len(inside), len(search.variables)),
        [known[at].means[1] for at in inside],
        base,
    )
