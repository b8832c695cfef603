"""Who is lost and who joins, and when."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from shoal.scenario.frozen import Count, Frozen

MOST_AGENTS = 1_000_000


class Loss(Frozen):
    """Agents that are lost at a step, chosen at random or named."""

    step: Count = Field(description="they are absent from this step on")
    count: Count | None = Field(default=None, description="number of agents, chosen at random; or")
    agents: tuple[Annotated[int, Field(strict=True, ge=0)], ...] = Field(
        default=(), max_length=MOST_AGENTS, description="which agents, by their numbers from 0 in the order of fleets"
    )
    fleet: str | None = Field(default=None, description="of which fleet; default: of any")

    @property
    def size(self) -> int:
        """Number of agents."""
        return len(self.agents) or self.count or 0

    @model_validator(mode="after")
    def _who(self) -> Self:
        if (self.count is None) == (not self.agents):
            raise ValueError("a loss has a count, or agents that it names; say one of them")
        if self.agents and self.fleet is not None:
            raise ValueError("a loss that names its agents has no fleet; leave out fleet, or say count")
        if len(set(self.agents)) < len(self.agents):
            raise ValueError("agents names one twice; leave out one of them")
        return self


class Join(Frozen):
    """Agents that join at a step."""

    step: Count = Field(description="they are there from this step on")
    count: Count = Field(description="number of agents")
    fleet: str = Field(description="of which fleet they are")

    @property
    def size(self) -> int:
        """Number of agents."""
        return self.count
