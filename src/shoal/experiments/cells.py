"""A cell: one scenario of a sweep, and its replicates, each with an id that its content decides."""

import hashlib
import json
from dataclasses import dataclass
from typing import Any

from shoal.core.errors import ScenarioError
from shoal.core.version import RESULTS_VERSION
from shoal.experiments.design import Design, Point
from shoal.metrics.chosen import check_metrics
from shoal.scenario.change import change
from shoal.scenario.edit import apply
from shoal.scenario.load import name_of_source, scenario_from, table_of
from shoal.scenario.schema import Scenario


@dataclass(frozen=True)
class Cell:
    """One scenario of a sweep and the point that made it."""

    point: Point
    scenario: Scenario

    @property
    def shown(self) -> Point:
        """The point as results show it: a strategy's file by the name of the strategy."""
        named = {"strategy": self.scenario.strategy.name} if isinstance(self.point.get("strategy"), str) else {}
        return {**self.point, **named}

    def run_id(self, run: int) -> str:
        """24 hex digits over what shapes a run: the scenario, the seed, the replicate and the results version."""
        content = f"{self.scenario.hash}/{self.scenario.seed}/{run}/{RESULTS_VERSION}"
        return hashlib.sha256(content.encode()).hexdigest()[:24]


def make_cells(design: Design, changes: Point, *, independent: bool = False) -> list[Cell]:
    """Return the validated cells of a design, each once; `changes` go to all of them.

    Run r of every cell shares its seed and with it the target's path and the starts, so that differences are paired;
    `independent` gives every cell a seed of its own.

    Raises
    ------
    ScenarioError : a point gives no scenario that can run (all points are checked before anything runs)
    """
    base = change(table_of(design.scenario), changes)
    cells: dict[str, Cell] = {}
    files: dict[str, Any] = {}
    name = name_of_source(design.scenario)
    for point in design.points:
        values = ", ".join(f"{name}={value}" for name, value in point.items())
        scenario = scenario_from(apply(base, point), where=f"{name} ({values})" if values else name)
        if independent:
            scenario = scenario.model_copy(update={"seed": _seed_of(scenario)})
        check_metrics(scenario.metrics)
        called, choice = scenario.strategy.name, point.get("strategy")
        if isinstance(choice, str) and files.setdefault(called, choice) != choice:  # results could not tell them apart
            raise ScenarioError(f"{files[called]} and {choice}", f"are both called {called!r}", "give one another name")
        cells.setdefault(f"{scenario.hash}/{scenario.seed}", Cell(dict(point), scenario))
    return list(cells.values())


def base_table(design: Design, changes: Point) -> Point:
    """The scenario that a design starts from, in full."""
    return scenario_from(change(table_of(design.scenario), changes)).model_dump(mode="json", exclude={"description"})


def _seed_of(scenario: Scenario) -> int:
    content = json.dumps([scenario.hash, scenario.seed])
    return int.from_bytes(hashlib.sha256(content.encode()).digest()[:7], "big")
