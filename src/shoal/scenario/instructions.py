"""What each agent goes by: the scenario, as far as commands have changed it for this agent."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import groupby
from typing import Any

from shoal.core.errors import ScenarioError
from shoal.scenario.briefing import degrees
from shoal.scenario.commands import Command
from shoal.scenario.crew import Crew, crew_of, crew_params
from shoal.scenario.edit import apply
from shoal.scenario.load import scenario_from, table_of
from shoal.scenario.schema import Scenario
from shoal.strategies.contract import RESERVED

_LIVE = "neighbors, strategy.PARAMETER, fleets.NAME.neighbors, fleets.NAME.strategy.PARAMETER"
_CHANGED: dict[tuple[Any, ...], Scenario] = {}
_MOST = 16


def changed(scenario: Scenario, changes: Mapping[str, Any]) -> Scenario:
    """Return the scenario with fields changed that may change on the way; see `apply` for their words.

    Raises
    ------
    ScenarioError : a field that stays as it is on the way, or that is not there, or a value that it cannot have
    """
    for path in changes:
        if not _is_live(path):
            raise ScenarioError(f"set {path}", "cannot change on the way", f"these can: {_LIVE}")
    if scenario.network.adaptive and any(path.split(".")[-1] == "neighbors" for path in changes):
        raise ScenarioError("set neighbors", "has no effect, for k adapts by itself", "leave out network.adaptive")
    known = scenario.name, scenario.hash, scenario.seed, str(sorted(changes.items()))
    if known not in _CHANGED:  # many agents go by the same
        while len(_CHANGED) >= _MOST:
            del _CHANGED[next(iter(_CHANGED))]
        _CHANGED[known] = scenario_from({**apply(table_of(scenario), changes), "commands": ()}, where="set")
    return _CHANGED[known]


def _is_live(path: str) -> bool:
    parts = path.split(".")
    if len(parts) > 2 and parts[0] == "fleets":
        parts = parts[2:]
    elif path == "network.neighbors":
        return True
    return parts == ["neighbors"] or (len(parts) == 2 and parts[0] == "strategy" and parts[1] not in RESERVED)


class Instructions:
    """What N agents go by.

    Parameters
    ----------
    scenarios : (N,) of each agent; those that go by the same share it
    """

    def __init__(self, scenarios: list[Scenario]) -> None:
        self._scenarios = scenarios

    @classmethod
    def of(cls, scenario: Scenario) -> "Instructions":
        """What agents go by when they set out."""
        return cls([scenario] * scenario.agents)

    def after(self, command: Command) -> "Instructions":
        """What they go by when a command has reached those that it is for.

        Raises
        ------
        ScenarioError : see `changed`
        """
        now, known = list(self._scenarios), dict[int, Scenario]()
        for agent in command.among(len(now)) if command.set else ():
            before = now[agent]
            if id(before) not in known:
                known[id(before)] = changed(before, command.set)
            now[agent] = known[id(before)]
        return Instructions(now)

    def degrees(self, crew: Crew) -> list[int]:
        """K of each agent, before it adapts, (N,)."""
        found = {id(each): degrees(each, crew) for each in self._scenarios}
        return [found[id(each)][fleet] for each, fleet in self._by_fleet()]

    def crew(self, crew: Crew) -> Crew:
        """The crew with the parameters that its agents go by.

        Raises
        ------
        ScenarioError : they change too often from agent to agent
        """
        choices = [each.fleets[fleet].strategy or each.strategy for each, fleet in self._by_fleet()]
        alike = [list(group) for _, group in groupby(choices)]
        return replace(crew, params=crew_params([group[0] for group in alike], [len(group) for group in alike]))

    def _by_fleet(self) -> Iterable[tuple[Scenario, int]]:
        counts = self._scenarios[0].counts
        fleets = [fleet for fleet, count in enumerate(counts) for _ in range(count)]
        return zip(self._scenarios, fleets, strict=True)


def check_commands(scenario: Scenario) -> None:
    """Refuse commands that cannot be obeyed.

    Raises
    ------
    ValueError : it says which
    """
    instructions = Instructions.of(scenario)
    crew = crew_of(scenario)
    for number, command in sorted(enumerate(scenario.commands), key=lambda each: each[1].step):
        if command.set:
            try:
                instructions = instructions.after(command)
                instructions.crew(crew)
            except ScenarioError as error:
                where, problem, fix = (text.replace("; ", ", ") for text in error.args)
                raise ValueError(f"commands.{number}.set is refused: {where}: {problem}; {fix}") from None
