"""What agents are told before they leave: nothing that they could only learn at sea."""

from typing import Any

import numpy as np

from shoal.core.errors import ScenarioError
from shoal.core.messages import Briefing
from shoal.scenario.at_sea import open_sea
from shoal.scenario.crew import Crew
from shoal.scenario.load import Source, load
from shoal.scenario.schema import Scenario
from shoal.scenario.stations import stations


def briefing(scenario: Source, id: int) -> Briefing:
    """Return what an agent is told before it leaves: `me.briefing` of its strategy.

    Parameters
    ----------
    scenario : a preset's name, a TOML file, a dict or a Scenario
    id : number of the agent, 0 to N - 1

    Raises
    ------
    ScenarioError : there is no such agent
    SeaError : a file of its sea cannot be used
    """
    return briefing_in(load(scenario), id)


def briefing_in(scenario: Scenario, id: int) -> Briefing:
    """As `briefing`, of a scenario that is loaded."""
    fleet = scenario.fleets[fleet_of(scenario, id)]
    ends = shares(scenario)
    opened = open_sea(scenario)
    shore = opened.shore if opened else None
    x, y = stations(scenario, shore)[id] if shore is not None else (0.0, 0.0)
    return Briefing(
        agents=scenario.agents,
        half_x=scenario.area.width / 2 - scenario.area.agent_margin,
        half_y=scenario.area.height / 2 - scenario.area.agent_margin,
        reach=fleet.sensor_radius + min(target.radius for target in scenario.targets),
        share_begin=float(ends[id - 1]) if id > 0 else 0.0,
        share_end=float(ends[id]),
        charted=shore is not None,
        station_x=float(x),
        station_y=float(y),
    )


def fleet_of(scenario: Scenario, id: int) -> int:
    """Return the index of an agent's fleet.

    Raises
    ------
    ScenarioError : there is no such agent
    """
    if isinstance(id, bool) or not isinstance(id, (int, np.integer)) or not 0 <= id < scenario.agents:
        raise ScenarioError("id", f"is {id!r}", f"name an agent by its number, 0 to {scenario.agents - 1}")
    return int(np.searchsorted(np.cumsum(scenario.counts), id, side="right"))


def shares(scenario: Scenario) -> Any:
    """Return where each agent's share of the summed top speeds ends, from 0 to 1 in the order of ids, (N,)."""
    speeds = np.repeat([fleet.max_speed for fleet in scenario.fleets], scenario.counts)
    return np.cumsum(speeds) / speeds.sum()


def degrees(scenario: Scenario, crew: Crew) -> list[int]:
    """Return k of each fleet, before it adapts."""
    everybody = scenario.agents - 1
    chosen = [fleet.neighbors or scenario.network.neighbors for fleet in scenario.fleets]
    return [
        everybody if strategy.hears_all or degree == "all" else degree
        for strategy, degree in zip(crew.strategies, chosen, strict=True)
    ]
