"""A scene: what does not change from frame to frame, as JSON for the page."""

import json
import math
from collections.abc import Iterable, Sequence
from pathlib import PurePath
from typing import Any

from shoal.scenario.choices import degree_text, speed_of, strategy_text
from shoal.scenario.schema import Scenario
from shoal.scenario.strategy_choice import params_model
from shoal.strategies import Strategy
from shoal.viewer.conditions import Event, conditions_of
from shoal.viewer.frame import REPULSION, remembered

_EXACT = 2**53  # beyond, JavaScript's numbers have gaps


def scene_of(
    scenario: Scenario, memory: Iterable[str], *, has_links: bool, epoch: int = 0, since: int = 0,
    events: Sequence[Event] = (), ends: int | None = None, geography: dict[str, Any] | None = None,
) -> dict[str, Any]:  # fmt: skip
    """Return the scene of a scenario, SI and defaults filled in.

    Parameters
    ----------
    memory : fields that agents remember
    has_links : whether frames say who hears whom
    epoch, since : number of this scene, and the step that it begins with
    events : who joins and who is lost, as far as it is known
    ends : step from which no target will be there any more, if there is one
    geography : see geography.py
    """
    area, strategy, seed = scenario.area, scenario.strategy, scenario.seed
    fields, units = list(memory), _units(scenario)
    return {
        "epoch": epoch,
        "name": scenario.name,
        "time_step": scenario.time_step,
        "steps": scenario.steps,
        "seed": seed if seed < _EXACT else str(seed),
        "unit": scenario.unit,
        "since": since,
        "area": {
            "width": area.width,
            "height": area.height,
            "half_x": area.width / 2 - area.agent_margin,
            "half_y": area.height / 2 - area.agent_margin,
        },
        "fleets": [
            {
                "name": fleet.name,
                "count": count,
                "max_speed": fleet.max_speed,
                "sensor_radius": fleet.sensor_radius,
                "strategy": (fleet.strategy or strategy).name,
            }
            for fleet, count in zip(scenario.fleets, scenario.counts, strict=True)
        ],
        "targets": [
            {"kind": target.kind, "name": _name_of(target), "radius": target.radius, "speed": speed_of(target)}
            for target in scenario.targets
        ],
        "neighbors": scenario.network.neighbors,
        "k": degree_text(scenario),
        "adapts": scenario.network.adaptive is not None,
        "range": scenario.network.range,
        "strategy": {
            "name": strategy.name,
            "params": strategy.params,
            "summary": strategy.known.summary if strategy.known else "",
        },
        "strategies": strategy_text(scenario),
        "conditions": conditions_of(scenario),
        "events": events,
        "ends": ends,
        "geography": geography,
        "has_repulsion": REPULSION in fields,
        "memory": [{"name": name, "unit": units.get(name, "")} for name in remembered(fields, scenario.agents)],
        "delay": scenario.network.delay,
        "has_links": has_links,
    }


def _name_of(target: Any) -> str | None:
    """What a recorded target is called: its file, and which track of that."""
    if target.kind != "track":
        return None
    return f"{PurePath(target.file).name}{f', {target.id}' if target.id else ''}"


def _units(scenario: Scenario) -> dict[str, str]:
    """Unit of each field that agents remember, as far as their strategies are known here."""
    choices = (scenario.strategy, *(fleet.strategy for fleet in scenario.fleets))
    return {field: unit for choice in choices if choice and choice.known for field, unit in choice.known.memory.items()}


def describe(strategy: Strategy) -> dict[str, Any]:
    """A strategy and its parameters, for the page's menu."""
    fields = params_model(strategy).model_json_schema()["properties"]
    return {
        "name": strategy.name,
        "summary": strategy.summary,
        "parameters": {
            name: {
                "default": field["default"],
                "unit": field.get("unit"),
                "description": field.get("description", ""),
                "type": field.get("type", "number"),
                "choices": field.get("enum"),
            }
            for name, field in fields.items()
            if name != "name"
        },
    }


def as_json(content: Any) -> str:
    """JSON on one line that can stand inside HTML: no number that does not exist, no way to end a script element."""
    return json.dumps(_finite(content), allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")


def _finite(value: Any) -> Any:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _finite(each) for key, each in value.items()}
    return [_finite(each) for each in value] if isinstance(value, (list, tuple)) else value
