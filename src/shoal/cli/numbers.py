"""Options that are numbers, in plain digits: 1.5 steps are refused, not rounded; 1_0, nan and inf are not numbers."""

import re
from collections.abc import Sequence
from typing import Annotated, Any

from cyclopts import Parameter

from shoal.core.text import quoted

_LONGEST = 20  # digits


def _integer(hint: Any, tokens: Sequence[Any]) -> int:
    text = tokens[0].value
    if not re.fullmatch(rf"[-+]?[0-9]{{1,{_LONGEST}}}", text):
        raise ValueError(f"{quoted(text)} is not a whole number")
    return int(text)


def _number(hint: Any, tokens: Sequence[Any]) -> float:
    text = tokens[0].value
    if not re.fullmatch(rf"[-+]?([0-9]{{1,{_LONGEST}}}\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]{{1,2}})?", text):
        raise ValueError(f"{quoted(text)} is not a number")
    return float(text)


def _steps(hint: Any, tokens: Sequence[Any]) -> int | str:
    text: str = tokens[0].value
    return text if re.fullmatch(r"[0-9.eE+-]+ *(s|min|h|d)", text) else _integer(hint, tokens)


Integer = Annotated[int, Parameter(converter=_integer)]
MaybeInteger = Annotated[int | None, Parameter(converter=_integer)]
Number = Annotated[float, Parameter(converter=_number)]
MaybeNumber = Annotated[float | None, Parameter(converter=_number)]
MaybeSteps = Annotated[int | str | None, Parameter(converter=_steps)]  # or a duration, such as "2 h"
