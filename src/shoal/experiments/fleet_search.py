"""The search of a design: which fleets are tried, by a sampler and at random, all with the same seeds.

The sampler's trials are of two kinds: what optuna asks for, and what adds most to the front by a surrogate of what was
tried so far (promising.py); optuna is told of both. The search at random is the yardstick: as many trials, by chance.
"""

from collections.abc import Sequence
from typing import Any

from shoal.experiments.asker import STARTING, Asker
from shoal.experiments.design import Point
from shoal.experiments.evaluator import Evaluator, cells_or_reason, why_nothing
from shoal.experiments.fleet_trial import FleetSearch, FleetTrial, Tried
from shoal.experiments.promising import promising
from shoal.experiments.rows import Row
from shoal.scenario.schema import Scenario

TOGETHER = 4  # trials that are asked for before the first of them is told
PROMISING = 3  # of them, those that a surrogate chooses


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
            for point in promising(search, [present, *tried["sampler"]], min(PROMISING, count), begun):
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
    less, more = (values_of(rows, goal.metric) for goal in (search.less, search.more))
    return FleetTrial(
        point=point,
        counts=tuple(own.get(each.name, 0) for each in search.scenario.fleets),
        less=less,
        more=more,
        reason=why_nothing(rows, more, search.more.metric) or why_nothing(rows, less, search.less.metric),
    )


def _value(row: Row, metric: str) -> float:
    value: Any = row[metric] if row["status"] == "done" else None
    return float("nan") if value is None else float(value)
