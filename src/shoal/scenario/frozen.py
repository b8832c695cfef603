"""What every part of a scenario has in common."""

from collections.abc import Mapping
from os import PathLike
from typing import Annotated, Any, Self

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from shoal.core.errors import ScenarioError, did_you_mean


class Frozen(BaseModel):
    """Base of every part of a scenario: cannot change, knows no extra fields, and neither do its copies."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """Return a copy with some fields changed, validated like any other.

        Raises
        ------
        ScenarioError : unknown or wrong fields
        """
        if not update:
            return super().model_copy(deep=deep)
        return self._validated({**vars(self), **update})

    def _validated(self, table: dict[str, Any]) -> Self:
        part = type(self).__name__
        try:
            return self.model_validate(plain(table))
        except ValidationError as error:
            first = error.errors()[0]
            fields = list(type(self).model_fields)
            path = f"{part}.{first['loc'][0]}" if first["loc"] else part
            if first["type"] == "extra_forbidden":
                hint = did_you_mean(str(first["loc"][-1]), fields) or f"fields here: {', '.join(fields)}"
                raise ScenarioError(path, f"unknown field (value {first['input']!r})", hint.rstrip()) from None
            raise ScenarioError(path, f"{first['input']!r}: {first['msg'].lower()}", "change the value") from None


Positive = Field(gt=0)
NotNegative = Field(ge=0)
Count = Annotated[int, Field(strict=True, gt=0, le=10**12)]  # strict: neither true nor "15" is a number
Chance = Annotated[float, Field(strict=True, ge=0, le=1)]


def plain(value: Any) -> Any:
    """Return a value as a scenario's file could say it: parts as tables, NumPy's numbers and arrays as Python's.

    Of a part, everything that is in it, also what was never validated. Strategies that are loaded stay so.
    """
    if isinstance(value, BaseModel):
        return plain(vars(value))
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    return str(value) if isinstance(value, PathLike) else value
