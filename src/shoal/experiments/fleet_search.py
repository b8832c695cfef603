"""The search of a design: which fleets are tried, by a sampler and at random, all with the same seeds.

The sampler's trials are of two kinds, by turns: what optuna asks for, and the fleets halfway between two neighbors of
the front so far, where most of it may be missing. The search at random is the yardstick: as many trials, by chance.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from shoal.experiments.asker import STARTING, Asker
from shoal.experiments.design import Point
from shoal.experiments.evaluator import Evaluator, cells_or_reason
from shoal.experiments.fleet_range import FleetRange
from shoal.experiments.front import widest_gaps
from shoal.experiments.objective import Objective
from shoal.experiments.rows import Row
from shoal.experiments.start import value_of
from shoal.experiments.variable import Variable
from shoal.scenario.load import Source
from shoal.scenario.schema import Scenario

TOGETHER = 4  # trials that are asked for before the first of them is told
FILLED = 2  # of them, those that fill gaps of the front

Tried = dict[str, list["FleetTrial"]]  # of the present fleet, the sampler, and the search at random


@dataclass(frozen=True)
class FleetSearch:
    """What is designed.

    Attributes
    ----------
    source, changes, scenario : as given, its changes, and the two as one
    fleets, variables : counts and costs of fleets, and what else may change
    less, more : the metric of which less is looked for, and the one of which more is
    trials, runs, final_runs : fleets that the sampler tries, and as many at random; runs of each; and at the end
    """

    source: Source
    changes: Point
    scenario: Scenario
    fleets: Sequence[FleetRange]
    variables: Sequence[Variable]
    less: Objective
    more: Objective
    trials: int = 100
    runs: int = 3
    final_runs: int = 10

    @property
    def searched(self) -> list[Variable]:
        """All that is searched: counts first."""
        return [*(each.variable(self.scenario) for each in self.fleets if not each.fixed), *self.variables]

    @property
    def fields(self) -> list[str]:
        """Names that points have."""
        return [*self.present, *(each.field for each in self.variables)]

    @property
    def present(self) -> Point:
        """The fleet that the scenario has."""
        own = {each.name: each.count for each in self.scenario.fleets}
        return {each.path(self.scenario, "count"): own[each.name] for each in self.fleets}

    @property
    def fixed(self) -> Point:
        """Counts that are the same in all trials."""
        return {each.path(self.scenario, "count"): each.most for each in self.fleets if each.fixed}

    @property
    def start(self) -> Point:
        """What the scenario has of all that is searched."""
        return {**self.present, **{each.field: value_of(self.scenario, each.field) for each in self.variables}}


@dataclass(frozen=True)
class FleetTrial:
    """A point that was tried: agents of each fleet, and both metrics in every run; or why it could not run."""

    point: Point
    counts: tuple[int, ...] = ()
    less: tuple[float, ...] = ()
    more: tuple[float, ...] = ()
    reason: str = ""

    @property
    def means(self) -> tuple[float, float]:
        """Of both metrics over the runs; NaN where one has none."""
        if not self.less:
            return float("nan"), float("nan")
        return float(np.mean(self.less)), float(np.mean(self.more))

    @property
    def known(self) -> bool:
        """Whether both have a value."""
        return bool(np.isfinite(self.means).all())

    @property
    def key(self) -> str:
        """The same for the same point."""
        return str(sorted(self.point.items()))


def search_fleets(search: FleetSearch, sampler: Asker, random: Asker, evaluator: Evaluator) -> Tried:
    """Try the present fleet, then what both ask for, some at a time.

    Raises
    ------
    StrategyError, RecordError, KeyboardInterrupt : as `sweep`
    """
    (present,) = _try(search, [search.present], evaluator)
    if present.known:
        sampler.learn(search.start, present.means)
    tried: Tried = {"present": [present], "sampler": [], "random": []}
    for begun in range(0, search.trials, TOGETHER):
        count = min(TOGETHER, search.trials - begun)
        if begun >= STARTING:
            for point in _halfway(search.searched, tried["sampler"]):
                sampler.prefer(point)
        for name, asker in (("sampler", sampler), ("random", random)):
            asked = [asker.ask() for _ in range(count)]
            found = _try(search, [point for _, point in asked], evaluator)
            for (trial, _), each in zip(asked, found, strict=True):
                asker.tell(trial, each.means if each.known else None)
            tried[name] += found
    return tried


def values_of(rows: Sequence[Row], metric: str) -> tuple[float, ...]:
    """A metric in every run; NaN where there is none."""
    return tuple(_value(row, metric) for row in rows)


def _try(search: FleetSearch, points: Sequence[Point], evaluator: Evaluator) -> list[FleetTrial]:
    settled = [(point, *cells_or_reason(evaluator, {**search.fixed, **point})) for point in points]
    rows_of = iter(evaluator.evaluate([cells for _, cells, _ in settled if cells], search.runs))
    return [
        _trial(search, cells[0].point, cells[0].scenario, next(rows_of)[0]) if cells else FleetTrial(point, reason=why)
        for point, cells, why in settled
    ]


def _trial(search: FleetSearch, point: Point, scenario: Scenario, rows: Sequence[Row]) -> FleetTrial:
    own = {each.name: each.count for each in scenario.fleets}
    return FleetTrial(
        point=point,
        counts=tuple(own.get(each.name, 0) for each in search.scenario.fleets),
        less=values_of(rows, search.less.metric),
        more=values_of(rows, search.more.metric),
        reason=next((row["error"].splitlines()[0] for row in rows if row["status"] == "failed"), ""),
    )


def _halfway(variables: Sequence[Variable], tried: Sequence[FleetTrial]) -> list[Point]:
    """Points halfway between neighbors of the front that were not tried yet, of the widest gaps."""
    known = [{each.field: trial.point.get(each.field) for each in variables} for trial in tried]
    found: list[Point] = []
    for one, other in widest_gaps([each.means[0] for each in tried], [each.means[1] for each in tried]):
        point = {each.field: each.between(known[one][each.field], known[other][each.field]) for each in variables}
        if point not in known and point not in found:
            found.append(point)
        if len(found) == FILLED:
            break
    return found


def _value(row: Row, metric: str) -> float:
    value: Any = row[metric] if row["status"] == "done" else None
    return float("nan") if value is None else float(value)
