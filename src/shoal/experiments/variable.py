"""A variable of a search: a field of a scenario, and between or among which values it is looked for."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from shoal.core.errors import ScenarioError
from shoal.core.text import cut
from shoal.experiments.design import parse_values
from shoal.scenario.edit import parse_value

_FARTHEST = 1e18
_DECADE = 10.0  # a range of decimals that spans this factor is searched by its logarithm


@dataclass(frozen=True)
class Variable:
    """A field, shorthand or path, and its values: all from `low` to `high`, or the `choices`.

    Attributes
    ----------
    field : neighbors, target_speed, strategy.delta, ...
    low, high : ends of a range, both included: whole numbers between whole ends, else any number between
    choices : values one by one; the range is that of their places in the list then
    """

    field: str
    low: float
    high: float
    choices: tuple[Any, ...] = ()

    @property
    def whole(self) -> bool:
        """Whether the range is one of whole numbers."""
        return isinstance(self.low, int) and isinstance(self.high, int)

    @property
    def by_logarithm(self) -> bool:
        """Whether small values deserve as much room as large ones."""
        return not self.whole and self.low > 0 and self.high / self.low >= _DECADE

    @property
    def ends(self) -> tuple[Any, ...]:
        """Values that must all be able to run, where all else is at its start."""
        return self.choices or (self.low, self.high)

    def value(self, place: Any) -> Any:
        """The field's value at a place of the range; decimals have four digits, for a command to repeat them."""
        if self.choices:
            return self.choices[int(place)]
        return place if self.whole else min(max(float(f"{place:.4g}"), self.low), self.high)

    def spread(self, share: float) -> Any:
        """The value at a share, from 0 to below 1, of the way from the low end to the high one."""
        if self.whole:
            return self.value(min(int(self.low + share * (self.high - self.low + 1)), self.high))
        if self.by_logarithm:
            return self.value(self.low * (self.high / self.low) ** share)
        return self.value(self.low + share * (self.high - self.low))

    def share(self, value: Any) -> float:
        """How far a value is on the way from the low end, 0, to the high one, 1; 0.5 of one that is outside."""
        place = self.place(value)
        if place is None:
            return 0.5
        if self.by_logarithm:
            return math.log(place / self.low) / math.log(self.high / self.low)
        return float((place - self.low) / (self.high - self.low))

    def place(self, value: Any) -> Any | None:
        """The place of a value; None where the search cannot go."""
        if self.choices:
            return self.choices.index(value) if value in self.choices else None
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not self.low <= value <= self.high:
            return None
        return value if not self.whole or isinstance(value, int) else None


def parse_variable(text: str) -> Variable:
    """Read "strategy.delta=0.002:0.05" (a range), "neighbors=5,10,20" or "neighbors=5:40:5" (its values).

    Raises
    ------
    ScenarioError : it is neither, or an empty range
    """
    name, equals, values = text.partition("=")
    name = name.strip()
    if not equals or not name or not values.strip():
        raise ScenarioError(f"--vary {text}", "is not a variation", "write field=from:to or field=1,2,3")
    return variable_of(name if "." in name else name.replace("-", "_"), values, f"--vary {cut(text)}")


def variable_of(field: str, values: Any, where: str) -> Variable:
    """Return the variable of a field; text as of `parse_variable`, two numbers in a tuple are ends, others choices.

    Raises
    ------
    ScenarioError : an empty range, one value only, or no values at all
    """
    if isinstance(values, tuple) and len(values) == 2 and all(type(each) in (int, float) for each in values):
        return _range(field, values[0], values[1], where)
    if isinstance(values, str):
        low, _, high = (parse_value(part.strip()) for part in values.partition(":"))
        if type(low) in (int, float) and type(high) in (int, float):
            return _range(field, low, high, where)
        values = parse_values(values, where)
    if not isinstance(values, Iterable) or isinstance(values, Mapping):
        raise ScenarioError(where, "is neither a range nor a list of values", "write field=from:to or field=1,2,3")
    listed = list(values)
    choices = tuple(each for at, each in enumerate(listed) if each not in listed[:at])
    if len(choices) < 2:
        raise ScenarioError(where, "leaves nothing to choose", "give two values or more, or set it with --set")
    return Variable(field, 0, len(choices) - 1, choices)


def check_variables(variables: Sequence[Variable]) -> None:
    """Refuse a search of nothing.

    Raises
    ------
    ScenarioError : there is no variable
    """
    if not variables:
        raise ScenarioError("--vary", "is missing", "say what may change: --vary neighbors=5:40")


def _range(field: str, low: float, high: float, where: str) -> Variable:
    if not all(math.isfinite(end) and abs(end) <= _FARTHEST for end in (low, high)):
        raise ScenarioError(where, "the range has no end", "write numbers, such as 5:40")
    if not low < high:
        problem = "the range is empty" if low > high else "the range holds one value only"
        raise ScenarioError(where, problem, "write from:to with from < to")
    if type(low) is type(high) is int:
        return Variable(field, low, high)
    return Variable(field, float(low), float(high))
