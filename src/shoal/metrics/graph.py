"""The network as a graph: how many parts it falls into, and how clustered it is."""

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.metrics.contract import Measurement, Metric, Sum
from shoal.metrics.shares import share
from shoal.world.lists import count_of, heard_of
from shoal.world.neighbors import linked, within

EVERY = 500  # steps between two looks at the graph


@kernel
def tally_graph(tally, step, world, swarm, targets, scratch):
    """Count the weakly connected components, and the mean clustering of the agents (Watts and Strogatz 1998).

    Clustering of i: of the pairs of agents that i hears, the share in which one hears the other; 0 of an agent that
    hears fewer than two. Absent agents are not part of it. Known where all agents listen together.
    """
    if world.sequential or step.number % EVERY != 0:
        return
    agents, alive, links, part = world.agents, swarm.alive, scratch.links, scratch.leader
    heard = np.empty(agents, np.int64)
    for i in range(agents):
        part[i] = i
    for i in range(agents):
        for n in range(_hears(links, i, alive, heard, agents)):
            _join(part, i, heard[n])
    components = 0
    active = 0
    for i in range(agents):
        there = alive[i] > 0.0
        components += there and part[i] == i
        active += there
    total = 0.0
    others = np.empty(agents, np.int64)
    among = np.full(agents, -1)  # whom i hears
    for i in range(agents):
        count = _hears(links, i, alive, heard, agents)
        for n in range(count):
            among[heard[n]] = i
        ends = 0  # a pair that hears each other is found twice
        for n in range(count):
            one = heard[n]
            for m in range(_hears(links, one, alive, others, agents)):
                other = others[m]
                if among[other] == i:
                    ends += 1 if linked(links, one, other) else 2
        total += ends / (count * (count - 1)) if count > 1 else 0.0
    tally.graphs[step.batch] += 1.0
    tally.components[step.batch] += components
    tally.clustering[step.batch] += total / max(active, 1)


@kernel
def _hears(links, i, alive, heard, agents):
    """Write the present agents that i hears into `heard`; return how many."""
    count = 0
    if links.silent.size > 0:
        for slot in range(count_of(links.lists, i)):
            heard[count] = heard_of(links.lists, i, slot)
            count += 1 if alive[heard[count]] > 0.0 else 0
        return count
    for j in range(agents):
        heard[count] = j
        count += 1 if within(links, j, i) and alive[j] > 0.0 else 0
    return count


@kernel
def _join(part, one, other):
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
