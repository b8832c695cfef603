"""What every part of a scenario has in common."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field


class Frozen(BaseModel):
    """Base of every part of a scenario: cannot change, knows no extra fields."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


Positive = Field(gt=0)
NotNegative = Field(ge=0)
Count = Annotated[int, Field(strict=True, gt=0, le=10**12)]  # strict: neither true nor "15" is a number
Chance = Annotated[float, Field(strict=True, ge=0, le=1)]
