"""Lockstep: a step is over when every buoy that is there has heard all others and said what it wants."""

import time
from collections.abc import Callable
from typing import Protocol

from shoal.buoy.tether import BEGIN, Commands, Tick
from shoal.run.fleet.log import Log
from shoal.run.fleet.ocean import Ocean


class Crowd(Protocol):
    """All buoys of a fleet, wherever they run."""

    def ask(self, tick: Tick) -> tuple[list[Commands], list[int]]:
        """Let all buoys begin a step: what they want, and who was lost meanwhile."""


def run_in_lockstep(
    ocean: Ocean, crowd: Crowd, log: Log, progress: Callable[[int, int], None], pace: float | None = None
) -> None:
    """Run a fleet to the end of its scenario, or until it is interrupted.

    A step in which a buoy is lost begins again without it: all others go back to how the step found them, so that the
    fleet does what the simulator does where this buoy is lost at this step.

    Parameters
    ----------
    ocean : the sea; crowd : the buoys in it; log : what keeps what they do
    progress : called as progress(steps done, steps in all)
    pace : a step takes at least so long [s]

    Raises
    ------
    FleetError : a buoy was lost before the first step was done
    """
    steps = ocean.simulation.scenario.steps
    first = ocean.tick(BEGIN)._replace(readings=ocean.readings(), hears=None)
    begun, lost = crowd.ask(first)
    ocean.lose(lost)
    for commands in begun:
        log.remember(commands.ids, commands.memory)
    begin = time.monotonic()
    while ocean.number < steps:
        turn = 0
        while True:
            tick = ocean.tick(turn)
            answers, lost = crowd.ask(tick)
            if not lost:
                break
            log.lose(ocean.number, ocean.lose(lost))
            turn += 1
        for commands in answers:
            ocean.obey(commands.ids, commands.wants)
        log.keep(ocean.advance())
        for commands in answers:
            log.remember(commands.ids, commands.memory)
        progress(ocean.number, steps)
        if pace:
            time.sleep(max(0.0, begin + ocean.number * pace - time.monotonic()))
