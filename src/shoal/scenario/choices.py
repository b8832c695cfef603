"""What a scenario's fleets were given, in words: once if all have the same, otherwise of each."""

from collections.abc import Callable, Mapping
from typing import Any

from shoal.core.text import plain
from shoal.strategies.plugins import find_strategy


def strategy_text(scenario: Mapping[str, Any]) -> str:
    """Names of the strategies: knn-pso; or levy-walk (scouts), knn-pso (trackers)."""
    return _of_fleets(scenario, lambda fleet: (fleet.get("strategy") or scenario["strategy"])["name"])


def degree_text(scenario: Mapping[str, Any]) -> str:
    """How many neighbors are heard: 20; 5 (scouts), all (relays); or 10 to 25 (adaptive)."""
    network = scenario["network"]
    if adaptive := network.get("adaptive"):
        return f"{adaptive['fewest']} to {adaptive['most']} (adaptive)"
    return _of_fleets(scenario, lambda fleet: degree_of_fleet(scenario, fleet))


def degree_of_fleet(scenario: Mapping[str, Any], fleet: Mapping[str, Any]) -> int | str:
    """K of a fleet's agents before it adapts, or "all": so asked for, or what its strategy is defined for."""
    chosen = fleet.get("strategy") or scenario["strategy"]
    strategy = find_strategy(chosen["name"], chosen.get("source"))
    degree: int | str = fleet.get("neighbors") or scenario["network"]["neighbors"]
    return "all" if strategy and strategy.hears_all else degree


def _of_fleets(scenario: Mapping[str, Any], value: Callable[[Mapping[str, Any]], Any]) -> str:
    values = {plain(fleet["name"]): plain(str(value(fleet))) for fleet in scenario["fleets"]}
    if len(set(values.values())) == 1:
        return next(iter(values.values()))
    return ", ".join(f"{each} ({name})" for name, each in values.items())


def headline(scenario: Mapping[str, Any]) -> str:
    """Who looks for what, in one line: 15 fast (8 m/s) + 35 slow (5 m/s), k = 20, knn-pso; waypoint target at 3 m/s."""
    fleets = " + ".join(f"{each['count']} {each['name']} ({each['max_speed']:g} m/s)" for each in scenario["fleets"])
    targets = " and ".join(map(_target, scenario["targets"]))
    return f"{fleets}, k = {degree_text(scenario)}, {strategy_text(scenario)}; {targets}"


def _target(target: Mapping[str, Any]) -> str:
    return f"{target['kind']} target" + (f" at {target['speed']:g} m/s" if "speed" in target else "")
