"""The reports that arrive in a step, for whoever listens: one of each speaker for all, or one for each pair (kept.py).
Where there are many, listeners go by lists (listed.py).

Which it is decides the type of `memories`, as that of params decides the strategy (strategies/asking.py): numba then
compiles one of both, and nothing is asked while a run goes.
"""

from typing import Any

from shoal.compiler.kernel import can_compile, kernel, overload
from shoal.core.agents import (
    KeptMemories,
    ListedMemories,
    Memories,
    SingleListedMemories,
    SingleMemories,
    TurnMemories,
)
from shoal.engine.kept import Kept, choose_kept_leaders, row_of, sum_kept_influence
from shoal.engine.listed import (
    Listed,
    SingleListed,
    choose_listed_leaders,
    sum_listed_by_lanes,
    sum_listed_influence,
    sum_single_listed_by_lanes,
)
from shoal.engine.listen import (
    Arrived,
    InTurn,
    Single,
    choose_leaders,
    choose_single_leaders,
    sum_by_lanes,
    sum_influence,
    sum_single_by_lanes,
    sum_single_influence,
)
from shoal.world.radio import row, said, spoken


def arriving(memories: Any, radio: Any, swarm: Any, number: Any, time_step: Any) -> Any:
    """What arrives at step `number`."""
    chosen = _ARRIVING[type(memories)]
    return chosen(memories, radio, swarm, number, time_step)


@kernel
def _arrived(memories, radio, swarm, number, time_step):
    then = spoken(radio, number)
    told = memories.told if then == number else memories.arrived[row(radio, then)]
    return Arrived(said(radio, swarm, number), told, then * time_step)


def _arrived_as(kind):
    """The same as another class, by which numba compiles another way to listen."""

    @kernel
    def arrived_so(memories, radio, swarm, number, time_step):
        arrived = _arrived(memories, radio, swarm, number, time_step)
        return kind(arrived.said, arrived.told, arrived.at)

    return arrived_so


@kernel
def _kept(memories, radio, swarm, number, time_step):
    return Kept(radio, memories.arrived, spoken(radio, number), time_step)


_ARRIVING: dict[Any, Any] = {
    Memories: _arrived,
    TurnMemories: _arrived_as(InTurn),
    SingleMemories: _arrived_as(Single),
    KeptMemories: _kept,
    ListedMemories: _arrived_as(Listed),
    SingleListedMemories: _arrived_as(SingleListed),
}
_SUMMING: dict[Any, Any] = {
    Arrived: sum_influence,
    InTurn: sum_influence,
    Single: sum_single_influence,
    Kept: sum_kept_influence,
    Listed: sum_listed_influence,
    SingleListed: sum_listed_influence,
}
_BY_LANES: dict[Any, Any] = {
    Arrived: sum_by_lanes,
    Single: sum_single_by_lanes,
    Listed: sum_listed_by_lanes,
    SingleListed: sum_single_listed_by_lanes,
}  # where influence has no branches
_CHOOSING: dict[Any, Any] = {
    Arrived: choose_leaders,
    InTurn: choose_leaders,
    Single: choose_single_leaders,
    Kept: choose_kept_leaders,
    Listed: choose_listed_leaders,
    SingleListed: choose_listed_leaders,
}


def sum_up(arrived: Any, listeners: Any, links: Any, params: Any, agents: Any, sums: Any) -> None:
    """Add up what the neighbors of each listener exert on it, (S, L), and count them in links.heard."""
    chosen = _SUMMING[type(arrived)]
    chosen(arrived, listeners, links, params, agents, sums)


def choose(arrived: Any, listeners: Any, links: Any, params: Any, agents: Any, leader: Any, lowest: Any) -> None:
    """Set leader[i] to the index of the neighbor that listener i follows, -1 if none; lowest[i] is its priority."""
    chosen = _CHOOSING[type(arrived)]
    chosen(arrived, listeners, links, params, agents, leader, lowest)


def said_by(arrived: Any, j: Any, i: Any) -> Any:
    """x, y, vx, vy and on target, as listener i has them of j."""
    return (_kept_by if isinstance(arrived, Kept) else _arrived_by)(arrived, j, i)


@kernel
def _arrived_by(arrived, j, i):
    reports = arrived.said
    return reports.x[j], reports.y[j], reports.vx[j], reports.vy[j], reports.on_target[j]


@kernel
def _kept_by(arrived, j, i):
    at, air = row_of(arrived, j, i), arrived.radio
    return air.x[at, j], air.y[at, j], air.vx[at, j], air.vy[at, j], air.on_target[at, j]


def told_by(arrived: Any, j: Any, i: Any) -> Any:
    """What listener i was told of the memory of j."""
    return arrived.told[row_of(arrived, j, i), j] if isinstance(arrived, Kept) else arrived.told[j]


@overload(arriving, inline="always")
def _arriving(memories, radio, swarm, number, time_step):
    chosen = _ARRIVING[memories.instance_class]
    return lambda memories, radio, swarm, number, time_step: chosen(memories, radio, swarm, number, time_step)


@overload(sum_up, inline="always")
def _sum_up(arrived, listeners, links, params, agents, sums):
    chosen = _SUMMING[arrived.instance_class]
    by_lanes = _BY_LANES.get(arrived.instance_class)
    if by_lanes and can_compile(by_lanes, arrived, listeners, links, params, agents, sums):
        chosen = by_lanes
    return lambda arrived, listeners, links, params, agents, sums: chosen(
        arrived, listeners, links, params, agents, sums
    )


@overload(choose, inline="always")
def _choose(arrived, listeners, links, params, agents, leader, lowest):
    chosen = _CHOOSING[arrived.instance_class]
    return lambda arrived, listeners, links, params, agents, leader, lowest: chosen(
        arrived, listeners, links, params, agents, leader, lowest
    )


@overload(said_by, inline="always")
def _said_by(arrived, j, i):
    chosen = _kept_by if arrived.instance_class is Kept else _arrived_by
    return lambda arrived, j, i: chosen(arrived, j, i)


@overload(told_by, inline="always")
def _told_by(arrived, j, i):
    if arrived.instance_class is Kept:
        return lambda arrived, j, i: arrived.told[row_of(arrived, j, i), j]
    return lambda arrived, j, i: arrived.told[j]
