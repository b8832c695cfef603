"""When each metric is counted within a step."""

from shoal.compiler.kernel import kernel
from shoal.metrics.closest import tally_closest
from shoal.metrics.contacts import tally_contacts
from shoal.metrics.coverage import tally_coverage
from shoal.metrics.effort import tally_effort
from shoal.metrics.graph import tally_graph
from shoal.metrics.heading_bearing import tally_heading_bearing
from shoal.metrics.time_on_target import tally_time_on_target
from shoal.metrics.velocity_fluctuation import tally_velocity_fluctuation


@kernel
def measure_before_move(tally, batch, world, swarm, targets, counts, number, scratch):
    """What is true at the start of a step: who is on target, how velocities differ, who watches where, who is close.

    counts : how many agents are on a target, and how many are there
    """
    engaged, active = counts
    tally_time_on_target(tally, batch, targets, engaged)
    tally_contacts(tally, batch, targets)
    tally_velocity_fluctuation(tally, batch, swarm, world.agents, active, scratch.a)
    tally_coverage(tally, batch, world, swarm, number)
    tally_closest(tally, swarm, world.agents, number)


@kernel
def measure_links(tally, batch, world, swarm, scratch, first, number):
    """What the block of agents that just listened heard; the graph is known where all listen together."""
    links = scratch.links
    reports = 0
    for i in range(min(links.heard.size, world.agents - first)):
        reports += links.heard[i] if swarm.alive[first + i] > 0.0 else 0
    tally.heard[batch] += reports
    if not world.sequential:
        tally_graph(tally, batch, world, links, swarm.alive, scratch.leader, number)


@kernel
def measure_after_move(tally, batch, world, swarm, targets, scratch):
    """Where agents head, after the move and before the targets' move."""
    present = False
    for target in targets:
        present |= target.present != 0
    if present:
        tally_heading_bearing(tally, batch, swarm, world.agents, targets, scratch.a, scratch.b, scratch.c)
    tally_effort(tally, batch, world, swarm)
