"""What metrics need to know of a scenario, and what the engine was given of each agent."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from shoal.metrics.contract import Facts
from shoal.record.roster import Roster
from shoal.scenario.assumptions import airtime, report_size
from shoal.scenario.crew import Crew
from shoal.scenario.schema import Scenario


def facts_of(scenario: Scenario) -> Facts:
    """What metrics need to know of a scenario."""
    fleets = scenario.fleets
    powered = any(fleet.battery for fleet in fleets)
    priced = all(fleet.cost is not None for fleet in fleets)
    return Facts(
        fleets=tuple(fleet.name for fleet in fleets),
        counts=tuple(scenario.counts),
        max_speeds=tuple(fleet.max_speed for fleet in fleets),
        unit=scenario.unit,
        time_step=scenario.time_step,
        area=scenario.area.width * scenario.area.height,
        report_bytes=report_size(scenario),
        interval=0.0 if scenario.report_steps == 1 else scenario.report_interval,
        airtime=airtime(scenario),
        capacities=tuple(fleet.battery.capacity if fleet.battery else 0.0 for fleet in fleets) if powered else (),
        costs=tuple(fleet.cost for fleet in fleets if fleet.cost is not None) if priced else (),
    )


def facts_told(told: Mapping[str, Any]) -> Facts:
    """The facts that somebody else's scene tells: fleets, unit and time-step, and no more.

    Raises
    ------
    KeyError, TypeError, ValueError : it does not
    """
    fleets = told["fleets"]
    return Facts(
        fleets=tuple(str(each["name"]) for each in fleets),
        counts=tuple(int(each["count"]) for each in fleets),
        max_speeds=tuple(float(each["max_speed"]) for each in fleets),
        unit=float(told["unit"]),
        time_step=float(told["time_step"]),
    )


def roster_of(swarm: Any, agents: int, crew: Crew) -> Roster:
    """What a swarm's arrays of N agents say before the first step."""
    fleet = swarm.fleet[:agents].copy()
    names = np.array([strategy.name for strategy in crew.strategies])
    return Roster(
        fleet=fleet,
        max_speed=swarm.max_speed[:agents].copy(),
        sensor_radius=swarm.sensor_radius[:agents].copy(),
        neighbors=swarm.neighbors[:agents].copy(),
        strategy=names[fleet],
        joins=swarm.joins[:agents].copy(),
    )
