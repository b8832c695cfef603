"""A battery, and what draws from it: the hotel load, and propulsion by a coefficient of drag or by a curve."""

from itertools import pairwise
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from shoal.core.units import Joules, MetersPerSecond, Watts
from shoal.scenario.frozen import Frozen, NotNegative, Positive

_WATER = 1025.0  # [kg/m^3]
_BLUFF, _EFFICIENCY = 1.0, 0.3  # drag coefficient of a blunt body; of a small propeller with its motor

Speed = Annotated[MetersPerSecond, NotNegative]
Power = Annotated[Watts, NotNegative]


class Battery(Frozen):
    """What an agent has on board, and what it draws at a speed through the water. Empty, it is lost."""

    capacity: Annotated[Joules, Positive] = Field(description="what it holds when full [J]")
    hotel: Power = Field(default=0.0, description="what computer, radio and sensors draw all the time [W]")
    drag: Annotated[float, Field(strict=True, ge=0, le=1e12)] | None = Field(
        default=None, description="propulsion draws drag x speed^3 [W/(m/s)^3]; default: assumed, from mass"
    )
    curve: Annotated[tuple[tuple[Speed, Power], ...], Field(min_length=2, max_length=100)] | None = Field(
        default=None, description="instead: points of speed [m/s] and power of propulsion [W], straight lines between"
    )

    @model_validator(mode="after")
    def _one_way_to_say_it(self) -> Self:
        if self.curve is None:
            return self
        if self.drag is not None:
            raise ValueError("curve is given and drag, too; leave one of them out")
        speeds = [speed for speed, _ in self.curve]
        if speeds[0] != 0.0:
            raise ValueError(f"curve is not known below {speeds[0]:g} m/s; let it begin at a speed of 0")
        for lower, upper in pairwise(speeds):
            if upper <= lower:
                raise ValueError(f"curve is not in order: {upper:g} m/s after {lower:g} m/s; let its speeds rise")
        return self


def assumed_drag(mass: float) -> float:
    """Coefficient of drag over efficiency [W/(m/s)^3] of a blunt body that displaces its mass [kg].

    P = rho Cd A v^3 / (2 eta), A = (mass / rho)^(2/3), with Cd = 1 and eta = 0.3, which are assumed: an order of
    magnitude, for agents of which nothing better is known.
    """
    area = (mass / _WATER) ** (2 / 3)
    return float(_WATER * _BLUFF * area / (2 * _EFFICIENCY))


def drag_of(fleet: Any) -> float:
    """Drag of a fleet's agents [W/(m/s)^3]: as given, 0 where a curve says it, or assumed from their mass."""
    battery = fleet.battery
    if battery is None or battery.curve is not None:
        return 0.0
    return float(assumed_drag(fleet.mass) if battery.drag is None else battery.drag)


def check_battery(fleet: Any) -> None:
    """Check that a fleet's battery goes with its make.

    Raises
    ------
    ValueError : nothing says what propulsion draws, or not up to the top speed
    """
    battery = fleet.battery
    if battery is None:
        return
    if battery.curve is None and battery.drag is None and fleet.mass is None:
        raise ValueError("battery is without drag, curve and mass to assume one from; give battery.drag or mass")
    if battery.curve is not None and battery.curve[-1][0] < fleet.max_speed:
        raise ValueError(
            f"battery.curve is known up to {battery.curve[-1][0]:g} m/s, but max_speed is {fleet.max_speed:g}; "
            "add the power at the top speed"
        )
