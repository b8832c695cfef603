"""What agents are told on their way, at a step: to hold, to come back, to go on, or that a field is another now."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from shoal.scenario.frozen import Count, Frozen
from shoal.scenario.presence import MOST_AGENTS

Value = bool | int | float | str | None
AgentId = Annotated[int, Field(strict=True, ge=0)]


class Command(Frozen):
    """One order to some agents or all of them, or new values of fields."""

    step: Count = Field(description="they obey from this step on")
    order: Literal["hold", "recall", "resume"] | None = Field(
        default=None, description="want no velocity, go back to where they set out, or decide by their strategy again"
    )
    set: dict[str, Value] = Field(
        default={}, description='or fields and their new values, such as {"strategy.delta" = 0.02, neighbors = 10}'
    )
    agents: tuple[AgentId, ...] = Field(
        default=(), max_length=MOST_AGENTS, description="which agents, by their numbers; default: all"
    )

    @property
    def words(self) -> str:
        """What it says: hold, or set strategy.delta = 0.02."""
        return self.order or "set " + ", ".join(f"{path} = {value}" for path, value in self.set.items())

    def among(self, agents: int) -> list[int]:
        """Which of so many agents it is for."""
        return list(self.agents or range(agents))

    @model_validator(mode="after")
    def _what(self) -> Self:
        if (self.order is None) == (not self.set):
            raise ValueError("a command has an order, or fields to set; say one of them")
        if len(set(self.agents)) < len(self.agents):
            raise ValueError("agents names one twice; leave out one of them")
        return self
