"""A comparison: every strategy's values under every condition, ranked, and paired with those of a baseline."""

import math
from collections.abc import Container, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.experiments.paired import SIGNIFICANT, Difference, holm, paired_difference
from shoal.metrics.summary import ANYTHING, Bounds
from shoal.record.statistics import Estimate, estimate

Values = Mapping[str, npt.NDArray[np.float64]]  # of each strategy in each run, (R,); NaN where a run has none


@dataclass(frozen=True)
class Standing:
    """How a strategy did under one condition.

    Attributes
    ----------
    strategy : its name
    informed : it knows the target: a reference, which no buoy could follow
    rank : among those that are not informed, equals share one; None for references and without a value
    value : over the runs that have one
    missing : number of runs that failed, or have no such value
    difference : from the baseline, over paired runs; None for the baseline itself
    adjusted_p : its p, corrected for all comparisons of the table
    verdict : better, worse (or higher, lower), no difference shown, too few runs; baseline
    """

    strategy: str
    informed: bool
    rank: int | None
    value: Estimate
    missing: int
    difference: Difference | None
    adjusted_p: float | None
    verdict: str


@dataclass(frozen=True)
class Condition:
    """Standings under one condition: first those of a rank, best first, then the references."""

    name: str
    point: dict[str, Any]
    standings: tuple[Standing, ...]

    def of(self, strategy: str) -> Standing:
        """The standing of one strategy."""
        return next(each for each in self.standings if each.strategy == strategy)


@dataclass(frozen=True)
class Comparison:
    """A table of comparisons: one family for the correction."""

    baseline: str
    conditions: tuple[Condition, ...]

    @property
    def tests(self) -> int:
        """How many comparisons adjusted p is corrected for."""
        return sum(each.adjusted_p is not None for condition in self.conditions for each in condition.standings)


def compare(
    table: Mapping[str, tuple[dict[str, Any], Values]],
    baseline: str,
    informed: Container[str],
    direction: int = 1,
    bounds: Bounds = ANYTHING,
) -> Comparison:
    """Return all standings and their differences from the baseline.

    Parameters
    ----------
    table : by the name of a condition, the point that makes it and the values of all strategies there
    baseline : the strategy that all others are compared with
    informed : names of those that know the target
    direction : 1 more is better, -1 less is better, 0 neither (ranked as if more were)
    bounds : of the values
    """
    differences = {
        (name, strategy): paired_difference(values[strategy], values[baseline], bounds)
        for name, (_, values) in table.items()
        for strategy in values
        if strategy != baseline
    }
    adjusted = dict(zip(differences, holm([each.p for each in differences.values()]), strict=True))
    return Comparison(
        baseline,
        tuple(
            Condition(
                name,
                point,
                _ranked(
                    [
                        _standing(
                            strategy,
                            strategy in informed,
                            values[strategy],
                            differences.get((name, strategy)),
                            adjusted.get((name, strategy)),
                            direction,
                            bounds,
                        )
                        for strategy in values
                    ],
                    direction or 1,
                ),
            )
            for name, (point, values) in table.items()
        ),
    )


def _standing(
    strategy: str,
    informed: bool,
    values: npt.NDArray[np.float64],
    difference: Difference | None,
    adjusted_p: float | None,
    direction: int,
    bounds: Bounds,
) -> Standing:
    known = values[np.isfinite(values)]
    value = estimate(known, bounds=bounds) if known.size else Estimate(math.nan, None, ())
    verdict = _verdict(difference, adjusted_p, direction)
    return Standing(strategy, informed, None, value, values.size - known.size, difference, adjusted_p, verdict)


def _verdict(difference: Difference | None, adjusted_p: float | None, direction: int) -> str:
    if difference is None:
        return "baseline"
    if adjusted_p is None:
        return "too few runs"
    if adjusted_p >= SIGNIFICANT:
        return "no difference shown"
    more, less = {1: ("better", "worse"), -1: ("worse", "better"), 0: ("higher", "lower")}[direction]
    return more if difference.mean > 0 else less


def _ranked(standings: list[Standing], direction: int) -> tuple[Standing, ...]:
    """Those of a rank, best first; those without a value; references, best first."""

    def merit(each: Standing) -> float:
        return -math.inf if math.isnan(each.value.mean) else direction * each.value.mean

    def with_rank(each: Standing) -> Standing:
        if each.informed or math.isnan(each.value.mean):
            return each
        rank = 1 + sum(merit(other) > merit(each) for other in standings if not other.informed)
        return replace(each, rank=rank)

    return tuple(with_rank(each) for each in sorted(standings, key=lambda each: (each.informed, -merit(each))))
