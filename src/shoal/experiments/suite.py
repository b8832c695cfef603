"""A suite: fixed conditions, under which all strategies are compared. One TOML file each, in suites/."""

import difflib
import re
import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from importlib import resources
from pathlib import Path
from typing import Any

from shoal.core.errors import ScenarioError
from shoal.experiments.cells import Cell, make_cells
from shoal.experiments.compare import comparison_design, run_comparison, values_of
from shoal.experiments.comparison import Values
from shoal.experiments.contenders import Contender
from shoal.experiments.design import Point
from shoal.experiments.executors import Executor
from shoal.experiments.replicate import Row
from shoal.experiments.sweep import Progress

Report = Callable[[str, Progress], None]  # the name of a condition, and how far it is


@dataclass(frozen=True)
class SuiteCondition:
    """One condition: changes to the suite's scenario, and the metric / whole, a share of 0 to 1, that counts there."""

    name: str
    says: str
    metric: str
    whole: float = 1.0
    changes: Point = field(default_factory=dict)

    @property
    def folder(self) -> str:
        """Where its runs are: a sweep of its own."""
        return re.sub(r"[^a-z0-9]+", "-", self.name.lower())


@dataclass(frozen=True)
class Suite:
    """Conditions as changes to one scenario; the same seed, steps and runs for all."""

    name: str
    scenario: str
    seed: int
    steps: int
    runs: int
    conditions: tuple[SuiteCondition, ...]

    def changes(self, condition: SuiteCondition) -> Point:
        """All changes that make a condition."""
        return {**condition.changes, "steps": self.steps, "seed": self.seed}

    def cells(self, contenders: Sequence[Contender]) -> list[Cell]:
        """Every scenario that the suite runs."""
        design = comparison_design(self.scenario, contenders, self.runs)
        return [cell for each in self.conditions for cell in make_cells(design, self.changes(each))]


def suites() -> list[str]:
    """Names of the suites that come with Shoal."""
    return sorted(file.name.removesuffix(".toml") for file in _folder().iterdir() if file.name.endswith(".toml"))


def read_suite(name: str) -> Suite:
    """Return the suite of a name.

    Raises
    ------
    ScenarioError : there is none
    """
    if name not in suites():
        near = difflib.get_close_matches(name, suites(), n=1)
        hint = f"did you mean {near[0]!r}? " if near else ""
        raise ScenarioError(f"--suite {name}", "no suite is called so", f"{hint}suites: {', '.join(suites())}")
    table = tomllib.loads((_folder() / f"{name}.toml").read_text(encoding="utf-8"))
    conditions = tuple(SuiteCondition(**each) for each in table.pop("conditions"))
    return Suite(name=name, conditions=conditions, **table)


def resized(suite: Suite, *, runs: int | None = None, steps: int | None = None, seed: int | None = None) -> Suite:
    """Return the suite with other runs, steps or seed; what happens at a step happens at the same share of a run."""
    length = suite.steps if steps is None else steps
    return replace(
        suite,
        runs=suite.runs if runs is None else runs,
        seed=suite.seed if seed is None else seed,
        steps=length,
        conditions=tuple(
            replace(each, changes=_moved(each.changes, length / suite.steps)) for each in suite.conditions
        ),
    )


def run_suite(
    suite: Suite, contenders: Sequence[Contender], out: Path, *, executor: Executor, report: Report
) -> dict[str, tuple[Point, dict[str, list[Row | None]]]]:
    """Run what is missing, a sweep in a folder of its own for each condition; return every run's row, by condition.

    Raises
    ------
    ScenarioError, StrategyError, RecordError, KeyboardInterrupt : as `sweep`
    """
    suite.cells(contenders)  # refuses what cannot run, before anything does
    design = comparison_design(suite.scenario, contenders, suite.runs)
    found = {}
    for condition in suite.conditions:

        def tell(progress: Progress, name: str = condition.name) -> None:
            report(name, progress)

        ((_, strategies),) = run_comparison(
            design, contenders, out / condition.folder, changes=suite.changes(condition), executor=executor, report=tell
        )
        found[condition.name] = (condition.changes, strategies)
    return found


def suite_values(
    suite: Suite, found: dict[str, tuple[Point, dict[str, list[Row | None]]]]
) -> dict[str, tuple[Point, Values]]:
    """Return what counts under each condition, a share of 0 to 1 in every run."""
    return {
        each.name: (each.changes, values_of(found[each.name][1], each.metric, each.whole)) for each in suite.conditions
    }


def _moved(changes: Point, share: float) -> Point:
    if "losses" not in changes:
        return changes
    moved: list[dict[str, Any]] = [{**each, "step": max(1, round(each["step"] * share))} for each in changes["losses"]]
    return {**changes, "losses": moved}


def _folder() -> Any:
    return resources.files("shoal.experiments") / "suites"
