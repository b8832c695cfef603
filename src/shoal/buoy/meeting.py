"""How buoys begin together: they wait until enough are there, and whoever has the lowest number says when step 0 is."""

import time
from collections.abc import Callable

from shoal.buoy.clock import CommonClock, numbers
from shoal.buoy.mesh import Peers
from shoal.buoy.twins import Twins

LEAD = 1.0  # [s] beside two steps from saying when step 0 is to its begin: all must have heard of it
_LOOK = 0.05  # [s] between two questions


def meet(
    mesh: Peers,
    clock: CommonClock,
    me: int,
    wanted: int,
    period: float,
    tell: Callable[[str], None],
    twins: Twins,
    wait: Callable[[float], None] = time.sleep,
) -> None:
    """Wait until it is known when step 0 begins, or began: who comes later joins those who are under way.

    Nobody begins while another buoy of its number is there that came first.

    Parameters
    ----------
    mesh : that the buoys are on; clock : of this one, which is known when it returns
    me : number of this buoy
    wanted : so many buoys must be there for the first to begin
    period : of a step [s]
    tell : called with a sentence when somebody came or left
    twins : looks out for another of this number
    wait : lets some seconds pass

    Raises
    ------
    FleetError : another stays
    """
    turn, before = 0, -1
    mesh.answer(clock.answer)
    while True:
        if twins.second():
            wait(_LOOK)
            continue
        there = numbers(mesh.nodes())
        clock.hear(there)
        if clock.begin is not None:
            return
        others = [node for node in there if node != me]
        if there and len(there) != before:
            before = len(there)
            tell(f"buoy {me}: {before} of {wanted} buoys are here")
        if len(there) >= wanted and me == there[0] and clock.idle >= set(others):
            clock.start(clock.now() + 2 * period + LEAD)
            return
        if others:
            turn = (turn + 1) % len(others)
            for node in {others[0], others[turn]}:
                clock.ask(mesh, node)
        wait(_LOOK)
