"""A common clock: every buoy goes by that of the buoy with the lowest number that is there and has begun.

Who asks another for its time knows half the way there and back as the error; the quickest of the last answers counts.
"""

import math
import os
import queue
import struct
import time
from collections import deque
from collections.abc import Callable, Iterable

from shoal.buoy.mesh import Peers

OFF = (
    "SHOAL_CLOCK_OFF"  # of the environment, for trials: BUOY:SECONDS@AFTER, whose clock is off by so much from when on
)
QUICKEST_OF = 9  # answers
_ANSWER = struct.Struct("<dd")  # the time now, and when step 0 began or will; NaN: nobody knows


class Quickest:
    """Of the last answers to who asked for the time, the one that was there and back most quickly."""

    def __init__(self) -> None:
        self._found: deque[tuple[float, float]] = deque(maxlen=QUICKEST_OF)

    def add(self, way: float, said: float) -> float:
        """Take an answer, and return what the quickest said.

        An answer that the way cannot explain, because a clock was set anew, makes all before it void.

        Parameters
        ----------
        way : there and back [s]
        said : a time that is the same in all answers but for half of the way [s]
        """
        if self._found:
            quickest = min(self._found)
            if abs(said - quickest[1]) > way + quickest[0]:
                self._found.clear()
        self._found.append((way, said))
        return min(self._found)[1]


class CommonClock:
    """When steps begin, by one clock for all.

    Parameters
    ----------
    me : number of this buoy
    period : of a step [s]
    clock : of this computer [s], never goes back

    Attributes
    ----------
    begin : when step 0 began, or will, by the clock of this computer [s]; None before anybody said so
    idle : who answered that it has not begun
    furthest : by how much step 0 was moved at most, once it was known [s]
    """

    def __init__(self, me: int, period: float, clock: Callable[[], float] = time.monotonic) -> None:
        self.begin: float | None = None
        self.idle: set[int] = set()
        self.furthest = 0.0
        self.now = clock
        self._me = me
        self._period = period
        self._leader = -1
        self._found = Quickest()
        self._answers: queue.SimpleQueue[tuple[int, float, float, bytes]] = queue.SimpleQueue()

    def start(self, begin: float) -> None:
        """Let step 0 begin at a time of this computer's clock [s]."""
        self.begin = begin

    def step(self) -> int:
        """The step that it is now; below 0 before the first."""
        assert self.begin is not None
        return math.floor((self.now() - self.begin) / self._period)

    def left(self, step: float) -> float:
        """How long it is until so many steps have passed [s], below 0 afterwards."""
        assert self.begin is not None
        return self.begin + step * self._period - self.now()

    def elapsed(self) -> float:
        """Time since step 0 began [s]; 0 before."""
        return 0.0 if self.begin is None else max(0.0, self.now() - self.begin)

    def answer(self) -> bytes:
        """What is answered to who asks for the time."""
        return _ANSWER.pack(self.now(), math.nan if self.begin is None else self.begin)

    def ask(self, mesh: Peers, node: int) -> None:
        """Ask a buoy for its time; `hear` takes the answer when it is there."""
        sent = self.now()
        mesh.ask(str(node), lambda data: self._answers.put((node, sent, self.now(), data)))

    def match(self, mesh: Peers) -> None:
        """Take what was answered, and ask again whom this buoy goes by: nobody, where it has the lowest number."""
        there = numbers(mesh.nodes())
        self.hear(there)
        leader = min(there, default=self._me)
        if leader < self._me:
            self.ask(mesh, leader)

    def hear(self, there: Iterable[int]) -> None:
        """Take the answers that arrived; the time of the lowest of those who are there and have begun counts."""
        self.idle &= set(there)
        while not self._answers.empty():
            node, sent, back, data = self._answers.get()
            try:
                now, begin = _ANSWER.unpack(data)
            except struct.error:
                continue
            if not (math.isfinite(now) and math.isfinite(begin)):
                self.idle.add(node)
                continue
            self.idle.discard(node)
            if self.begin is None or node < self._me:
                self._follow(node, back - sent, (sent + back) / 2 - now + begin)

    def _follow(self, node: int, way: float, begin: float) -> None:
        if node != self._leader:
            self._leader, self._found = node, Quickest()
        begin = self._found.add(way, begin)
        if self.begin is not None:
            self.furthest = max(self.furthest, abs(begin - self.begin))
        self.begin = begin


def numbers(nodes: Iterable[str]) -> list[int]:
    """The buoys among the nodes of a mesh, in order; watchers have names."""
    return sorted(int(node) for node in nodes if node.isascii() and node.isdigit())


def clock_of(ids: Iterable[int]) -> Callable[[], float]:
    """Return this computer's clock [s]; in trials it is off, where the environment says so of one of these buoys."""
    number, _, rest = os.environ.get(OFF, "").partition(":")
    off, _, after = rest.partition("@")
    if not number.isdigit() or int(number) not in ids:
        return time.monotonic
    seconds, begun = float(off), time.monotonic() + float(after or 0.0)

    def now() -> float:
        true = time.monotonic()
        return true + (seconds if true >= begun else 0.0)

    return now
