"""Units at the door: "5 kn" or "2 nmi" become SI numbers, and every field says its unit."""

import math
import re
from dataclasses import dataclass
from typing import Annotated, Any

_TO_SI: dict[str, dict[str, float]] = {
    "m": {"m": 1.0, "km": 1000.0, "nmi": 1852.0, "NM": 1852.0, "ft": 0.3048},
    "m/s": {"m/s": 1.0, "kn": 1852.0 / 3600.0, "kt": 1852.0 / 3600.0, "km/h": 1.0 / 3.6},
    "s": {"s": 1.0, "min": 60.0, "h": 3600.0, "d": 86400.0},
    "kg": {"kg": 1.0, "t": 1000.0},
    "deg": {"deg": 1.0, "rad": 57.29577951308232},
}

_LEAST, _MOST = 1e-30, 1e12  # in SI: what kernels multiply and divide stays finite

_QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-z/]+)\s*")


@dataclass(frozen=True)
class Unit:
    """Marks a number with its SI unit; pydantic then also takes a string with any known unit of that kind."""

    symbol: str

    def parse(self, value: Any) -> Any:
        """Return `value` in the unit's SI scale.

        Numbers pass through unchanged, but for those so small that their squares would vanish; "5 kn" is converted.

        Raises
        ------
        ValueError : a string that is no quantity, one in a unit of another kind, or a quantity too large to square
        """
        if isinstance(value, bool):
            raise ValueError(f"{value} is no quantity in {self.symbol}; write a number")
        known = _TO_SI[self.symbol]
        number = value
        if isinstance(value, str):
            match = _QUANTITY.fullmatch(value)
            if match is None or match.group(2) not in known:
                raise ValueError(
                    f"{value!r} is no quantity in {self.symbol}; write a number or one of: {', '.join(known)}"
                )
            number = float(match.group(1)) * known[match.group(2)]
        size = abs(number) if isinstance(number, (int, float)) else 0
        if _MOST < size < math.inf:
            raise ValueError(f"{value} is beyond all quantities at sea; write {_MOST:g} {self.symbol} at most")
        return 0.0 if 0 < size < _LEAST else number

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        from pydantic_core import core_schema

        return core_schema.no_info_before_validator_function(self.parse, handler(source))

    def __get_pydantic_json_schema__(self, schema: Any, handler: Any) -> dict[str, Any]:
        number = dict(handler(schema))
        text = {"type": "string", "pattern": r"^\s*[-+0-9.eE]+\s*(" + "|".join(_TO_SI[self.symbol]) + r")\s*$"}
        return {"anyOf": [number, text], "unit": self.symbol}


@dataclass(frozen=True)
class Choice:
    """Marks an int parameter of a strategy that a scenario spells as one of these words (0 is the first)."""

    words: tuple[str, ...]


@dataclass(frozen=True)
class Says:
    """One sentence about a parameter."""

    sentence: str


Meters = Annotated[float, Unit("m")]
MetersPerSecond = Annotated[float, Unit("m/s")]
Seconds = Annotated[float, Unit("s")]
Kilograms = Annotated[float, Unit("kg")]
Degrees = Annotated[float, Unit("deg")]
