"""What every part of a scenario has in common."""

from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from shoal.core.text import checked_name
from shoal.core.units import Share


class Frozen(BaseModel):
    """Base of every part of a scenario: cannot change, knows no extra fields."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


Positive = Field(gt=0)
NotNegative = Field(ge=0)
Count = Annotated[int, Field(strict=True, gt=0, le=10**12)]  # strict: neither true nor "15" is a number
Chance = Annotated[Share, Field(strict=True, ge=0, le=1)]
Name = Annotated[str, Field(min_length=1), AfterValidator(checked_name)]
MOST_ENTRIES = 1000  # of a list of a scenario
