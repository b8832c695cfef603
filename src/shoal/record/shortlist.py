"""Which metrics of a record are told first: eight at most, unless the scenario names those that it wants."""

from shoal.metrics.summary import METRICS
from shoal.record.record import Record

MOST = 8
_FIRST = (  # what matters most, and before the rest what a scenario asks for by a battery, a radio or a cost
    "time_on_target", "engaged", "xi", "losses", "reacquisition", "first_detection",
    "cost", "first_empty", "least_charge", "airtime", "targets_observed", "fairness", "coverage", "speed",
)  # fmt: skip


def shortlist(record: Record) -> list[str]:
    """Return names of metrics in the order of tables; those of installed packages are among the first."""
    listed = record.listed()
    if record.scenario.metrics:
        return listed
    ours = [name for name in listed if METRICS[name].package]
    order = [*_FIRST[:3], *ours, *_FIRST[3:], *listed]
    chosen = [name for name in dict.fromkeys(order) if name in listed][:MOST]
    return [name for name in listed if name in chosen]
