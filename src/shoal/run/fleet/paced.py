"""By the clock: the sea goes on whether buoys answer or not; a body does what it was told last."""

import time
from collections.abc import Callable
from multiprocessing.connection import wait

import numpy as np

from shoal.buoy.clock import Quickest
from shoal.buoy.tether import BEGIN, Commands, Note
from shoal.run.fleet.kills import Killing
from shoal.run.fleet.log import Log
from shoal.run.fleet.ocean import Ocean
from shoal.run.fleet.processes import Processes, Tied

SILENT = 1.0  # seconds of the run without a command after which a body stops
PINGS = 9  # before the first step, and one in every step: of nine, the quickest tells how far clocks are apart
ANSWERS = 1.0  # seconds to wait for each before the first step
NEAR = 1e-4  # seconds by which a clock may be off before it is set again


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
        self._quickest: dict[Tied, Quickest] = {}
        self._offsets: dict[Tied, float] = {}  # of each process's clock against ours, as it was told [s]
        self._early: list[int] = []  # who was lost in step 0
        self.furthest = 0.0  # by how much a clock was set anew at most [s]
        self.behind = 0  # steps that began too late

    def run(self, progress: Callable[[int, int], None]) -> None:
        """Run it; progress is called as progress(steps done, steps in all).

        Raises
        ------
        FleetError : all buoys ended by an error of their own
        """
        ocean, steps = self._ocean, self._ocean.simulation.scenario.steps
        begun, lost = self._crowd.ask(ocean.tick(BEGIN)._replace(readings=ocean.readings(), hears=None))
        self._lose(lost)
        for commands in begun:
            self._log.remember(commands.ids, commands.memory)
        self._set_clocks()
        while ocean.number < steps:
            self._ask_for_time()
            if ocean.number and self._early:
                self._lose(self._early)
                self._early = []
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
                elif isinstance(said, Note) and said.word == "pong":
                    self._match(tied, said, time.monotonic())
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
        """Let buoys be lost now; who was there when step 0 began is lost at step 1."""
        if self._ocean.number == 0:
            self._early += ids
        else:
            self._log.lose(self._ocean.number, self._ocean.lose(ids))

    def _set_clocks(self) -> None:
        """Agree on when step 0 begins: ask every process for its time, and tell it in its own when that is."""
        for tied in list(self._crowd.tied):
            for _ in range(PINGS):
                self._ping(tied)
                while tied.connection.poll(ANSWERS):
                    said = self._crowd.receive(tied)
                    if isinstance(said, Note) and said.word == "pong":
                        self._match(tied, said, time.monotonic())
                        break
                    if said is None:
                        break
        self._begin = time.monotonic() + 2 * self._period
        for tied in list(self._crowd.tied):
            self._tell(tied)

    def _ask_for_time(self) -> None:
        """Ask one process after the other, one in a step, just before its instruments speak."""
        tied = self._crowd.tied
        if tied:
            self._ping(tied[self._ocean.number % len(tied)])

    def _ping(self, tied: Tied) -> None:
        tied.say(Note("ping", {"sent": time.monotonic()}).to_bytes())

    def _match(self, tied: Tied, said: Note, back: float) -> None:
        """Take a process's time; where its clock is off, tell it anew when step 0 began."""
        sent = float(said.facts["sent"])
        quickest = self._quickest.setdefault(tied, Quickest())
        offset = quickest.add(back - sent, float(said.facts["here"]) - (sent + back) / 2)
        off = offset - self._offsets.get(tied, 0.0)
        if tied in self._offsets and abs(off) <= NEAR:
            return
        self._offsets[tied] = offset
        if self._begin:
            self.furthest = max(self.furthest, abs(off))
            self._tell(tied)

    def _tell(self, tied: Tied) -> None:
        if tied in self._offsets:
            tied.say(Note("clock", {"begin": self._begin + self._offsets[tied]}).to_bytes())

    def notes(self) -> list[str]:
        """What is to be told of clocks and of buoys that are silent still."""
        notes = [f"buoy {id} was silent from step {since:,} on" for id, since in sorted(self._silent.items())]
        if self.behind:
            plural = "s" * (self.behind != 1)
            notes.append(f"the sea was behind the clock by a step or more in {self.behind:,} step{plural}")
        if self._offsets:
            spread = max(map(abs, self._offsets.values()))
            notes.append(f"clocks were {1000 * spread:.2f} ms apart at most, and set by {1000 * self.furthest:.2f} ms")
        return notes


def percentile(counts: dict[int, int], share: float) -> int:
    """The value below or at which a share of what was counted lies."""
    total, below = sum(counts.values()), 0
    for value in sorted(counts):
        below += counts[value]
        if below >= share * total:
            return value
    return 0
