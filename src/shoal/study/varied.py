"""Fields that vary, as Python says them: lists, ranges, arrays, or text as of --vary."""

import json
from collections.abc import Iterable, Mapping
from typing import Any

from shoal.core.errors import ScenarioError
from shoal.experiments.design import parse_values
from shoal.scenario.frozen import plain
from shoal.scenario.strategy_choice import StrategyChoice
from shoal.strategies.plugins import name_of

Values = Iterable[Any] | str | float


def varied(vary: Mapping[str, Values]) -> dict[str, list[Any]]:
    """Return the values of each field as a list.

    Raises
    ------
    ScenarioError : `vary` is not a mapping, or a field has no values
    """
    if not isinstance(vary, Mapping) or not all(isinstance(name, str) for name in vary):
        raise ScenarioError("vary", f"is {vary!r:.60}", 'write vary={"neighbors": [10, 20, 30]}')
    return {_word(name): _values(name, values) for name, values in vary.items()}


def written(value: Any) -> Any:
    """Return a value as a store can keep it: of a strategy its name or its table, of NumPy's numbers Python's.

    Raises
    ------
    ScenarioError : nothing that a scenario could say
    """
    try:
        return json.loads(json.dumps(plain(name_of(value)), default=_table))
    except (TypeError, ValueError):
        raise ScenarioError("change", f"cannot be {value!r:.60}", "give a number, a text, a list or a table") from None


def _table(value: Any) -> Any:
    if isinstance(value, StrategyChoice):
        return value.flat()
    raise TypeError(value)


def _values(name: str, values: Values) -> list[Any]:
    if isinstance(values, str):
        return parse_values(values, f"vary {name}")
    listed = values if isinstance(values, Iterable) and not isinstance(values, Mapping) else [values]
    found = [written(each) for each in listed]
    if not found:
        raise ScenarioError(f"vary {name}", "has no values", "give one or more")
    return found


def _word(name: str) -> str:
    return name if "." in name else name.replace("-", "_")
