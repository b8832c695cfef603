"""The network as a graph: how many parts it falls into, and how clustered it is."""

from shoal.compiler.kernel import kernel
from shoal.metrics.contract import Measurement, Metric, Sum
from shoal.metrics.shares import share
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
    for i in range(world.agents):
        scratch.a[i] = clustering_of(scratch.links, swarm.alive, world.agents, i)
    add_graph(tally, step, world, swarm, scratch)


@kernel
def clustering_of(links, alive, agents, i):
    """Clustering of agent i."""
    heard = 0
    linked_pairs = 0
    for one in range(agents):
        if linked(links, one, i) and alive[one] > 0.0:
            heard += 1
            for other in range(one):
                both = linked(links, other, i) and alive[other] > 0.0
                linked_pairs += both and (linked(links, one, other) or linked(links, other, one))
    return 2.0 * linked_pairs / (heard * (heard - 1)) if heard > 1 else 0.0


@kernel
def add_graph(tally, step, world, swarm, scratch):
    """Count the components, and add up the clustering of all agents, which is in scratch.a."""
    agents, alive, links, part = world.agents, swarm.alive, scratch.links, scratch.leader
    for i in range(agents):
        part[i] = i
    for i in range(agents):
        for j in range(agents):
            if linked(links, j, i) and alive[j] > 0.0:
                _join(part, i, j)
    components = 0
    active = 0
    total = 0.0
    for i in range(agents):
        there = alive[i] > 0.0
        components += there and part[i] == i
        active += there
        total += scratch.a[i]
    tally.graphs[step.batch] += 1.0
    tally.components[step.batch] += components
    tally.clustering[step.batch] += total / max(active, 1)


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
