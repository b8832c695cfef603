"""The network of a scenario: whom an agent hears, how far, how often, and what is lost."""

from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from shoal.core.errors import did_you_mean
from shoal.core.text import quoted
from shoal.core.units import Meters, Seconds
from shoal.scenario.frozen import Chance, Count, Frozen, Positive
from shoal.scenario.radios import RADIOS

Degree = Count | Literal["all"]


def _radio(name: str) -> str:
    if name not in RADIOS:
        raise ValueError(f"{quoted(name)} is no radio; {did_you_mean(name, RADIOS)}there are: {', '.join(RADIOS)}")
    return name


class AdaptiveDegree(Frozen):
    """k follows the contact: fewest + (most - fewest) x share of recent time with somebody on target in hearing."""

    fewest: Count = Field(default=10, description="k of an agent that never hears of a target")
    most: Count = Field(default=25, description="k of an agent that always does")
    patience: Annotated[Seconds, Positive] = Field(default=10.0, description="how long `recent` is [s]")

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.fewest > self.most:
            raise ValueError(f"fewest is {self.fewest}, more than most, {self.most}; swap them")
        return self


class Network(Frozen):
    """Which agents hear which, and what gets lost."""

    neighbors: Degree = Field(description='k: every agent hears its k nearest others, or "all"')
    range: Annotated[Meters, Positive] | None = Field(
        default=None, description="nobody is heard from farther away [m]; default: any distance"
    )
    loss: Chance = Field(default=0.0, description="chance that a neighbor's report of a step is not heard")
    delay: Annotated[int, Field(strict=True, ge=0, le=1000)] = Field(
        default=0, description="steps that a report takes; positions in it are as old"
    )
    interval: Annotated[Seconds, Positive] | None = Field(
        default=None, description="time from one report of an agent to its next [s]; default: every step"
    )
    radio: Annotated[str, AfterValidator(_radio)] | None = Field(
        default=None, description="a kind of radio, whose airtime and duty cycle are told; default: not told"
    )
    adaptive: AdaptiveDegree | None = Field(default=None, description="k adapts in time; neighbors is where it starts")
    max_age: Annotated[int, Field(strict=True, ge=0, le=1000)] = Field(
        default=0,
        description="steps that a report may be older than the newest that can have arrived, where that was not heard",
    )
    hops: Annotated[int, Field(strict=True, ge=1, le=100)] = Field(
        default=1, description="over how many hops a report comes: agents pass on, at once, what they hear"
    )

    @property
    def collects(self) -> bool:
        """Whether agents choose their k nearest among the reports that they have: relayed and kept ones, too."""
        return self.max_age > 0 or self.hops > 1
