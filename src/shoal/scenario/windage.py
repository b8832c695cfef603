"""How the wind moves what floats: a share of its speed, or a leeway class of search and rescue.

Leeway speed = slope x wind speed + offset, at an angle to the left or the right of downwind, by chance: Allen and
Plourde, "Review of leeway: field experiments and implementation", US Coast Guard R&D Center, CG-D-08-99, 1999, table
8-1, as the IAMSAR manual and the Coast Guard's addendum to it use it. Offsets there are in knots.
"""

import math
from typing import Annotated, Any, NamedTuple

from pydantic import AfterValidator, BeforeValidator, Field

from shoal.core.errors import did_you_mean
from shoal.core.text import quoted
from shoal.core.units import Unit

_KNOT = 1852.0 / 3600.0  # [m/s]
_SHARE = Unit("1")


class LeewayClass(NamedTuple):
    """Slope [-], offset [m/s], angle between downwind and where it drifts [deg]."""

    slope: float
    offset: float
    divergence: float


CLASSES: dict[str, LeewayClass] = {
    "person-in-water": LeewayClass(0.011, 0.07 * _KNOT, 30.0),
    "person-in-survival-suit": LeewayClass(0.014, 0.10 * _KNOT, 30.0),
    "liferaft": LeewayClass(0.037, 0.11 * _KNOT, 24.0),
    "liferaft-with-drogue": LeewayClass(0.030, 0.0, 28.0),
    "kayak": LeewayClass(0.011, 0.24 * _KNOT, 15.0),
    "skiff": LeewayClass(0.034, 0.04 * _KNOT, 22.0),
    "sport-boat": LeewayClass(0.069, -0.08 * _KNOT, 19.0),
}


def _known(name: str) -> str:
    if name not in CLASSES:
        hint = did_you_mean(name, CLASSES)
        raise ValueError(f"{quoted(name)} is no leeway class; {hint}there are: {', '.join(CLASSES)}")
    return name


def _share_or_name(value: Any) -> Any:
    """A text that begins like a number is a quantity."""
    return _SHARE.parse(value) if isinstance(value, str) and value[:1] in "+-.0123456789" else value


Windage = Annotated[
    Annotated[float, Field(strict=True, ge=0.0, le=1.0)] | Annotated[str, AfterValidator(_known)],
    BeforeValidator(_share_or_name),
]


def leeway(windage: float | str | None) -> tuple[float, float, float, float]:
    """Return slope [-], offset [m/s], cosine and sine of the divergence: fields of world/sea/sea.py's Leeway."""
    if not isinstance(windage, str):
        return windage or 0.0, 0.0, 1.0, 0.0
    chosen = CLASSES[windage]
    angle = math.radians(chosen.divergence)
    return chosen.slope, chosen.offset, math.cos(angle), math.sin(angle)
