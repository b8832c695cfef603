"""Messages: how many reports agents receive, and of how many bytes."""

from shoal.compiler.kernel import kernel
from shoal.metrics.contract import Measurement, Metric, Sum
from shoal.metrics.shares import share
from shoal.world.neighbors import linked


@kernel
def tally_messages(tally, step, world, swarm, targets, scratch):
    """Count the reports that the block of agents which just listened goes by: each stays for an interval of reports.

    Older ones that were kept are not received again.
    """
    links, hops = scratch.links, scratch.hops
    reports = 0
    for i in range(min(links.heard.size, world.agents - step.first)):
        reports += links.heard[i] if swarm.alive[step.first + i] > 0.0 else 0
    for j in range(hops.shape[0]):
        for i in range(world.agents):
            reports -= 1 if linked(links, j, i) and hops[j, i] == 0 and swarm.alive[i] > 0.0 else 0
    tally.heard[step.batch] += reports


MEASUREMENT = Measurement(
    "messages",
    sums=(Sum("heard", "reports", "gone by, summed over steps"),),
    linked=tally_messages,
    metrics=(
        Metric(
            "messages",
            "1/s",
            "reports that an agent receives per second",
            lambda t, f: share(t.heard, t.agent_steps) / f.report_interval,
            better="lower",
        ),
        Metric(
            "bandwidth",
            "B/s",
            "bytes of reports that an agent receives per second",
            lambda t, f: share(t.heard, t.agent_steps) / f.report_interval * f.report_bytes,
            better="lower",
        ),
    ),
    order=8,
)
