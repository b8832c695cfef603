"""Contenders: the strategies of a comparison, by name or from a file, and the motionless lattice beside them."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from shoal.core.errors import ScenarioError, did_you_mean
from shoal.strategies import CATALOGUE
from shoal.strategies.plugins import find_strategy, load_strategies

LATTICE = "lattice"  # what standing still gives: in every comparison


@dataclass(frozen=True)
class Contender:
    """A strategy of a comparison.

    Attributes
    ----------
    name : of the strategy
    choice : what a design calls it: its name or its file
    informed : it knows the target: a reference, which no buoy could follow
    """

    name: str
    choice: str
    informed: bool


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
        hint = did_you_mean(choice, CATALOGUE)
        known = ", ".join(sorted(CATALOGUE))
        raise ScenarioError(choice, "no strategy is called so", f"{hint}strategies: {known}; or a file: ./mine.py")
    return Contender(owner.name, choice, owner.informed)
