"""What every part of a scenario has in common."""

from collections.abc import Mapping
from os import PathLike
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np
from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError

from shoal.core.errors import ScenarioError, did_you_mean, no_attribute
from shoal.core.text import checked_name, quoted
from shoal.core.units import Share


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

    if not TYPE_CHECKING:  # hidden from type checkers, which know the names

        def __setattr__(self, name: str, value: Any) -> None:
            part = type(self).__name__
            fix = 'make another one, such as scenario.with_(neighbors=10, **{"network.loss": 0.1})'
            raise ScenarioError(f"{part}.{name}", "does not change", fix)

        def __getattr__(self, name: str) -> Any:
            try:
                return super().__getattr__(name)
            except AttributeError:
                if name.startswith("_"):
                    raise
                raise no_attribute(f"a {type(self).__name__}", name, _attributes(self)) from None

    def _validated(self, table: dict[str, Any]) -> Self:
        part = type(self).__name__
        try:
            return self.model_validate(plain(table))
        except ValidationError as error:
            first = error.errors()[0]
            fields = list(type(self).model_fields)
            path = f"{part}.{first['loc'][0]}" if first["loc"] else part
            if first["type"] == "extra_forbidden":
                hint = did_you_mean(str(first["loc"][-1]), fields) or f"its fields: {', '.join(fields)}"
                raise ScenarioError(path, f"unknown field (value {quoted(first['input'])})", hint.rstrip()) from None
            raise ScenarioError(path, f"{quoted(first['input'])}: {first['msg'].lower()}", "change the value") from None


def _attributes(part: Frozen) -> dict[str, None]:
    """Fields and methods of a part, and fields of the parts in it, as paths."""
    methods = [each for each in vars(type(part)) if not each.startswith(("_", "model_"))]
    inside = [
        f"{name}.{field}"
        for name, value in vars(part).items()
        if isinstance(value, Frozen)
        for field in type(value).model_fields
    ]
    return dict.fromkeys([*type(part).model_fields, *methods, *inside])


Positive = Field(gt=0)
NotNegative = Field(ge=0)
Count = Annotated[int, Field(strict=True, gt=0, le=10**12)]  # strict: neither true nor "15" is a number
Chance = Annotated[Share, Field(strict=True, ge=0, le=1)]
Name = Annotated[str, Field(min_length=1), AfterValidator(checked_name)]
MOST_ENTRIES = 1000  # of a list of a scenario


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
