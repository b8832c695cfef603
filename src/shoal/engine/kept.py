"""Listening where reports are kept: each pair has one of its own age, so that agents listen one by one.

The same as in listen.py, of which the loops are over all pairs at once. `Memories` tells which of both is compiled:
a run that keeps nothing compiles nothing of this, see `Simulation`.
"""

from typing import Any, NamedTuple

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.core.messages import Report
from shoal.engine.listen import listener
from shoal.strategies import asking
from shoal.world.neighbors import within
from shoal.world.radio import row


class Kept(NamedTuple):
    """The reports that agents have at a step: what is on the air, and radio.heard says which of it each has.

    told : (D, L) what was told; then : the step at which was said what arrives now; time_step [s]
    """

    radio: Any
    told: Any
    then: int
    time_step: float


@kernel
def row_of(kept, j, i):
    """The row of the air that holds what agent i has of j; of itself, or of nobody, what is said now."""
    last = kept.radio.heard[j, i]
    return row(kept.radio, last if last >= 0 else kept.then)


@kernel
def choose_kept_leaders(kept, listeners, links, params, agents, leader, lowest):
    """Set leader[i] to the index of the neighbor that listener i follows, -1 if none; lowest[i] is its priority."""
    air, told = kept.radio, kept.told
    for i in range(listeners.x.size):
        leader[i] = -1
        lowest[i] = np.inf
        me = listener(listeners, i)
        for j in range(agents):
            if within(links, j, i):
                at = row_of(kept, j, i)
                x, y, vx, vy, on_target = air.x[at, j], air.y[at, j], air.vx[at, j], air.vy[at, j], air.on_target[at, j]
                time = air.heard[j, i] * kept.time_step
                if asking.leads(Report(j, x, y, vx, vy, on_target, told[at, j], time, None), params):
                    rank = asking.rank_of(links.rank, j, i, params)
                    other = Report(j, x, y, vx, vy, on_target, told[at, j], time, rank)
                    priority = asking.priority(me, other, params)
                    if priority < lowest[i]:
                        lowest[i] = priority
                        leader[i] = j


@kernel
def sum_kept_influence(kept, listeners, links, params, agents, sums):
    """Add up what the neighbors of each listener exert on it, (S, L), and count them in links.heard."""
    air, told, heard = kept.radio, kept.told, links.heard
    for i in range(listeners.x.size):
        asking.clear(sums, i, params)
        heard[i] = 0
        me = listener(listeners, i)
        for j in range(agents):
            if within(links, j, i):
                heard[i] += 1
                if asking.has_influence(params):
                    at = row_of(kept, j, i)
                    rank = asking.rank_of(links.rank, j, i, params)
                    time = air.heard[j, i] * kept.time_step
                    x, y, vx, vy = air.x[at, j], air.y[at, j], air.vx[at, j], air.vy[at, j]
                    other = Report(j, x, y, vx, vy, air.on_target[at, j], told[at, j], time, rank)
                    asking.add(sums, i, asking.influence(me, other, params), True)
