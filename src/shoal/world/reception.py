"""Whose reports agents have where radios relay or keep them: what reaches them now, over others too, and what did.

Without either, whom an agent hears is settled by world/radio.py alone, and nothing here runs.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.compiler.kernel import kernel
from shoal.world.radio import row


def collecting(radio: Any, agents: int, max_age: int, hops: int) -> Any:
    """Return a radio that relays reports over `hops` hops and keeps them for `max_age` steps, and has heard nothing."""
    lanes = radio.x.shape[1]
    rows = radio.x.shape[0] + max_age // radio.interval
    air = {name: getattr(radio, name) for name in ("x", "y", "vx", "vy", "on_target", "told")}
    return radio._replace(
        **{name: np.zeros((rows, *array.shape[1:]), array.dtype) for name, array in air.items()},
        heard=np.full((agents if max_age else 0, lanes), -1),
        max_age=max_age,
        hops=hops,
    )


def new_words(agents: int) -> npt.NDArray[np.int64]:
    """Scratch of a search among so many agents: sets of them, 32 to a word."""
    return np.zeros((agents + 3 if agents else 0, (agents + 31) // 32), np.int64)


@kernel
def collects(radio):
    """Whether agents choose their k nearest among reports that they have, not among those that are in reach of them."""
    return radio.max_age > 0 or radio.hops > 1


@kernel
def relay(links, hops, words, most, agents):
    """Set hops[j, i] to the hops over which the report of j reaches i: 1 directly, at most `most`, 0: it does not.

    Whoever has a report passes it on once, in the same step, to all who hear it: a breadth-first search of the links
    that this step has, from every speaker. Links that are cut by range, land or loss carry no report of anybody.

    words : (N + 3, W) scratch of new_words, in which a set of agents is a row of bits
    """
    square, width = links.square, words.shape[1]
    front, seen, further = agents, agents + 1, agents + 2  # rows: reached over the last hop, by now, over the next
    for j in range(agents):
        for word in range(width):
            words[j, word] = 0
        for i in range(agents):
            words[j, i >> 5] |= (1 if square[j, i] < np.inf else 0) << (i & 31)
    for j in range(agents):
        for i in range(hops.shape[1]):
            hops[j, i] = 0
        for word in range(width):
            words[front, word] = words[j, word]
            words[seen, word] = words[j, word]
        words[seen, j >> 5] |= 1 << (j & 31)
        for hop in range(1, most + 1):
            for word in range(width):
                words[further, word] = 0
            for i in range(agents):
                if (words[front, i >> 5] >> (i & 31)) & 1:
                    hops[j, i] = hop
                    if hop < most:
                        for word in range(width):
                            words[further, word] |= words[i, word]
            fresh = 0
            for word in range(width):
                words[front, word] = words[further, word] & ~words[seen, word]
                words[seen, word] |= words[further, word]
                fresh |= words[front, word]
            if fresh == 0:
                break


@kernel
def measure_relayed(links, hops, reports, swarm, agents):
    """Measure how far those lie, as they say, whose reports were relayed [m^2]."""
    square, lanes = links.square, hops.shape[1]
    for j in range(agents):
        for i in range(lanes):
            if hops[j, i] > 1:
                dx, dy = swarm.fix_x[i] - reports.x[j], swarm.fix_y[i] - reports.y[j]
                square[j, i] = dx * dx + dy * dy


@kernel
def recall(links, radio, swarm, then, keeps, agents):
    """Link speakers whose report of step `then` did not arrive by their newest that did, if it is not too old.

    keeps : whether what arrived is remembered from now on
    """
    square, heard = links.square, radio.heard
    for j in range(agents):
        for i in range(links.reach.size):
            arrived = square[j, i] < np.inf
            last = then if arrived else heard[j, i]
            if keeps:
                heard[j, i] = last
            if not arrived and last >= 0 and last >= then - radio.max_age and swarm.alive[i] > 0.0:
                at = row(radio, last)
                dx, dy = swarm.fix_x[i] - radio.x[at, j], swarm.fix_y[i] - radio.y[at, j]
                square[j, i] = dx * dx + dy * dy


@kernel
def want_nearest(links, neighbors, agents):
    """Set links.wanted to k of each listener, or to all that it has if they are fewer."""
    square, wanted = links.square, links.wanted
    for i in range(wanted.size):
        wanted[i] = 0
    for j in range(agents):
        for i in range(wanted.size):
            wanted[i] += 1 if square[j, i] < np.inf else 0
    for i in range(wanted.size):
        wanted[i] = min(wanted[i], neighbors[i])
