"""What one agent hears, by the thread that decides for it: what engine/listen.py does for all lanes at once."""

from typing import Any

import numba.cuda
import numpy as np

from shoal.core.messages import Report
from shoal.engine.listen import listener
from shoal.strategies import asking

_device: Any = numba.cuda.jit(device=True)  # numba has no types that mypy sees


@_device
def add_up(arrived, listeners, links, params, agents, sums):
    """Add up what neighbors exert on the one listener, into sums (S, 1); return how many it hears."""
    said, told, at, square, rank, reach = (
        arrived.said, arrived.told, arrived.at, links.square, links.rank, links.reach[0],
    )  # fmt: skip
    me = listener(listeners, 0)
    asking.clear(sums, 0, params)
    heard = 0
    j = 0
    while j < agents:
        hears = square[j, 0] <= reach
        if asking.has_influence(params):
            nearer = asking.rank_of(rank, j, 0, params)
            other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j], at, nearer)
            asking.add(sums, 0, asking.influence(me, other, params), hears)
        heard += 1 if hears else 0
        j += 1
    return heard


@_device
def choose(arrived, listeners, links, params, agents):
    """The index of the neighbor that the one listener follows, -1 if none."""
    said, told, at, square, rank, reach = (
        arrived.said, arrived.told, arrived.at, links.square, links.rank, links.reach[0],
    )  # fmt: skip
    me = listener(listeners, 0)
    leader = -1
    lowest = np.inf
    j = 0
    while j < agents:
        other = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j], at, None)
        if asking.leads(other, params) and square[j, 0] <= reach:
            nearer = asking.rank_of(rank, j, 0, params)
            ranked = Report(j, said.x[j], said.y[j], said.vx[j], said.vy[j], said.on_target[j], told[j], at, nearer)
            priority = asking.priority(me, ranked, params)
            if priority < lowest:
                lowest = priority
                leader = j
        j += 1
    return leader
