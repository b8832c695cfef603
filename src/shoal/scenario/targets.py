"""The targets of a scenario, one model per kind, made of what the kinds' files say."""

from typing import TYPE_CHECKING, Annotated, Any, Self, Union, get_type_hints

from pydantic import Field, model_validator

from shoal.core.units import Meters, MetersPerSecond, Seconds
from shoal.scenario.declared import models_of
from shoal.scenario.frozen import Frozen, NotNegative, Positive
from shoal.scenario.windage import Windage
from shoal.world.targets.catalogue import KINDS
from shoal.world.targets.catalogue import PROBLEMS as PROBLEMS


class FloatingTarget(Frozen):
    """What all targets have in common."""

    windage: Windage | None = Field(
        default=None, description="how the wind moves it: a share of its speed, or a leeway class; default: not at all"
    )


class FixedTarget(FloatingTarget):
    """What targets have in common that do not move by a rule."""

    kind: str
    radius: Annotated[Meters, NotNegative] = Field(description="rho: size of the target [m]")


class MovingTarget(FloatingTarget):
    """What all targets that move by a rule have in common."""

    radius: Annotated[Meters, NotNegative] = Field(description="rho: size of the target [m]")
    speed: Annotated[MetersPerSecond, NotNegative] = Field(description="constant speed [m/s]")
    margin: Annotated[Meters, NotNegative] = Field(
        default=0.0,
        description="it stays this far inside the edge [m]; of waypoint targets: waypoints and start",
    )
    surface_time: Annotated[Seconds, Positive] | None = Field(
        default=None, description="of a target that dives: how long it can be detected each time [s]"
    )
    dive_time: Annotated[Seconds, Positive] | None = Field(
        default=None, description="and how long it cannot, in turn [s]; default: it never dives"
    )

    @model_validator(mode="after")
    def _surfaces_and_dives(self) -> Self:
        if (self.surface_time is None) != (self.dive_time is None):
            raise ValueError("surface_time and dive_time belong together; give both or none")
        return self


def _base(kind: Any) -> type[Frozen]:
    if kind.moves:
        return MovingTarget
    return FloatingTarget if "radius" in get_type_hints(kind.options) else FixedTarget


_FIRST = (
    "still",
    "waypoint",
    "line",
    "walk",
    "levy",
    "evasive",
    "drift",
    "adrift",
    "track",
)  # as pages and errors list them
TARGETS = models_of(KINDS, _base, PROBLEMS, suffix="Target", module=__name__, first=_FIRST)
globals().update({model.__name__: model for model in TARGETS.values()})  # where pickle looks for them

if TYPE_CHECKING:

    class Target(Frozen):
        """One of them; what kinds add is known at run time."""

        kind: str
        radius: float

        def __getattr__(self, name: str) -> Any: ...
else:
    Target = Annotated[Union[tuple(TARGETS.values())], Field(discriminator="kind")]  # noqa: UP007
