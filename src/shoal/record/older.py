"""What records of formats 1 and 2 do not hold, derived from what they do: the only place that works out such facts."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.record.roster import Roster
from shoal.scenario.choices import degree_of_fleet
from shoal.scenario.schema import Scenario

Arrays = Mapping[str, npt.NDArray[Any]]


def roster_from(scenario: Scenario) -> Roster:
    """What a scenario says of its agents, as the engine would read it."""
    fleets, counts, agents = scenario.fleets, scenario.counts, scenario.agents
    degrees = [degree_of_fleet(scenario, fleet) for fleet in fleets]
    joins = np.zeros(agents, np.int64)
    for fleet, name in enumerate(scenario.fleet_names):
        later = [join.step for join in scenario.joins if join.fleet == name for _ in range(join.count)]
        end = sum(counts[: fleet + 1])
        joins[end - len(later) : end] = later
    return Roster(
        fleet=np.repeat(np.arange(len(fleets)), counts),
        max_speed=np.repeat([fleet.max_speed for fleet in fleets], counts),
        sensor_radius=np.repeat([fleet.sensor_radius for fleet in fleets], counts),
        neighbors=np.repeat([agents - 1 if each == "all" else int(each) for each in degrees], counts),
        strategy=np.repeat([(fleet.strategy or scenario.strategy).name for fleet in fleets], counts),
        joins=joins,
    )


def completed(arrays: Arrays, scenario: Scenario, roster: Roster) -> dict[str, npt.NDArray[Any]]:
    """Frames with the current arrays, as far as the stored ones tell.

    Engaged is whoever reports a target that is within its reach; the velocity wanted is taken to be the one made, k the
    one begun with. Links are not known.
    """
    frames, agents = arrays["x"].shape
    return {
        **arrays,
        "command_x": arrays["vx"],
        "command_y": arrays["vy"],
        "engaged": _near(arrays, scenario, roster) & arrays["on_target"] & arrays["alive"],
        "neighbors": np.broadcast_to(roster.neighbors, (frames, agents)),
        "links": np.zeros((frames, agents, 0), np.uint8),
    }


def _near(arrays: Arrays, scenario: Scenario, roster: Roster) -> npt.NDArray[np.bool_]:
    """Whether an agent is within reach of a present target, (K, N)."""
    near = np.zeros(arrays["x"].shape, bool)
    for number, target in enumerate(scenario.targets):
        dx = arrays["x"] - arrays["target_x"][:, number, None]
        dy = arrays["y"] - arrays["target_y"][:, number, None]
        there = np.asarray(arrays["target_present"][:, number, None])
        near |= (dx * dx + dy * dy <= (roster.sensor_radius + target.radius) ** 2) & there
    return near
