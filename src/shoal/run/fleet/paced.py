"""By the clock: the sea goes on whether buoys answer or not; a body does what it was told last."""

import time
from collections.abc import Callable
from multiprocessing.connection import wait

import numpy as np

from shoal.buoy.tether import BEGIN, Commands, Note
from shoal.run.fleet.kills import Killing
from shoal.run.fleet.log import Log
from shoal.run.fleet.ocean import Ocean
from shoal.run.fleet.processes import Processes, Tied

SILENT = 1.0  # seconds of the run without a command after which a body stops
PINGS = 9  # of which the fastest tells how far clocks are apart


class PacedSea:
    """Runs a fleet by the clock, to the end of its scenario or until it is interrupted.

    Parameters
    ----------
    ocean : the sea; crowd : the processes in it; killing : who of them is killed; log : what keeps what they do
    period : of a step on the clock [s]
    """

    def __init__(self, ocean: Ocean, crowd: Processes, killing: Killing, log: Log, period: float) -> None:
        self._ocean, self._crowd, self._killing, self._log, self._period = ocean, crowd, killing, log, period
        agents = ocean.simulation.scenario.agents
        self._said = np.zeros(agents, np.int64)  # the step at which each said last what it wants
        self._silent: dict[int, int] = {}
        self._quiet = max(2, round(SILENT / ocean.simulation.scenario.time_step))
        self._begin = 0.0
        self._offsets: dict[Tied, float] = {}
        self.behind = 0  # steps that began too late

    def run(self, progress: Callable[[int, int], None]) -> None:
        """Run it; progress is called as progress(steps done, steps in all).

        Raises
        ------
        FleetError : a buoy was lost before the first step was done
        """
        ocean, steps = self._ocean, self._ocean.simulation.scenario.steps
        begun, lost = self._crowd.ask(ocean.tick(BEGIN)._replace(readings=ocean.readings(), hears=None))
        ocean.lose(lost)
        for commands in begun:
            self._log.remember(commands.ids, commands.memory)
        self._set_clocks()
        while ocean.number < steps:
            tick = ocean.tick()
            self._lose(self._killing.kill(tick))
            late = time.monotonic() - (self._begin + ocean.number * self._period)
            self.behind += late > self._period
            for tied in list(self._crowd.tied):
                if not tied.say(tick.of(tied.ids).to_bytes()):
                    self._lose(self._crowd.lose(tied))
            answers = self._answers(self._begin + (ocean.number + 1) * self._period)
            ocean.follow(answers)
            for commands in answers:
                self._log.hear(commands.ids, commands.heard)
            self._stop_the_silent()
            self._log.keep(ocean.advance())
            for commands in answers:
                self._log.remember(commands.ids, commands.memory)
            progress(ocean.number, steps)

    def _answers(self, until: float) -> list[Commands]:
        """What buoys want, as they say it, until a time."""
        answers: list[Commands] = []
        while self._crowd.tied and (left := until - time.monotonic()) > 0.0:
            ready = wait([tied.connection for tied in self._crowd.tied], timeout=left)
            for tied in [tied for tied in self._crowd.tied if tied.connection in ready]:
                said = self._crowd.receive(tied)
                if said is None:
                    self._lose(self._crowd.lose(tied))
                elif isinstance(said, Commands):
                    answers.append(said)
                    self._said[said.ids] = self._ocean.number
        time.sleep(max(0.0, until - time.monotonic()))
        return answers

    def _stop_the_silent(self) -> None:
        """Stop the bodies of buoys that say nothing, and note when that begins and ends."""
        number = self._ocean.number
        silent = (number - self._said > self._quiet) & self._ocean.alive
        ids = np.flatnonzero(silent)
        fresh = np.array([id for id in ids.tolist() if id not in self._silent], np.int32)
        if fresh.size:
            self._ocean.obey(fresh, np.zeros((fresh.size, 2)))
        self._log.silent = ids.tolist()
        for id in ids.tolist():
            self._silent.setdefault(id, int(self._said[id]))
        for id in [id for id in self._silent if not silent[id]]:
            self._log.notes.append(f"buoy {id} was silent from step {self._silent.pop(id):,} to {number:,}")

    def _lose(self, ids: list[int]) -> None:
        self._log.lose(self._ocean.number, self._ocean.lose(ids))

    def _set_clocks(self) -> None:
        """Agree on when step 0 begins: ask every process for its time, and tell it in its own when that is."""
        for tied in list(self._crowd.tied):
            found: list[tuple[float, float]] = []
            for number in range(PINGS):
                sent = time.monotonic()
                tied.say(Note("ping", {"number": number}).to_bytes())
                said = self._crowd.receive(tied)
                back = time.monotonic()
                if isinstance(said, Note) and said.word == "pong":
                    found.append((back - sent, float(said.facts["here"]) - (sent + back) / 2))
            if found:
                self._offsets[tied] = min(found)[1]
        self._begin = time.monotonic() + 2 * self._period
        for tied, offset in self._offsets.items():
            tied.say(Note("clock", {"begin": self._begin + offset}).to_bytes())

    def notes(self) -> list[str]:
        """What is to be told of clocks and of buoys that are silent still."""
        notes = [f"buoy {id} was silent from step {since:,} on" for id, since in sorted(self._silent.items())]
        if self.behind:
            notes.append(f"the sea was behind the clock by a step or more in {self.behind:,} steps")
        if self._offsets:
            spread = max(map(abs, self._offsets.values()))
            notes.append(f"clocks were {1000 * spread:.2f} ms apart at most when step 0 began")
        return notes


def percentile(counts: dict[int, int], share: float) -> int:
    """The value below or at which a share of what was counted lies."""
    total, below = sum(counts.values()), 0
    for value in sorted(counts):
        below += counts[value]
        if below >= share * total:
            return value
    return 0
