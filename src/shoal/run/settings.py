"""Settings of a swarm that is steered: its raw table, and what the table becomes with each change."""

from collections.abc import Mapping
from typing import Any, NamedTuple, Self

from shoal.core.errors import ScenarioError
from shoal.scenario.edit import apply
from shoal.scenario.load import scenario_from
from shoal.scenario.schema import Scenario
from shoal.strategies import CATALOGUE
from shoal.strategies.contract import RESERVED

Table = dict[str, Any]

CHANGEABLE = ("neighbors", "target_speed", "fast", "strategy")  # and strategy.PARAMETER


class Settings(NamedTuple):
    """What a swarm is set to. Same table, same changes: same settings.

    table : as a file would say it; fleets may be empty for a while
    scenario : of the table
    first_strategy : name and table of the strategy that it began with, to which it can come back
    """

    table: Table
    scenario: Scenario
    first_strategy: tuple[str, Any]

    @classmethod
    def of(cls, table: Table, *, where: str = "scenario", text: str = "") -> Self:
        """Return the settings that a run begins with.

        Parameters
        ----------
        where, text : what errors call the table, and its TOML

        Raises
        ------
        ScenarioError, TrackError, StrategyError : what cannot run
        """
        scenario = scenario_from(table, where=where, text=text)
        return cls(table, scenario, (scenario.strategy.name, table["strategy"]))

    def changed(self, changes: Mapping[str, Any]) -> Self:
        """Return the settings with some fields changed: neighbors, target_speed, fast, strategy, strategy.PARAMETER.

        Raises
        ------
        ScenarioError : a field that cannot be changed while a swarm runs, or what the scenario says of the value
        """
        for name in changes:
            if name not in CHANGEABLE and not _is_parameter(name):
                raise ScenarioError(name, "cannot be changed while the swarm runs", f"change {', '.join(CHANGEABLE)}")
        table = self._with_strategy(changes["strategy"]) if "strategy" in changes else self.table
        table = apply(table, {name: value for name, value in changes.items() if name != "strategy"})
        return self._become(_with_empty_fleets(table, self.table))

    def joined(self, fleet: str) -> Self:
        """Return the settings with one more agent of a fleet.

        Raises
        ------
        ScenarioError : too many agents
        """
        more = [{**each, "count": each["count"] + (each["name"] == fleet)} for each in self.table["fleets"]]
        return self._become({**self.table, "fleets": more})

    def seeded(self, seed: int | None) -> Self:
        """Return the settings with another seed; None: with the same."""
        return self._become(self.table if seed is None else {**self.table, "seed": seed})

    def lasting(self, steps: int) -> Self:
        """Return the settings of a run of so many steps."""
        return self._become({**self.table, "steps": steps})

    def _become(self, table: Table) -> Self:
        there = {**table, "fleets": [fleet for fleet in table["fleets"] if fleet["count"] != 0]}
        return self._replace(table=table, scenario=scenario_from(there, where="change"))

    def _with_strategy(self, name: Any) -> Table:
        """The table with another strategy: of the catalogue, or the one that the run began with; never a file."""
        if name == self.scenario.strategy.name:
            return self.table
        if name == self.first_strategy[0]:
            return {**self.table, "strategy": self.first_strategy[1]}
        if name not in CATALOGUE:
            known = ", ".join(sorted(CATALOGUE))
            raise ScenarioError("strategy", f"no strategy is called {name!r}", f"choose one of: {known}")
        return {**self.table, "strategy": {"name": name}}


def _is_parameter(name: str) -> bool:
    table, _, field = name.partition(".")
    return table == "strategy" and field.isidentifier() and field not in RESERVED


def _with_empty_fleets(table: Table, before: Table) -> Table:
    """`fast` drops a fleet that it empties; here it stays in the table, so that it can be filled again."""
    now = {fleet["name"]: fleet for fleet in table["fleets"]}
    return {**table, "fleets": [now.get(fleet["name"], {**fleet, "count": 0}) for fleet in before["fleets"]]}
