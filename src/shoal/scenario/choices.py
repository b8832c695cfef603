"""What a scenario's fleets were given, in words: once if all have the same, otherwise of each."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from shoal.core.text import plain

if TYPE_CHECKING:
    from shoal.scenario.frozen import Frozen
    from shoal.scenario.schema import Fleet, Scenario


def strategy_text(scenario: "Scenario") -> str:
    """Names of the strategies: knn-pso; or levy-walk (scouts), knn-pso (trackers)."""
    return _of_fleets(scenario, [(fleet.strategy or scenario.strategy).name for fleet in scenario.fleets])


def degree_text(scenario: "Scenario", degrees: Sequence[int] | None = None) -> str:
    """How many neighbors are heard: 20; 5 (scouts), all (relays); or 10 to 25 (adaptive).

    degrees : k of each fleet, where the engine's is known; default: as far as the scenario says
    """
    if adaptive := scenario.network.adaptive:
        return f"{adaptive.fewest} to {adaptive.most} (adaptive)"
    if degrees is None:
        return _of_fleets(scenario, [degree_of_fleet(scenario, fleet) for fleet in scenario.fleets])
    asked = [fleet.neighbors or scenario.network.neighbors for fleet in scenario.fleets]
    return _of_fleets(scenario, [k if k == each else "all" for k, each in zip(degrees, asked, strict=True)])


def degree_of_fleet(scenario: "Scenario", fleet: "Fleet") -> int | str:
    """K of a fleet's agents before it adapts, or "all": so asked for, or what its strategy is defined for."""
    strategy = (fleet.strategy or scenario.strategy).known
    return "all" if strategy and strategy.hears_all else fleet.neighbors or scenario.network.neighbors


def _of_fleets(scenario: "Scenario", values: Sequence[Any]) -> str:
    words = {plain(name): plain(str(value)) for name, value in zip(scenario.fleet_names, values, strict=True)}
    if len(set(words.values())) == 1:
        return next(iter(words.values()))
    return ", ".join(f"{each} ({name})" for name, each in words.items())


def headline(scenario: "Scenario", degrees: Sequence[int] | None = None) -> str:
    """Who looks for what, in one line: 15 fast (8 m/s) + 35 slow (5 m/s), k = 20, knn-pso; waypoint target at 3 m/s."""
    fleets = " + ".join(f"{each.count} {each.name} ({each.max_speed:g} m/s)" for each in scenario.fleets)
    targets = " and ".join(map(_target, scenario.targets))
    return f"{fleets}, k = {degree_text(scenario, degrees)}, {strategy_text(scenario)}; {targets}"


def speed_of(target: "Frozen") -> float | None:
    """A target's speed [m/s]; None of one that has none."""
    return getattr(target, "speed", None) if "speed" in type(target).model_fields else None


def _target(target: Any) -> str:
    speed = speed_of(target)
    return f"{target.kind} target" + ("" if speed is None else f" at {speed:g} m/s")
