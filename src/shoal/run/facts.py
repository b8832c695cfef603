"""What metrics need to know of a scenario, and what the engine was given of each agent."""

from typing import Any

import numpy as np

from shoal.core.messages import REPORT_BYTES
from shoal.metrics.contract import Facts
from shoal.record.roster import Roster
from shoal.scenario.crew import Crew, crew_of
from shoal.scenario.schema import Scenario


def facts_of(scenario: Scenario) -> Facts:
    """What metrics need to know of a scenario."""
    fleets = scenario.fleets
    return Facts(
        fleets=tuple(fleet.name for fleet in fleets),
        counts=tuple(scenario.counts),
        max_speeds=tuple(fleet.max_speed for fleet in fleets),
        unit=scenario.unit,
        time_step=scenario.time_step,
        area=scenario.area.width * scenario.area.height,
        report_bytes=REPORT_BYTES + 8 * len(crew_of(scenario).told),
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
