"""Informed reference: greedy pursuit of the known target. Breaks the information rule: agents are told where it is.

Classical (pure) pursuit: Isaacs, "Differential Games", Wiley 1965. What knowing the target is worth to a pursuer.
"""

from typing import NamedTuple

from shoal.strategies.contract import strategy
from shoal.strategies.parts import toward


class Pursuit(NamedTuple):
    """No parameters."""


def decide(me, heard, memory, params, draw):
    """KNOWS THE TARGET: everybody runs straight to it."""
    if me.truth.present:
        return toward(me, me.truth.x, me.truth.y)
    return 0.0, 0.0


strategy("pursuit", params=Pursuit, informed=True, reference="Isaacs, Differential Games, 1965 (pure pursuit)")(decide)
