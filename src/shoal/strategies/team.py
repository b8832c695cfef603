"""A team: agents with ids below a number follow one strategy, the others another; scouts and trackers in one swarm.

Teams nest, so a swarm may have several strategies. Each agent decides, listens and begins as its own strategy
says; all remember in records that have the fields of every strategy.
"""

import math
from typing import Any, NamedTuple

from shoal.strategies import asking, contract
from shoal.strategies.contract import strategy

MOST = 8  # strategies in one swarm


def _level() -> Any:
    """A class of teams with functions of its own: a team in a team of one class would be recursion to numba."""

    class Team(NamedTuple):
        """Parameters of the first agents' strategy, of the rest's (or a deeper Team), and where the rest begins."""

        first: Any = None
        rest: Any = None
        until: int = 0

    def begin(me, memory, params, draw):
        """As the agent's own strategy begins."""
        if me.id < params.until:
            asking.begin(me, memory, params.first, draw)
        else:
            asking.begin(me, memory, params.rest, draw)

    def leads(other, params):
        """Whoever may lead agents of either strategy."""
        return asking.leads(other, params.first) or asking.leads(other, params.rest)

    def priority(me, other, params):
        """As the agent's own strategy ranks; those that it would not follow come last of all, at infinity."""
        if me.id < params.until:
            return asking.priority(me, other, params.first) if asking.leads(other, params.first) else math.inf
        return asking.priority(me, other, params.rest) if asking.leads(other, params.rest) else math.inf

    def influence(me, other, params):
        """As the agent's own strategy is influenced."""
        if me.id < params.until:
            return asking.counted(asking.influence(me, other, params.first), params)
        return asking.counted(asking.influence(me, other, params.rest), params)

    def decide(me, heard, memory, params, draw):
        """Each fleet by its own strategy."""
        if me.id < params.until:
            return asking.decide(me, heard, memory, params.first, draw)
        return asking.decide(me, heard, memory, params.rest, draw)

    strategy(contract.TEAM, params=Team, begin=begin, leads=leads, priority=priority, influence=influence)(decide)
    return Team


TEAMS = [_level() for _ in range(MOST - 1)]  # by how deep: the first holds two strategies, the next a team and one
for _depth, _team in enumerate(TEAMS, 2):
    _team.__qualname__ = _team.__name__ = f"Team{_depth}"
    globals()[_team.__name__] = _team  # where a cache of compiled code finds it again


def depth_of(params: Any) -> int:
    """How many strategies are nested in these parameters."""
    return TEAMS.index(type(params)) + 2 if type(params) in TEAMS else 1


def team(first: Any, rest: Any, until: int) -> Any:
    """Parameters of a team: agents below `until` follow the first."""
    return TEAMS[depth_of(rest) - 1](first, rest, until)
