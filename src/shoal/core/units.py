"""Units at the door: "5 kn" or "2 nmi" become SI numbers, and every field says its unit."""

import math
import re
from dataclasses import dataclass
from typing import Annotated, Any, get_type_hints

from shoal.core.text import quoted

_KNOT = 1852.0 / 3600.0  # [m/s]

_TO_SI: dict[str, dict[str, float]] = {
    "m": {"m": 1.0, "km": 1000.0, "nmi": 1852.0, "NM": 1852.0, "ft": 0.3048},
    "m/s": {"m/s": 1.0, "kn": _KNOT, "kt": _KNOT, "km/h": 1.0 / 3.6, "knot": _KNOT, "knots": _KNOT},
    "m/s^2": {"m/s^2": 1.0, "m/s2": 1.0, "m/s/s": 1.0, "kn/s": _KNOT, "km/h/s": 1.0 / 3.6},
    "s": {"s": 1.0, "min": 60.0, "h": 3600.0, "d": 86400.0},
    "kg": {"kg": 1.0, "t": 1000.0},
    "J": {"J": 1.0, "kJ": 1e3, "MJ": 1e6, "Wh": 3600.0, "kWh": 3.6e6},
    "W": {"W": 1.0, "mW": 1e-3, "kW": 1e3},
    "deg": {"deg": 1.0, "rad": 57.29577951308232},
    "deg/s": {"deg/s": 1.0, "rad/s": 57.29577951308232, "deg/min": 1.0 / 60.0},
    "1": {"%": 0.01},
}

_LEAST, _MOST = 1e-30, 1e12  # in SI: what kernels multiply and divide stays finite

_QUANTITY = re.compile(r"([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)[ \t]*([A-Za-z/%][A-Za-z/^2]*)")


@dataclass(frozen=True)
class Unit:
    """Marks a number with its SI unit; pydantic then also takes a string with any known unit of that kind."""

    symbol: str

    def parse(self, value: Any) -> Any:
        """Return `value` in the unit's SI scale.

        Numbers pass through unchanged, except those so small that their squares would vanish; "5 kn" is converted.

        Raises
        ------
        ValueError : a string that is not a quantity, a unit of another kind, or a quantity too large to square
        """
        if isinstance(value, bool):
            raise ValueError(f"{value} is not a {self._kind}; write a number")
        known = _TO_SI[self.symbol]
        number = value
        if isinstance(value, str):
            match = _QUANTITY.fullmatch(value)
            if match is None or match.group(2) not in known:
                raise ValueError(
                    f"{quoted(value)} is not a {self._kind}; write a number, or one with a unit: {', '.join(known)}"
                )
            number = float(match.group(1)) * known[match.group(2)]
        size = abs(number) if isinstance(number, (int, float)) else 0
        if _MOST < size < math.inf:
            most = f"{_MOST:g} {self.symbol}".removesuffix(" 1")
            raise ValueError(f"{quoted(value)} is beyond all quantities at sea; write {most} at most")
        return 0.0 if 0 < size < _LEAST else number

    @property
    def _kind(self) -> str:
        return "share" if self.symbol == "1" else f"quantity in {self.symbol}"

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        from pydantic_core import core_schema

        return core_schema.no_info_before_validator_function(self.parse, handler(source))

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        number = dict(handler(schema))
        units = "|".join(map(re.escape, _TO_SI[self.symbol]))
        text = {"type": "string", "pattern": rf"^[-+0-9.eE]+[ \t]*({units})$"}
        return {"anyOf": [number, text], "unit": self.symbol}


@dataclass(frozen=True)
class Choice:
    """Marks an int option that a scenario spells as one of these words (0 is the first)."""

    words: tuple[str, ...]


@dataclass(frozen=True)
class Doc:
    """One sentence about an option."""

    sentence: str


@dataclass(frozen=True)
class Range:
    """Marks which values an option may have: `least` to `most`, or above `least` if it is `open`."""

    least: float = 0.0
    most: float = 1e12
    open: bool = False


LENGTHS = ("spacing", "reach", "step")


@dataclass(frozen=True, init=False)
class Follows:
    """Marks a length or a time whose default, said for the paper's scenario, follows a length of each scenario.

    lengths : "spacing" of the agents, "reach" of their sensors or "step", the way that the fastest goes in a time-step;
        of several the geometric mean. A time follows by how long the fastest takes for it. See scenario/scales.py
    """

    lengths: tuple[str, ...]

    def __init__(self, *lengths: str) -> None:
        for each in lengths or ("",):
            if each not in LENGTHS:
                raise ValueError(f"Follows({quoted(each)}): there are {', '.join(LENGTHS)}; name one or more")
        object.__setattr__(self, "lengths", lengths)

    def __str__(self) -> str:
        """The lengths, each once."""
        return " and ".join(dict.fromkeys(self.lengths))


def follows_in_vain(params: Any) -> str:
    """The first parameter of a NamedTuple class that follows a length, but is no float in m or s; else nothing."""
    for name, hint in get_type_hints(params, include_extras=True).items():
        marks = getattr(hint, "__metadata__", ())
        measured = Unit("m") in marks or Unit("s") in marks
        if any(isinstance(each, Follows) for each in marks) and not (
            measured and type(params._field_defaults[name]) is float
        ):
            return name
    return ""


@dataclass(frozen=True)
class FileName:
    """Marks a text that names a file, relative to the folder of the scenario that says it."""


Meters = Annotated[float, Unit("m")]
MetersPerSecond = Annotated[float, Unit("m/s")]
MetersPerSecondSquared = Annotated[float, Unit("m/s^2")]
Seconds = Annotated[float, Unit("s")]
Kilograms = Annotated[float, Unit("kg")]
Joules = Annotated[float, Unit("J")]
Watts = Annotated[float, Unit("W")]
Degrees = Annotated[float, Unit("deg")]
DegreesPerSecond = Annotated[float, Unit("deg/s")]
Share = Annotated[float, Unit("1")]
