"""One buoy at the helm of one body, by a common clock: no sea is asked, and nobody is waited for."""

import math
import time
from collections import Counter
from collections.abc import Callable

import numpy as np

from shoal.buoy.aboard import Aboard
from shoal.buoy.body import Body
from shoal.buoy.clock import CommonClock
from shoal.buoy.errors import UnreadyError
from shoal.buoy.logbook import Logbook
from shoal.buoy.mesh import Peers
from shoal.buoy.paced import HALF
from shoal.buoy.tether import READINGS, Tick
from shoal.buoy.twins import Twins
from shoal.core.messages import Reading

QUIET = 3.0  # [s] beside two report intervals without a word of any other buoy, after which the vehicle is stopped
MATCHING = 1.0  # [s] at least between two questions for the time


class Helm:
    """In every step: read, speak, hear, decide, go.

    A body that does not know its place, or does not obey, does without in this step. One that hears nobody for a while
    is stopped, and goes on when it hears somebody.

    Parameters
    ----------
    aboard : the one buoy; mesh : that carries its reports; body : what it steers
    clock : of all buoys, begun
    log : what keeps what it does
    twins : looks out for another buoy of its number
    wait : lets some seconds pass

    Attributes
    ----------
    counts : steps in which it `decided`, was `unready`, `disobeyed`, `alone` or `twinned`; steps `skipped`; silences of
        the swarm
    delays : how many reports of a step arrived so many milliseconds after it began
    """

    def __init__(
        self,
        aboard: Aboard,
        mesh: Peers,
        body: Body,
        clock: CommonClock,
        log: Logbook,
        twins: Twins,
        *,
        wait: Callable[[float], None] = time.sleep,
    ) -> None:
        self.counts: Counter[str] = Counter()
        self.delays: Counter[int] = Counter()
        scenario = aboard.scenario
        (self._me,) = aboard.ids
        self._buoy = aboard.buoys[self._me]
        self._aboard, self._mesh, self._body, self._clock, self._log = aboard, mesh, body, clock, log
        self._twins = twins
        twins.under_way()
        self._everybody = np.ones(scenario.agents, bool)
        self._period, self._interval = scenario.time_step, scenario.report_steps
        self._wait = wait
        self._quiet = QUIET + 2 * self._interval * self._period
        self._last: dict[int, int] = {}  # the step at which each other was heard last
        self._heard_at = clock.now()
        self._matched_at = -math.inf
        self._alone = False

    def run(self, steps: int) -> None:
        """Go on until so many steps are over.

        Raises
        ------
        StrategyError : the strategy fails
        FleetError : a buoy of this number was there first, and stays
        """
        done = max(-1, self._clock.step() - 1)
        while (step := self._next(done)) < steps:
            if step > done + 1:
                self.counts["skipped"] += step - done - 1
            self._one(step)
            done = step
            if self._clock.now() - self._matched_at >= MATCHING:
                self._matched_at = self._clock.now()
                self._clock.match(self._mesh)
        self._body.stop()

    def _next(self, done: int) -> int:
        """Wait for a step that is not done; where the clock was set back by more than one, it is done anew."""
        while True:
            step = self._clock.step()
            if step > done or step < done - 1:
                if step >= 0:
                    return step
                done = min(done, -1)
            self._wait(min(max(self._clock.left(max(done, step) + 1), 0.0), self._period) + 1e-4)

    def _one(self, step: int) -> None:
        try:
            reading = self._body.read()
        except UnreadyError as error:
            self.counts["unready"] += 1
            self._listen(step)
            notes = [str(error.args[1]), *self._attend(Tick(step, 0, _row(self._me, _NOWHERE), self._everybody))]
            self._aboard.inbox.forget(step)
            self._log.lack(step, "; ".join(filter(None, (*notes, self._twin()))))
            return
        tick = Tick(step, 0, _row(self._me, reading), self._everybody)
        for report in self._aboard.speak(tick):
            self._mesh.publish(report)
        heard = self._listen(step)
        notes = self._attend(tick)
        (want,) = self._aboard.act(tick).wants
        velocity = self._buoy.limited(reading, *map(float, want))
        self.counts["decided"] += 1
        notes = [*notes, self._steer(velocity), self._twin()]
        self._log.keep(step, reading, velocity, heard, "; ".join(filter(None, notes)))

    def _twin(self) -> str:
        """What is to be noted of another buoy of this number."""
        there = self._twins.look()
        if not self._twins.hear(self._aboard.inbox.foreign) and not there:
            return ""
        self.counts["twinned"] += 1
        return f"there is another buoy {self._me}"

    def _attend(self, tick: Tick) -> list[str]:
        """Take orders that arrived, to be obeyed from the next step on, and pass them on; return what came of them."""
        for data in self._aboard.attend(self._mesh.orders(0.0), tick, time.time()):
            self._mesh.order(data)
        book = self._aboard.orderbook
        if book is None:
            return []
        said = [f"ordered from step {command.step:,} on: {command.words}" for command in book.obeyed] + book.refused
        book.obeyed, book.refused = [], []
        return said

    def _listen(self, step: int) -> int:
        """Hear until all who spoke lately are heard, or half of the step is over; return how many others were."""
        self._hear(0.0, step)
        lately = {id for id, then in self._last.items() if step - then <= 3 * self._interval}
        while (left := self._clock.left(step + HALF)) > 0.0 and not lately <= self._spoke(step):
            before = len(self._aboard.inbox.of(step))
            self._hear(left, step)
            late = max(0, int(-1000 * self._clock.left(step)))
            self.delays[late] += len(self._aboard.inbox.of(step)) - before
        tick = Tick(step, 0, _NOBODY, self._everybody)
        others = {id: then for id, then in self._aboard.heard(tick).items() if id != self._me}
        self._last |= others
        if others:
            self._heard_at = self._clock.now()
        return len(others)

    def _hear(self, timeout: float, step: int) -> None:
        """Take what arrived, and pass on at once what may go further."""
        self._aboard.hear(self._mesh.take(timeout), step)
        for data in self._aboard.relayed():
            self._mesh.publish(data)

    def _spoke(self, step: int) -> set[int]:
        """Who spoke at the last step at which anybody did."""
        return set(self._aboard.inbox.of(step - step % self._interval))

    def _steer(self, velocity: tuple[float, float]) -> str:
        """Let the body go with a velocity, unless the swarm is silent; return what is to be noted."""
        if self._clock.now() - self._heard_at > self._quiet:
            self.counts["alone"] += 1
            self.counts["silences"] += not self._alone
            self._alone = True
            self._body.stop()
            return "stopped: nobody is heard"
        self._alone = False
        try:
            self._body.go(*velocity)
        except UnreadyError as error:
            self.counts["disobeyed"] += 1
            return str(error.args[1])
        return ""


_NOBODY = np.zeros(0, READINGS)
_NOWHERE = Reading(0.0, 0.0, 0.0, 0.0, False)


def _row(id: int, reading: Reading) -> np.ndarray:
    return np.array([(id, *reading)], READINGS)
