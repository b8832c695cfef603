"""The disturbances of a scenario, one model per kind, made of what the kinds' files say."""

from typing import TYPE_CHECKING, Annotated, Any, Self, Union

from pydantic import Field, model_validator

from shoal.core.units import Seconds
from shoal.scenario.declared import models_of
from shoal.scenario.frozen import Frozen, NotNegative, Positive
from shoal.world.disturbances.catalogue import KINDS
from shoal.world.disturbances.catalogue import PROBLEMS as PROBLEMS


class AnyDisturbance(Frozen):
    """What all disturbances have in common: whom they are about, and when."""

    kind: str
    fleet: str | None = Field(default=None, description="on which fleet it acts; default: on all, and on targets")
    since: Annotated[Seconds, NotNegative] = Field(default=0.0, description="when it begins [s]")
    until: Annotated[Seconds, Positive] | None = Field(default=None, description="when it ends [s]; default: never")

    @model_validator(mode="after")
    def _begins_and_ends(self) -> Self:
        if self.until is not None and self.until <= self.since:
            raise ValueError(f"until is {self.until:g} s, not after since, {self.since:g} s; let it end later")
        return self


_FIRST = ("current", "blackout")  # as pages and errors list them
DISTURBANCES = models_of(
    KINDS, lambda kind: AnyDisturbance, PROBLEMS, suffix="Disturbance", module=__name__, first=_FIRST
)
globals().update({model.__name__: model for model in DISTURBANCES.values()})  # where pickle looks for them

if TYPE_CHECKING:

    class Disturbance(AnyDisturbance):
        """One of them; what kinds add is known at run time."""

        def __getattr__(self, name: str) -> Any: ...
else:
    Disturbance = Annotated[Union[tuple(DISTURBANCES.values())], Field(discriminator="kind")]  # noqa: UP007
