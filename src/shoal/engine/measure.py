"""What is counted at each moment of a step: what every measurement counts then, one after the other.

The kernels of all files of metrics are chained once, here, so that a moment is one kernel that numba can cache.
"""

from collections.abc import Iterable

from shoal.compiler.kernel import kernel
from shoal.metrics.catalogue import MEASUREMENTS
from shoal.metrics.contract import Kernel


@kernel
def _nothing(tally, step, world, swarm, targets, scratch):
    """What is counted where there is nothing to count."""


def _both(first, second):
    """The kernel that runs one and then another."""

    @kernel
    def both(tally, step, world, swarm, targets, scratch):
        first(tally, step, world, swarm, targets, scratch)
        second(tally, step, world, swarm, targets, scratch)

    return both


def _chained(kernels: Iterable[Kernel | None]) -> Kernel:
    """The kernel that runs all of these, in order."""
    whole = _nothing
    for each in kernels:
        whole = _both(whole, kernel(each)) if each else whole
    return whole


measure_before_move = _chained(each.before_move for each in MEASUREMENTS)
measure_links = _chained(each.linked for each in MEASUREMENTS)
measure_after_move = _chained(each.after_move for each in MEASUREMENTS)
