"""One run that goes on while its scenario changes: what the controls of the page act on."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from shoal.core.errors import ScenarioError
from shoal.core.links import link_bytes
from shoal.run.carry_over import carry_over
from shoal.run.compiling import mark_compiled
from shoal.run.live_edits import move_target, remove_agent
from shoal.run.simulation import Simulation
from shoal.scenario.edit import apply
from shoal.scenario.load import scenario_from
from shoal.scenario.schema import Scenario
from shoal.strategies import CATALOGUE
from shoal.strategies.contract import RESERVED
from shoal.viewer.conditions import comings_and_goings
from shoal.viewer.frame import FULL, pack
from shoal.viewer.gauging import Gauging
from shoal.viewer.geography import geography_of
from shoal.viewer.scene import as_json, scene_of

Table = dict[str, Any]

CHANGEABLE = ("neighbors", "target_speed", "fast", "strategy")  # and strategy.PARAMETER


class LiveRun:
    """A run of the scenario that a raw table describes.

    Same table and same changes at the same steps: same bits.

    Attributes
    ----------
    place : 0, or 1 of the second of two runs side by side
    simulation : the run; its scenario is the current one
    message : the current scene, as the page gets it
    """

    def __init__(self, table: Table, place: int = 0, *, where: str = "scenario", text: str = "") -> None:
        self.place = place
        self._table = table
        self._epoch = -1
        scenario = scenario_from(table, where=where, text=text)
        self._first_strategy = (scenario.strategy.name, table["strategy"])
        self._begin(scenario)

    @property
    def ends(self) -> int | None:
        """The step from which no target will be there any more: where all recorded tracks are over; None if never."""
        scenario = self.simulation.scenario
        if any(target.kind != "track" for target in scenario.targets):
            return None
        return int(self.simulation.tracks.time.max() / scenario.time_step) + 1

    def advance(self, steps: int) -> None:
        """Advance by a number of steps."""
        self.simulation.advance(steps)

    def frame(self) -> bytes:
        """The bytes of the current frame."""
        shown = self.simulation.look()
        gauges = self._gauging.of(self.simulation, shown)
        lean = self.simulation.scenario.agents > FULL
        return pack(shown, 0, run=self.place, epoch=self._epoch, gauges=gauges, lean=lean)

    def scenario_with(self, changes: Mapping[str, Any]) -> tuple[Table, Scenario]:
        """Return table and scenario with some fields changed; nothing happens yet.

        Raises
        ------
        ScenarioError : a field that cannot be changed while a swarm runs, or what the scenario says of the value
        """
        for name in changes:
            if name not in CHANGEABLE and not _is_parameter(name):
                raise ScenarioError(name, "cannot be changed while the swarm runs", f"change {', '.join(CHANGEABLE)}")
        table = self._with_strategy(changes["strategy"]) if "strategy" in changes else self._table
        table = apply(table, {name: value for name, value in changes.items() if name != "strategy"})
        table = _with_empty_fleets(table, self._table)
        return table, _scenario_of(table)

    def change(self, changes: Mapping[str, Any]) -> None:
        """Change fields of the scenario: neighbors, target_speed, fast, strategy, strategy.PARAMETER.

        Raises
        ------
        ScenarioError : see `scenario_with`; then nothing has changed
        StrategyError : the strategy cannot be compiled
        """
        table, scenario = self.scenario_with(changes)
        self._become(table, carry_over(self.simulation, scenario))

    def kill(self, agent: int) -> None:
        """Let an agent be gone; it keeps its number."""
        remove_agent(self.simulation, agent)
        changed = carry_over(self.simulation, self.simulation.scenario)  # for sums that begin now
        self._become(self._table, changed)

    def add(self, fleet: int, x: float, y: float) -> None:
        """Let an agent join a fleet (by its current place among those) at x, y [m], as its last.

        Raises
        ------
        ScenarioError : no such fleet, a place outside the arena, or too many agents
        """
        old = self.simulation
        fleets, world = old.scenario.fleets, old.world
        if not 0 <= fleet < len(fleets):
            raise ScenarioError("fleet", f"is {fleet}", f"name one from 0 to {len(fleets) - 1}")
        if abs(x) > world.clamp_x or abs(y) > world.clamp_y:
            room = f"{world.clamp_x:g} m east or west and {world.clamp_y:g} m north or south"
            raise ScenarioError("add", f"({x:g}, {y:g}) m is outside the arena", f"stay within {room} of its center")
        name = fleets[fleet].name
        more = [{**each, "count": each["count"] + (each["name"] == name)} for each in self._table["fleets"]]
        table = {**self._table, "fleets": more}
        scenario = _scenario_of(table)
        newcomer = int(old.swarm.fleet_end[fleet])
        origin = np.insert(np.arange(old.scenario.agents), newcomer, -1)
        new = carry_over(old, scenario, origin)
        with new.edit() as now:
            now.swarm.x[newcomer], now.swarm.y[newcomer] = x, y
        self._become(table, new)

    def drag(self, target: int, x: float, y: float) -> None:
        """Put a target somewhere; it goes on from there, and sums go on, too."""
        move_target(self.simulation, target, x, y)

    def restart(self, seed: int | None = None) -> None:
        """Start over with the current settings, the killed back among the others."""
        if seed is not None:
            self._table = {**self._table, "seed": seed}
        self._begin(_scenario_of(self._table))

    def _begin(self, scenario: Scenario) -> None:
        simulation = Simulation(scenario)
        simulation.advance(0)  # compiles
        mark_compiled(scenario)
        self._gauging = Gauging(scenario)
        self._settle(simulation)

    def _become(self, table: Table, simulation: Simulation) -> None:
        """Go on as a changed swarm."""
        simulation.advance(0)
        mark_compiled(simulation.scenario)
        self._gauging.begin_anew(self.simulation, simulation.scenario)
        self._table = table
        self._settle(simulation)

    def _settle(self, simulation: Simulation) -> None:
        self.simulation = simulation
        self._epoch += 1
        agents = simulation.scenario.agents
        scene = scene_of(
            simulation.scenario,
            simulation.memory_fields,
            has_links=link_bytes(agents) > 0,
            epoch=self._epoch,
            since=simulation.number,
            events=comings_and_goings(simulation.swarm.joins[:agents], simulation.swarm.leaves[:agents]),
            ends=self.ends,
            geography=geography_of(simulation.scenario),
        )
        self.message = as_json({"type": "scene", "run": self.place, "scene": scene})

    def _with_strategy(self, name: Any) -> Table:
        """The table with another strategy: of the catalogue, or the one that the run began with; never a file."""
        if name == self.simulation.scenario.strategy.name:
            return self._table
        if name == self._first_strategy[0]:
            return {**self._table, "strategy": self._first_strategy[1]}
        if name not in CATALOGUE:
            known = ", ".join(sorted(CATALOGUE))
            raise ScenarioError("strategy", f"no strategy is called {name!r}", f"choose one of: {known}")
        return {**self._table, "strategy": {"name": name}}


def _is_parameter(name: str) -> bool:
    table, _, field = name.partition(".")
    return table == "strategy" and field.isidentifier() and field not in RESERVED


def _scenario_of(table: Table) -> Scenario:
    """The scenario of a table whose fleets may be empty for a while."""
    return scenario_from(
        {**table, "fleets": [fleet for fleet in table["fleets"] if fleet["count"] != 0]}, where="change"
    )


def _with_empty_fleets(table: Table, before: Table) -> Table:
    """`fast` drops a fleet that it empties; here it stays in the table, so that it can be filled again."""
    now = {fleet["name"]: fleet for fleet in table["fleets"]}
    return {**table, "fleets": [now.get(fleet["name"], {**fleet, "count": 0}) for fleet in before["fleets"]]}
