"""How many agents of a fleet may be bought, and what one of them costs."""

from collections.abc import Sequence
from dataclasses import dataclass

from shoal.core.errors import ScenarioError, did_you_mean
from shoal.core.text import cut
from shoal.experiments.variable import Variable
from shoal.scenario.edit import parse_value
from shoal.scenario.presence import MOST_AGENTS
from shoal.scenario.schema import Scenario

_HIGHEST = 1e12  # cost of one
_FORM = "write NAME=FROM:TO@COST, such as BoB-1=0:30@3; or NAME=COUNT@COST"


@dataclass(frozen=True)
class FleetRange:
    """A fleet of a scenario, the fewest and the most of its agents, and the cost of one (None: the scenario's)."""

    name: str
    fewest: int
    most: int
    cost: float | None = None

    @property
    def fixed(self) -> bool:
        """Whether there is nothing to choose."""
        return self.fewest == self.most

    def path(self, scenario: Scenario, field: str) -> str:
        """The path of a field of the fleet; by its number where a path cannot say its name."""
        number = [each.name for each in scenario.fleets].index(self.name)
        return f"fleets.{number if '.' in self.name or self.name.isdigit() else self.name}.{field}"

    def variable(self, scenario: Scenario) -> Variable:
        """Its count, as a search has it."""
        return Variable(self.path(scenario, "count"), self.fewest, self.most)


def parse_fleet(text: str) -> FleetRange:
    """Read "BoB-1=0:30@3": from 0 to 30 of them at 3 each; "BoB-1=15@3": 15; without "@", at the scenario's cost.

    Raises
    ------
    ScenarioError : it is neither, or an empty range
    """
    where = f"--fleet {cut(text)}"
    name, equals, rest = text.rpartition("=")
    counts, at, price = rest.partition("@")
    ends = [parse_value(part.strip()) for part in counts.split(":")]
    if not equals or not name.strip() or not 1 <= len(ends) <= 2 or not all(type(end) is int for end in ends):
        raise ScenarioError(where, "is not a fleet and its counts", _FORM)
    cost = parse_value(price.strip()) if at else None
    if at and type(cost) not in (int, float):
        raise ScenarioError(where, "the cost of one is not a number", _FORM)
    return fleet_range(name.strip(), ends[0], ends[-1], cost, where)


def fleet_range(name: str, fewest: int, most: int, cost: float | None, where: str) -> FleetRange:
    """Return the range of a fleet.

    Raises
    ------
    ScenarioError : a count or cost that cannot be
    """
    if not 0 <= fewest <= most <= MOST_AGENTS:
        problem = f"{fewest} to {most} agents are not a range"
        raise ScenarioError(where, problem, f"give counts from 0 to {MOST_AGENTS:,}, the smaller one first")
    if cost is not None and not 0 <= cost <= _HIGHEST:
        raise ScenarioError(where, f"one cannot cost {cost:g}", f"give a cost from 0 to {_HIGHEST:g}")
    return FleetRange(name, fewest, most, cost)


def check_fleets(ranges: Sequence[FleetRange], scenario: Scenario, *, costs: bool) -> None:
    """Refuse what is no choice among the fleets of a scenario; `costs`: every fleet must have one.

    Raises
    ------
    ScenarioError : an unknown fleet, one twice, one without a cost, nothing to choose, or too few agents
    """
    known = {each.name: each for each in scenario.fleets}
    if not ranges:
        fix = f"say how many of which: --fleet {next(iter(known))}=0:30@3"
        raise ScenarioError("--fleet", "is missing", fix)
    for number, each in enumerate(ranges):
        if each.name not in known:
            hint = did_you_mean(each.name, known)
            names = ", ".join(known)
            raise ScenarioError(f"--fleet {each.name}", "the scenario has no such fleet", f"{hint}there are: {names}")
        if any(each.name == other.name for other in ranges[:number]):
            raise ScenarioError(f"--fleet {each.name}", "is given twice", "leave out one of them")
    if costs:
        said = {each.name for each in ranges if each.cost is not None}
        free = next((name for name, fleet in known.items() if fleet.cost is None and name not in said), None)
        if free is not None:
            count = known[free].count
            fix = f"say what one costs: --fleet {free}={count}@COST, or cost under its [[fleets]]"
            raise ScenarioError(f"fleet {free}", "has no cost", fix)
    if all(each.fixed for each in ranges):
        raise ScenarioError("--fleet", "leaves nothing to choose", "give one fleet a range: NAME=FROM:TO@COST")
    others = sum(fleet.count for name, fleet in known.items() if name not in {each.name for each in ranges})
    if others + sum(each.most for each in ranges) < 2:
        raise ScenarioError("--fleet", "leaves fewer than 2 agents", "raise the most of one of them")


def costs_of(ranges: Sequence[FleetRange], scenario: Scenario) -> dict[str, float]:
    """The changes that give fleets their costs."""
    return {each.path(scenario, "cost"): each.cost for each in ranges if each.cost is not None}
