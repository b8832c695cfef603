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


def _together(kernels):
    """The kernel that runs up to six, one after the other: a chain of pairs would take twice as long to compile."""
    first, second, third, fourth, fifth, sixth = [*kernels, *[_nothing] * 6][:6]

    @kernel
    def together(tally, step, world, swarm, targets, scratch):
        first(tally, step, world, swarm, targets, scratch)
        second(tally, step, world, swarm, targets, scratch)
        third(tally, step, world, swarm, targets, scratch)
        fourth(tally, step, world, swarm, targets, scratch)
        fifth(tally, step, world, swarm, targets, scratch)
        sixth(tally, step, world, swarm, targets, scratch)

    return together


def chained(kernels: Iterable[Kernel | None]) -> Kernel:
    """The kernel that runs all of these, in order."""
    whole = [kernel(each) for each in kernels if each]
    while len(whole) > 1:
        whole = [_together(whole[first : first + 6]) for first in range(0, len(whole), 6)]
    return whole[0] if whole else _nothing


measure_before_move = chained(each.before_move for each in MEASUREMENTS)
measure_links = chained(each.linked for each in MEASUREMENTS)
measure_after_move = chained(each.after_move for each in MEASUREMENTS)
