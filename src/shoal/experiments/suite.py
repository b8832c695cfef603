"""A suite: fixed conditions, under which all strategies are compared. One TOML file each, in suites/."""

import re
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib import resources
from pathlib import Path
from typing import Any

from shoal.core.errors import ScenarioError, did_you_mean
from shoal.core.files import check_folder
from shoal.experiments.cells import Cell, make_cells
from shoal.experiments.comparison import Values
from shoal.experiments.condition_point import followed_point
from shoal.experiments.contenders import Contender
from shoal.experiments.design import Design, Point
from shoal.experiments.executors import Executor
from shoal.experiments.rows import Row
from shoal.experiments.run_comparison import comparison_design, run_comparison, values_of
from shoal.experiments.sweep import Progress
from shoal.scenario.change import change
from shoal.scenario.load import scenario_from, table_of
from shoal.scenario.schema import Scenario

Found = dict[str, dict[str, list[Row | None]]]  # by condition and strategy, the row of each run


@dataclass(frozen=True)
class SuiteCondition:
    """One condition: changes to the suite's scenario, and the metric / out_of, a share of 0 to 1, that counts there.

    scenario, steps : of its own, where they are not the suite's
    """

    name: str
    says: str
    metric: str
    out_of: float = 1.0
    changes: Point = field(default_factory=dict)
    scenario: str | None = None
    steps: int | None = None

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
        return {**condition.changes, "steps": condition.steps or self.steps, "seed": self.seed}

    def design(self, condition: SuiteCondition, contenders: Sequence[Contender]) -> Design:
        """Every contender in the scenario of a condition, which what is said of its parameters follows."""
        suited = [replace(each, said=self._followed(each, condition)) for each in contenders]
        return comparison_design(condition.scenario or self.scenario, suited, self.runs)

    def _followed(self, contender: Contender, condition: SuiteCondition) -> Mapping[str, Any]:
        def at(source: str, changes: Point) -> Callable[[], Scenario]:
            return lambda: scenario_from(change(table_of(source), {**changes, "strategy": contender.choice}))

        said = {f"strategy.{name}": value for name, value in contender.said.items()}
        there = at(condition.scenario or self.scenario, self.changes(condition))
        found = followed_point(said, at(self.scenario, {}), there)
        return {field.removeprefix("strategy."): value for field, value in found.items()}

    def cells(self, contenders: Sequence[Contender]) -> list[Cell]:
        """Every scenario that the suite runs."""
        return [
            cell for each in self.conditions for cell in make_cells(self.design(each, contenders), self.changes(each))
        ]


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
        hint = did_you_mean(name, suites())
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
            replace(
                each,
                changes=_moved(each.changes, length / suite.steps),
                steps=each.steps and max(1, round(each.steps * length / suite.steps)),
            )
            for each in suite.conditions
        ),
    )


def run_suite(
    suite: Suite,
    contenders: Sequence[Contender],
    out: Path,
    *,
    executor: Executor,
    begin: Callable[[str], None] | None = None,
    report: Callable[[Progress], None] | None = None,
) -> Found:
    """Run what is missing, a sweep in a folder of its own for each condition; return every run's row.

    `begin` is called with the name of each condition, `report` after every run with how far the suite is.

    Raises
    ------
    ScenarioError, StrategyError, RecordError, KeyboardInterrupt : as `sweep`
    """
    check_folder(out, [each.folder for each in suite.conditions])
    overall = Progress(total=len(suite.cells(contenders)) * suite.runs, before=0)  # refuses what cannot run
    found = {}
    for condition in suite.conditions:
        if begin:
            begin(condition.name)
        design = suite.design(condition, contenders)
        store, changes = out / condition.folder, suite.changes(condition)
        tell = _added_to(overall, report)
        ((_, strategies),) = run_comparison(design, contenders, store, changes=changes, executor=executor, report=tell)
        found[condition.name] = strategies
    return found


def suite_values(suite: Suite, found: Found) -> dict[str, tuple[Point, Values]]:
    """Return what counts under each condition, a share of 0 to 1 in every run."""
    return {
        each.name: (each.changes, values_of(found[each.name], each.metric, each.out_of)) for each in suite.conditions
    }


def _added_to(overall: Progress, report: Callable[[Progress], None] | None) -> Callable[[Progress], None]:
    """Report the runs of one sweep on top of what was done so far."""
    before, done, failed = overall.before, overall.done, overall.failed

    def tell(now: Progress) -> None:
        overall.before, overall.done, overall.failed = before + now.before, done + now.done, failed + now.failed
        if report:
            report(overall)

    return tell


def _moved(changes: Point, share: float) -> Point:
    if "losses" not in changes:
        return changes
    moved: list[dict[str, Any]] = [{**each, "step": max(1, round(each["step"] * share))} for each in changes["losses"]]
    return {**changes, "losses": moved}


def _folder() -> Any:
    return resources.files("shoal.experiments") / "suites"
