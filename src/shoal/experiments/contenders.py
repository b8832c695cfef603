"""Contenders: the strategies of a comparison, by name or from a file, and the motionless lattice beside them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from shoal.core.errors import ScenarioError
from shoal.strategies import CATALOGUE
from shoal.strategies.plugins import find_strategy, load_strategies, meant_by

LATTICE = "lattice"  # what standing still gives: in every comparison


@dataclass(frozen=True)
class Contender:
    """A strategy of a comparison.

    Attributes
    ----------
    name : of the strategy
    choice : what a design calls it: its name or its file
    informed : it knows the target: a reference, which no buoy could follow
    said : {parameter: value} of its own; what is not said, it leaves at its defaults
    """

    name: str
    choice: str
    informed: bool
    said: Mapping[str, Any] = field(default_factory=dict)

    def changes(self) -> dict[str, Any]:
        """What makes a scenario its own."""
        return {"strategy": self.choice, **{f"strategy.{name}": value for name, value in self.said.items()}}


def with_parameters(
    everybody: Sequence[Contender], changes: Mapping[str, Any]
) -> tuple[list[Contender], dict[str, Any]]:
    """Give contenders what is said of them, as encircle.ring, and return them with the changes that are left."""
    names = {each.name for each in everybody}
    said = {path: value for path, value in changes.items() if path.partition(".")[0] in names and "." in path}
    own = [
        replace(each, said={path.partition(".")[2]: value for path, value in said.items() if _of(path, each)})
        for each in everybody
    ]
    return own, {path: value for path, value in changes.items() if path not in said}


def _of(path: str, contender: Contender) -> bool:
    return path.partition(".")[0] == contender.name


def contenders(named: Sequence[str]) -> list[Contender]:
    """Return the strategies of these names and files, each once, and the lattice if it is not among them.

    Raises
    ------
    ScenarioError : an unknown name, two strategies of one name, or nothing but the lattice
    StrategyError : a file that defines no strategy
    """
    found: dict[str, Contender] = {}
    for choice in (*dict.fromkeys(named), LATTICE):
        known = _contender(choice)
        if found.setdefault(known.name, known).choice != choice and choice != LATTICE:
            both = f"{found[known.name].choice} and {choice}"
            raise ScenarioError(both, f"are both called {known.name!r}", "give one another name")
    if len(found) == 1:
        raise ScenarioError(
            "STRATEGIES",
            f"there is only the {LATTICE} to compare",
            "name a strategy or more, such as knn-pso charged-pso",
        )
    return list(found.values())


def _contender(choice: str) -> Contender:
    if choice.endswith(".py") or "/" in choice:
        loaded = load_strategies({"file": str(Path(choice).resolve())})
        owner = find_strategy(loaded["name"], loaded["source"])
    else:
        owner = find_strategy(choice)
    if owner is None:
        hint = meant_by(choice, CATALOGUE)
        known = ", ".join(sorted(CATALOGUE))
        raise ScenarioError(choice, "no strategy is called so", f"{hint}strategies: {known}; or a file: ./mine.py")
    return Contender(owner.name, choice, owner.informed)
