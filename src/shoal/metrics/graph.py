"""The network as a graph: how many parts it falls into, and how clustered it is."""

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.metrics.contract import Measurement, Metric, Sum
from shoal.metrics.shares import share
from shoal.world.lists import LANES
from shoal.world.neighbors import linked

EVERY = 500  # steps between two looks at the graph


@kernel
def tally_graph(tally, step, world, swarm, targets, scratch):
    """Count the weakly connected components, and the mean clustering of the agents (Watts and Strogatz 1998).

    Clustering of i: of the pairs of agents that i hears, the share in which one hears the other; 0 of an agent that
    hears fewer than two. Absent agents are not part of it. Known where all agents listen together.
    """
    if world.sequential or step.number % EVERY != 0:
        return
    alive, links, part = swarm.alive, scratch.links, scratch.leader
    for i in range(world.agents):
        part[i] = i
    if links.silent.size > 0:
        clustering = cluster_lists(links.lists, alive, part, world.agents)
    else:
        clustering = cluster_all(links, alive, part, world.agents)
    add_graph(tally, step.batch, alive, part, clustering, world.agents)


@kernel
def add_graph(tally, batch, alive, part, clustering, agents):
    """Count the components, of which part[i] names one member, and add the clustering of agents, which is summed."""
    components = 0
    active = 0
    for i in range(agents):
        there = alive[i] > 0.0
        components += there and part[i] == i
        active += there
    tally.graphs[batch] += 1.0
    tally.components[batch] += components
    tally.clustering[batch] += clustering / max(active, 1)


@kernel
def cluster_all(links, alive, part, agents):
    """Return the clustering of agents, summed, and join the parts of those linked. Whom each hears is a set of bits."""
    words = (agents + 31) // 32
    hears = np.zeros((agents, words), np.int64)
    linked_either_way = np.zeros((agents, words), np.int64)
    for i in range(agents):
        for j in range(agents):
            if linked(links, j, i) and alive[j] > 0.0:
                hears[i, j >> 5] |= 1 << (j & 31)
                linked_either_way[i, j >> 5] |= 1 << (j & 31)
                linked_either_way[j, i >> 5] |= 1 << (i & 31)
                join(part, i, j)
    total = 0.0
    for i in range(agents):
        count = 0
        ends = 0
        for j in range(agents):
            if (hears[i, j >> 5] >> (j & 31)) & 1:
                count += 1
                for word in range(words):
                    ends += bits_of(hears[i, word] & linked_either_way[j, word])
        total += ends / (count * (count - 1)) if count > 1 else 0.0
    return total


@kernel
def cluster_lists(lists, alive, part, agents):
    """The same, where lists say who hears whom."""
    order, most = lists.cells.order, lists.most[0]
    among = np.full(agents, -1)  # where among those whom p hears, as p * most + number
    pairs = np.zeros((most, (most + 31) // 32), np.int64)  # of these, which are linked, as bits
    clustering = np.zeros(agents)
    for p in range(agents):
        count = 0
        for c in range(lists.begins[p // LANES], lists.begins[p // LANES + 1]):
            q = lists.near[c]
            if (lists.hears[c] >> (p % LANES)) & 1 != 0 and alive[order[q]] > 0.0:
                join(part, order[p], order[q])
                among[q] = p * most + count
                pairs[count] = 0
                count += 1
        for c in range(lists.begins[p // LANES], lists.begins[p // LANES + 1]):
            one = among[lists.near[c]] - p * most
            if (lists.hears[c] >> (p % LANES)) & 1 != 0 and one >= 0:
                _join_pairs(lists, lists.near[c], among, p * most, pairs, one)
        ends = 0
        for one in range(count):
            for word in range(pairs.shape[1]):
                ends += bits_of(pairs[one, word])
        clustering[order[p]] = ends / (count * (count - 1)) if count > 1 else 0.0
    total = 0.0
    for i in range(agents):  # in this order for the last bit
        total += clustering[i]
    return total


@kernel
def _join_pairs(lists, q, among, first, pairs, one):
    """Note in `pairs` which of those numbered from `first` on the agent at place q hears: it is number `one`."""
    for c in range(lists.begins[q // LANES], lists.begins[q // LANES + 1]):
        other = among[lists.near[c]] - first
        if (lists.hears[c] >> (q % LANES)) & 1 != 0 and other >= 0:
            pairs[one, other >> 5] |= 1 << (other & 31)
            pairs[other, one >> 5] |= 1 << (one & 31)


@kernel
def bits_of(word):
    """How many of the lower 32 bits of a word are set."""
    word = word - ((word >> 1) & 0x55555555)
    word = (word & 0x33333333) + ((word >> 2) & 0x33333333)
    return ((((word + (word >> 4)) & 0x0F0F0F0F) * 0x01010101) & 0xFFFFFFFF) >> 24


@kernel
def join(part, one, other):
    """Unite the parts of two agents under the lower root."""
    while part[one] != one:
        one = part[one]
    while part[other] != other:
        other = part[other]
    part[max(one, other)] = min(one, other)


MEASUREMENT = Measurement(
    "graph",
    sums=(
        Sum("graphs", "1", "looks at the network"),
        Sum("components", "1", "parts that it fell into, summed over these"),
        Sum("clustering", "1", "mean clustering of the agents, summed over these"),
    ),
    linked=tally_graph,
    metrics=(
        Metric(
            "components",
            "1",
            "parts that the network falls into (synchronous order)",
            lambda t, f: share(t.components, t.graphs),
            low=1.0,
            high="agents",
        ),
        Metric(
            "clustering",
            "1",
            "share of pairs of an agent's neighbors that are linked (synchronous order)",
            lambda t, f: share(t.clustering, t.graphs),
            high=1.0,
        ),
    ),
    order=7,
)
