"""One run that goes on while its scenario changes."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from shoal.core.errors import ScenarioError
from shoal.run.carry_over import carry_over
from shoal.run.changes import Add, Change, Drag, Kill, Restart, Steering
from shoal.run.compiling import mark_compiled
from shoal.run.facts import facts_of
from shoal.run.live_edits import move_target, remove_agent
from shoal.run.settings import Settings, Table
from shoal.run.simulation import Simulation
from shoal.scenario.schema import Scenario


class SteeredRun:
    """A run of some settings. Same settings and same changes at the same steps: same bits.

    Parameters
    ----------
    settings : what it begins with
    recorded : one record must hold it: what would change fleets or the size of reports is refused
    sums : sums go on when it changes; else they start over

    Attributes
    ----------
    settings : as they are now
    simulation : the run; its scenario is the current one
    """

    def __init__(self, settings: Settings, *, recorded: bool = False, sums: bool = False) -> None:
        self.settings = settings
        self._recorded, self._sums = recorded, sums
        self._begin()

    @property
    def table(self) -> Table:
        """The raw table that the swarm is set to."""
        return self.settings.table

    def advance(self, steps: int) -> None:
        """Advance by a number of steps."""
        self.simulation.advance(steps)

    def steer(self, steering: Steering) -> None:
        """Do what is asked for, from the coming step on.

        Raises
        ------
        ScenarioError, StrategyError : it cannot be done; then nothing has changed
        """
        match steering:
            case Restart(seed=seed):
                self.restart(seed)
            case Change(changes=changes):
                self.change(changes)
            case Kill(agent=agent):
                self.kill(agent)
            case Add(fleet=fleet, x=x, y=y):
                self.add(fleet, x, y)
            case Drag(target=target, x=x, y=y):
                self.drag(target, x, y)

    def scenario_with(self, changes: Mapping[str, Any]) -> Scenario:
        """Return the scenario with some fields changed; nothing happens yet.

        Raises
        ------
        ScenarioError : see `Settings.changed`
        """
        return self.settings.changed(changes).scenario

    def change(self, changes: Mapping[str, Any]) -> None:
        """Change fields of the scenario: neighbors, target_speed, fast, strategy, strategy.PARAMETER.

        Raises
        ------
        ScenarioError : see `Settings.changed`; then nothing has changed
        StrategyError : the strategy cannot be compiled
        """
        settings = self.settings.changed(changes)
        self._check_recorded(settings.scenario, ", ".join(changes))
        self._become(settings, carry_over(self.simulation, settings.scenario, sums=self._sums))

    def kill(self, agent: int) -> None:
        """Let an agent be gone; it keeps its number."""
        remove_agent(self.simulation, agent)
        scenario = self.simulation.scenario
        self._become(self.settings, carry_over(self.simulation, scenario, sums=self._sums))

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
        settings = self.settings.joined(fleets[fleet].name)
        self._check_recorded(settings.scenario, "add")
        newcomer = int(old.swarm.fleet_end[fleet])
        origin = np.insert(np.arange(old.scenario.agents), newcomer, -1)
        new = carry_over(old, settings.scenario, origin)
        with new.edit() as now:
            now.swarm.x[newcomer], now.swarm.y[newcomer] = x, y
        self._become(settings, new)

    def drag(self, target: int, x: float, y: float) -> None:
        """Put a target somewhere; it goes on from there, and sums go on, too."""
        move_target(self.simulation, target, x, y)

    def restart(self, seed: int | None = None) -> None:
        """Start over with the current settings, the killed back among the others."""
        self.settings = self.settings.seeded(seed)
        self._begin()

    def _check_recorded(self, scenario: Scenario, what: str) -> None:
        if self._recorded and facts_of(scenario) != facts_of(self.settings.scenario):
            problem = "would change fleets or the size of a report, and a record has one of each"
            raise ScenarioError(what, problem, "watch without --out")

    def _begin(self) -> None:
        simulation = Simulation(self.settings.scenario)
        simulation.advance(0)  # compiles
        mark_compiled(simulation.scenario)
        self._settle(simulation, None)

    def _become(self, settings: Settings, simulation: Simulation) -> None:
        """Go on as a changed swarm."""
        simulation.advance(0)
        mark_compiled(simulation.scenario)
        self.settings = settings
        self._settle(simulation, self.simulation)

    def _settle(self, simulation: Simulation, before: Simulation | None) -> None:
        """Take over a simulation that begins, or that goes on from the one before."""
        self.simulation = simulation
