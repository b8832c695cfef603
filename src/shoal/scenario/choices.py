"""What a scenario's fleets were given, in words: once where all have the same, else of each."""

from collections.abc import Callable, Mapping
from typing import Any


def strategy_text(scenario: Mapping[str, Any]) -> str:
    """Names of the strategies: knn-pso; or levy-walk (scouts), knn-pso (trackers)."""
    return _of_fleets(scenario, lambda fleet: (fleet.get("strategy") or scenario["strategy"])["name"])


def degree_text(scenario: Mapping[str, Any]) -> str:
    """How many neighbors are heard: 20; 5 (scouts), all (relays); or 10 to 25 (adaptive)."""
    network = scenario["network"]
    if adaptive := network.get("adaptive"):
        return f"{adaptive['fewest']} to {adaptive['most']} (adaptive)"
    return _of_fleets(scenario, lambda fleet: fleet.get("neighbors") or network["neighbors"])


def _of_fleets(scenario: Mapping[str, Any], value: Callable[[Mapping[str, Any]], Any]) -> str:
    values = {fleet["name"]: str(value(fleet)) for fleet in scenario["fleets"]}
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
