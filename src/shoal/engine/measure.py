"""What is counted at each moment of a step: what every measurement counts then, one after the other.

The kernels of all files of metrics are chained once, here, so that a moment is one kernel that numba can cache.
"""

from collections.abc import Collection

from shoal.compiler.kernel import kernel
from shoal.metrics.catalogue import MEASUREMENTS
from shoal.metrics.contract import MOMENTS, Kernel


@kernel
def _nothing(tally, step, world, swarm, targets, scratch):
    """What is counted where there is nothing to count."""


def _together(kernels):
    """The kernel that runs up to six, one after the other: a chain of pairs would take twice as long to compile.

    kernels : each with its bit of world.skipped, 0 where it is never left out
    """
    chosen = [*kernels, *[(_nothing, 0)] * 6][:6]
    (first, a), (second, b), (third, c), (fourth, d), (fifth, e), (sixth, f) = chosen

    @kernel
    def together(tally, step, world, swarm, targets, scratch):
        if world.skipped & a == 0:
            first(tally, step, world, swarm, targets, scratch)
        if world.skipped & b == 0:
            second(tally, step, world, swarm, targets, scratch)
        if world.skipped & c == 0:
            third(tally, step, world, swarm, targets, scratch)
        if world.skipped & d == 0:
            fourth(tally, step, world, swarm, targets, scratch)
        if world.skipped & e == 0:
            fifth(tally, step, world, swarm, targets, scratch)
        if world.skipped & f == 0:
            sixth(tally, step, world, swarm, targets, scratch)

    return together


def chained(moment: str, besides: Collection[str] = ()) -> Kernel:
    """The kernel of all that is counted at one of MOMENTS, in order, but for measurements of these names.

    Those of which world.skipped has a bit are left out as it runs.
    """
    counts = [(number, getattr(each, moment)) for number, each in enumerate(MEASUREMENTS) if each.name not in besides]
    whole = [(kernel(count), 1 << number) for number, count in counts if count]
    while len(whole) > 1 or (whole and whole[0][1]):
        whole = [(_together(whole[first : first + 6]), 0) for first in range(0, len(whole), 6)]
    return whole[0][0] if whole else _nothing


measure_before_move, measure_links, measure_after_move = map(chained, MOMENTS)
