"""A team: agents with ids below a number follow one strategy, the others another; scouts and trackers in one swarm.

Teams nest, so a swarm may have as many strategies as fleets. Each agent decides, listens and begins as its own strategy
says; all remember in records that have the fields of every strategy.
"""

from typing import Any, NamedTuple

import numpy as np

from shoal.strategies import contract
from shoal.strategies.contract import strategy


class Team(NamedTuple):
    """Parameters of the first agents' strategy, of the rest's (or another Team), and where the rest begins."""

    first: Any = None
    rest: Any = None
    until: int = 0


def begin(me, memory, params, draw):
    """As the agent's own strategy begins."""
    if me.id < params.until:
        contract.begin(me, memory, params.first, draw)
    else:
        contract.begin(me, memory, params.rest, draw)


def leads(other, params):
    """Whoever may lead agents of either strategy."""
    return contract.leads(other, params.first) or contract.leads(other, params.rest)


def priority(me, other, params):
    """As the agent's own strategy ranks; those that it would not follow come last of all, at infinity."""
    if me.id < params.until:
        return contract.priority(me, other, params.first) if contract.leads(other, params.first) else np.inf
    return contract.priority(me, other, params.rest) if contract.leads(other, params.rest) else np.inf


def influence(me, other, params):
    """As the agent's own strategy is influenced."""
    if me.id < params.until:
        return contract.influence(me, other, params.first)
    return contract.influence(me, other, params.rest)


def decide(me, heard, memory, params, draw):
    """Each fleet by its own strategy."""
    if me.id < params.until:
        return contract.decide(me, heard, memory, params.first, draw)
    return contract.decide(me, heard, memory, params.rest, draw)


strategy(contract.TEAM, params=Team, begin=begin, leads=leads, priority=priority, influence=influence)(decide)
