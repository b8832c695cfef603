"""A target that stays: moored or aground. No current moves it."""

from dataclasses import dataclass
from typing import Annotated

from shoal.compiler.kernel import kernel
from shoal.core.units import Doc, Meters
from shoal.world.targets.contract import Target


@dataclass(frozen=True, kw_only=True)
class Still:
    """A target that stays where it is."""

    x: Annotated[Meters, Doc("east of the center [m]")] = 0.0
    y: Annotated[Meters, Doc("north of the center [m]")] = 0.0


@kernel
def stay(target, around, draw):
    """Stay."""


TARGET = Target(name="still", options=Still, begin=stay, advance=stay, moves=False)
