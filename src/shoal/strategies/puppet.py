"""Puppet: wants what somebody else wrote into its memory: how real buoys move the bodies of a stand-in sea."""

from typing import NamedTuple

from shoal.strategies import contract
from shoal.strategies.contract import strategy


class Puppet(NamedTuple):
    """No parameters."""


def decide(me, heard, memory, params, draw):
    """The velocity that a buoy wants."""
    return memory.want_x, memory.want_y


strategy(contract.PUPPET, params=Puppet, memory={"want_x": "m/s", "want_y": "m/s"})(decide)
PUPPET = contract.owner_of(Puppet)
