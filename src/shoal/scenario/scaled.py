"""A scenario on another scale: every quantity multiplied by a factor of its unit."""

import math
from collections.abc import Mapping
from typing import Any, get_args, get_type_hints

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from shoal.core.errors import ScenarioError
from shoal.core.text import quoted
from shoal.core.units import Unit
from shoal.scenario.schema import Scenario
from shoal.scenario.strategy_choice import StrategyChoice


def scaled(scenario: Scenario, factor: float | None = None, to: float | str | None = None) -> dict[str, Any]:
    """Return the table of a scenario with its lengths and times multiplied: the same motion, larger and slower.

    Speeds, numbers, chances, angles and what is counted in steps stay; what is per second is divided. What strategies
    leave to follow the scenario follows.

    Parameters
    ----------
    factor : above 0; or
    to : the longer side of the area wanted [m], or "3 km"

    Raises
    ------
    ScenarioError : neither or both, nothing to scale by, or a recorded track, whose fixes are where they are
    """
    if (factor is None) == (to is None):
        raise ScenarioError("scaled", "takes a factor or a size", 'write scaled(150) or scaled(to="3 km")')
    if factor is None:
        factor = _quantity("size", to, Unit("m")) / max(scenario.area.width, scenario.area.height)
    elif isinstance(factor, bool) or not isinstance(factor, (int, float)) or not 0 < factor < math.inf:
        raise ScenarioError("factor", f"is {quoted(factor)}", "give a number above 0, such as 150")
    if any(target.kind == "track" for target in scenario.targets) or scenario.area.origin is not None:
        fix = "put the scenario before it on the track: target_track scales its lengths"
        raise ScenarioError("scaled", "a scenario at a place on Earth has its size", fix)
    return multiplied(scenario, {"m": factor, "s": factor, "m/s^2": 1 / factor, "deg/s": 1 / factor})


def multiplied(scenario: Scenario, factors: Mapping[str, float]) -> dict[str, Any]:
    """Return the table of a scenario with every quantity of these units multiplied, those of strategies, too.

    factors : {SI unit: factor}; others stay
    """
    if any(".neighbors" not in f".{path}" for command in scenario.commands for path in command.set):
        problem = "set parameters of strategies, which keep their size"
        raise ScenarioError("commands", problem, "leave them out, and add them to the scaled scenario")
    table: dict[str, Any] = scenario.model_dump(mode="json")
    _multiply(scenario, table, factors)
    return table


def _multiply(part: BaseModel, table: dict[str, Any], factors: Mapping[str, float]) -> None:
    for name, field in type(part).model_fields.items():
        value = vars(part)[name]
        if isinstance(value, StrategyChoice):
            _multiply_params(value, table[name], factors)
        elif isinstance(value, BaseModel):
            _multiply(value, table[name], factors)
        elif isinstance(value, tuple) and all(isinstance(each, BaseModel) for each in value):
            for each, entry in zip(value, table[name], strict=True):
                _multiply(each, entry, factors)
        elif isinstance(value, tuple) and _is_of_places(value):
            table[name] = _times(value, factors.get("m", 1.0))
        elif value is not None and (unit := unit_of(field)) in factors:
            table[name] = value * factors[unit]


def _is_of_places(value: Any) -> bool:
    """Whether these are polygons: tuples of tuples of x and y [m]."""
    while isinstance(value, tuple) and value and isinstance(value[0], tuple):
        value = value[0]
        if len(value) == 2 and all(isinstance(each, float) for each in value):
            return True
    return False


def _times(value: Any, factor: float) -> Any:
    return [_times(each, factor) for each in value] if isinstance(value, tuple) else value * factor


def _multiply_params(choice: StrategyChoice, table: dict[str, Any], factors: Mapping[str, float]) -> None:
    """Multiply what is said of a strategy's parameters; one that this process does not know stays."""
    hints = get_type_hints(choice.known.params, include_extras=True) if choice.known else {}
    for name in hints.keys() & table.keys():
        unit = next((mark for mark in getattr(hints[name], "__metadata__", ()) if isinstance(mark, Unit)), None)
        if unit and unit.symbol in factors:
            table[name] *= factors[unit.symbol]


def unit_of(field: FieldInfo) -> str:
    """The SI unit of a field that is a quantity, or may be: Meters, or Meters | None; else nothing."""
    choices = (getattr(each, "__metadata__", ()) for each in get_args(field.annotation))
    return next((mark.symbol for marks in (field.metadata, *choices) for mark in marks if isinstance(mark, Unit)), "")


def _quantity(name: str, value: Any, unit: Unit) -> float:
    """A quantity above 0, in SI.

    Raises
    ------
    ScenarioError : it is none
    """
    try:
        number = unit.parse(value)
    except ValueError as error:
        problem, _, fix = str(error).partition("; ")
        raise ScenarioError(name, problem, fix or "change the value") from None
    if not isinstance(number, (int, float)) or not 0 < number < math.inf:
        raise ScenarioError(name, f"is {quoted(value)}", 'give a length above 0, such as "3 km"')
    return float(number)
