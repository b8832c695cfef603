"""A scene: what does not change from frame to frame, as JSON for the page."""

import json
import math
from collections.abc import Iterable
from typing import Any

from shoal.metrics.contract import Facts
from shoal.scenario.strategy_choice import params_model
from shoal.strategies import Strategy
from shoal.strategies.contract import RESERVED
from shoal.strategies.plugins import find_strategy

REPULSION = "repulsion"  # the memory field that the page shows as a_R
_EXACT = 2**53  # beyond, JavaScript's numbers have gaps


def scene_of(
    scenario: dict[str, Any], facts: Facts, memory: Iterable[str], *, epoch: int = 0, since: int = 0
) -> dict[str, Any]:
    """Return the scene of a scenario as its file would say it, SI and defaults filled in.

    Parameters
    ----------
    memory : fields that agents remember
    epoch, since : number of this scene, and the step that it begins with
    """
    area, network = scenario["area"], scenario["network"]
    strategy = scenario["strategy"]
    known = find_strategy(strategy["name"], strategy.get("source"))
    seed = scenario["seed"]
    return {
        "epoch": epoch,
        "name": scenario["name"],
        "time_step": scenario["time_step"],
        "steps": scenario["steps"],
        "seed": seed if seed < _EXACT else str(seed),
        "unit": facts.unit,
        "since": since,
        "area": {
            "width": area["width"],
            "height": area["height"],
            "half_x": area["width"] / 2 - area["agent_margin"],
            "half_y": area["height"] / 2 - area["agent_margin"],
        },
        "fleets": [
            {
                "name": fleet["name"],
                "count": count,
                "max_speed": fleet["max_speed"],
                "sensor_radius": fleet["sensor_radius"],
            }
            for fleet, count in zip(scenario["fleets"], facts.counts, strict=True)
        ],
        "targets": [
            {"kind": target["kind"], "radius": target["radius"], "speed": target.get("speed")}
            for target in scenario["targets"]
        ],
        "neighbors": network["neighbors"],
        "range": network.get("range"),
        "strategy": {
            "name": strategy["name"],
            "params": {name: value for name, value in strategy.items() if name not in RESERVED},
            "summary": known.summary if known else "",
        },
        "has_repulsion": REPULSION in memory,
    }


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
