"""Adrift: wants no velocity, so that water and wind alone move it, as they move a drifter."""

from typing import NamedTuple

from shoal.strategies.contract import strategy


class Adrift(NamedTuple):
    """No parameters."""


def decide(me, heard, memory, params, draw):
    """Adrift: only water and wind move it."""
    return 0.0, 0.0


strategy("adrift", params=Adrift, reference="passive drifters")(decide)
