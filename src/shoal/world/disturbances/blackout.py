"""A blackout: agents hear nobody while it lasts. They still speak, and others may hear them."""

from dataclasses import dataclass

from shoal.compiler.kernel import kernel
from shoal.world.disturbances.contract import Disturbance


@dataclass(frozen=True, kw_only=True)
class Blackout:
    """Agents hear nobody: a jammed or broken receiver."""


@kernel
def advance(me, memory, options, around, draw):
    """Hear nothing."""
    me.hears = 0.0


DISTURBANCE = Disturbance(name="blackout", options=Blackout, advance=advance)
