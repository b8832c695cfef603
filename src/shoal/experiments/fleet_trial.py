"""What a design searches, and one fleet that it tried."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shoal.experiments.design import Point
from shoal.experiments.fleet_range import FleetRange
from shoal.experiments.objective import Objective
from shoal.experiments.start import value_of
from shoal.experiments.variable import Variable
from shoal.scenario.load import Source
from shoal.scenario.schema import Scenario

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
    def present(self) -> Point:
        """The fleet that the scenario has."""
        own = {each.name: each.count for each in self.scenario.fleets}
        return {each.path(self.scenario, "count"): own[each.name] for each in self.fleets}

    @property
    def fixed(self) -> Point:
        """Counts that are the same in all trials."""
        return {each.path(self.scenario, "count"): each.most for each in self.fleets if each.fixed}

    def agents(self, point: Point) -> int:
        """How many agents a point has in all."""
        others = self.scenario.agents - sum(self.present.values())
        return int(others + sum({**self.present, **self.fixed, **point}[path] for path in self.present))

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
