"""Buoys by the clock: they speak when a step begins and decide when half of it is over, whoever was heard by then."""

from collections import Counter
from multiprocessing.connection import Connection
from typing import Any

import numpy as np

from shoal.buoy.aboard import Aboard
from shoal.buoy.attend import attend
from shoal.buoy.clock import clock_of
from shoal.buoy.mesh import Mesh
from shoal.buoy.tether import BEGIN, Note, Tick, from_bytes

PATIENCE = 0.25  # of a step, in which instruments are waited for
HALF = 0.5  # of a step, in which reports are


class Paced:
    """Answers ticks with commands as its clock goes.

    Parameters
    ----------
    aboard : the buoys; mesh : that carries their reports; connection : to the sea
    period : of a step on the clock [s]

    Attributes
    ----------
    delays : how many reports of a step arrived so many milliseconds after it began
    ages : how many reports decisions were made on that were so many steps old; of -1, none was there
    skipped : steps that passed without a decision
    """

    def __init__(
        self, aboard: Aboard, mesh: Mesh, connection: "Connection[bytes, bytes]", period: float, agents: int
    ) -> None:
        self.delays: Counter[int] = Counter()
        self.ages: Counter[int] = Counter()
        self.skipped = 0
        self._aboard = aboard
        self._mesh = mesh
        self._connection = connection
        self._period = period
        self._agents = agents
        self._now = clock_of(aboard.ids)
        self._begin = 0.0
        self._tick: Tick | None = None

    def run(self) -> Note:
        """Go on until the sea says that it is over, and return what it said.

        Raises
        ------
        EOFError, OSError : the sea is gone
        MessageError : the sea says what is no message
        """
        done = -1
        while True:
            over = self._attend(done)
            if over is not None:
                return over
            tick = self._tick
            if tick is None or not self._begin:
                continue
            step = max(tick.step, int((self._now() - self._begin) / self._period))
            if step == done:
                continue
            self.skipped += max(0, step - done - 1)
            tick = tick._replace(step=step)
            for report in self._aboard.speak(tick):
                self._mesh.publish(report)
            self._listen(tick)
            self._note_ages(tick)
            attend(self._aboard, self._mesh, self._connection, tick)
            said = self._aboard.act(tick)
            self._connection.send_bytes(said._replace(heard=self._aboard.links(said.ids)).to_bytes())
            done = step

    def _attend(self, done: int) -> Note | None:
        """Wait for instruments to say how the next step begins; if they do not in time, the last they said counts."""
        while True:
            late = self._begin + (done + 1 + PATIENCE) * self._period - self._now() if self._begin else None
            if not self._connection.poll(None if late is None or self._tick is None else max(0.0, late)):
                return None
            fresh = False
            while self._connection.poll(0):
                said = from_bytes(self._connection.recv_bytes())
                if isinstance(said, Tick) and said.turn == BEGIN:
                    self._connection.send_bytes(self._aboard.begin(said).to_bytes())
                elif isinstance(said, Tick):
                    self._tick, fresh = said, True
                elif isinstance(said, Note) and said.word == "ping":
                    self._connection.send_bytes(Note("pong", {**said.facts, "here": self._now()}).to_bytes())
                elif isinstance(said, Note) and said.word == "clock":
                    self._begin = float(said.facts["begin"])
                elif isinstance(said, Note):
                    return said
            if fresh:
                return None

    def _listen(self, tick: Tick) -> None:
        """Hear until all are heard, or half of the step is over."""
        begin = self._begin + tick.step * self._period
        until = min(begin, self._now()) + HALF * self._period  # of a clock that is behind, the step is to come yet
        while True:
            messages = self._mesh.take(max(0.0, until - self._now()))
            now = self._now()
            before = len(self._aboard.inbox.of(tick.step))
            self._aboard.hear(messages, tick.step)
            arrived = len(self._aboard.inbox.of(tick.step)) - before
            self.delays[max(0, int((now - begin) * 1000))] += arrived
            if now >= until or not self._aboard.missing(tick):
                return

    def _note_ages(self, tick: Tick) -> None:
        heard = self._aboard.heard(tick)
        spoken = self._aboard.spoken(tick.step)
        for id in np.flatnonzero(tick.alive).tolist():
            self.ages[spoken - heard[id] if id in heard else -1] += 1

    def facts(self) -> dict[str, Any]:
        """What it measured, as it is told at the end."""
        return {
            "delays": {str(key): count for key, count in self.delays.items()},
            "ages": {str(key): count for key, count in self.ages.items()},
            "skipped": self.skipped,
        }
