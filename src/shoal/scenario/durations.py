"""How long a run is: a number of steps, or a duration such as "2 h"."""

import math
import re
from typing import Annotated, Any

from pydantic import WithJsonSchema

from shoal.core.text import quoted
from shoal.core.units import Unit
from shoal.scenario.frozen import Count

_SECONDS = Unit("s")

Steps = Annotated[
    Count,
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "integer", "exclusiveMinimum": 0, "maximum": 10**12},
                {"type": "string", "pattern": r"^[-+0-9.eE]+[ \t]*(s|min|h|d)$"},
            ]
        }
    ),
]


def steps_of(duration: str, time_step: Any) -> int:
    """Return the steps that a duration takes, the last one whole.

    Raises
    ------
    ValueError : one of them is not a time
    """
    step = _SECONDS.parse(time_step)
    steps = _SECONDS.parse(duration) / step if isinstance(step, (int, float)) and step > 0 else math.nan
    if not math.isfinite(steps):
        raise ValueError(f"{quoted(duration)}, which needs a time_step above 0; correct that first")
    return math.ceil(steps - 1e-6)


def with_whole_steps(table: Any) -> Any:
    """Return a scenario's table with its steps as a number, if they were written as a duration."""
    steps = table.get("steps") if isinstance(table, dict) else None
    if not isinstance(steps, str) or not re.match(r"[-+.0-9]+[ \t]*[a-z]", steps):
        return table
    try:
        return {**table, "steps": steps_of(steps, table.get("time_step"))}
    except ValueError as error:
        raise ValueError(f"steps is {error}") from None
