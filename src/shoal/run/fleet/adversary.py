"""The seeded adversary of a soak: what becomes of every message, and what befalls every process, by chance alone."""

import math
import zlib
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.messages import Report

RECOVERY = 60  # steps of a calm after which everybody must be heard again, whatever happened before
FURTHEST = 20.0  # steps by which a clock is off at most


class Weather(NamedTuple):
    """Chances for each message and listener, and how long one takes on average [steps]."""

    delay: float = 0.1
    drop: float = 0.0
    copy: float = 0.0
    damage: float = 0.0
    noise: float = 0.0  # of a message that nobody said, for each listener and step
    again: float = 0.0  # of an old message that comes again, for each listener and step
    incident: float = 0.0  # for each step


CALM = Weather()


class Fates(NamedTuple):
    """What becomes of M messages on the way to P listeners, (M, P) each; delays in steps, negative: never arrives."""

    delays: npt.NDArray[np.float64]
    copies: npt.NDArray[np.float64]
    damaged: npt.NDArray[np.bool_]


class Incident(NamedTuple):
    """What befalls a process: killed, frozen or restarted for so many steps, or its clock off by so many."""

    kind: str
    process: int
    amount: float


class Adversary:
    """All chance of a soak.

    Parameters
    ----------
    seed : decides everything
    processes : P, how many there are
    agents : N, how many buoys there are in all of them

    Attributes
    ----------
    weather : of the present stretch; calm : steps since it is calm, 0 in a storm
    sides : (P,) on which side of a cut each process is; those of different sides do not hear each other
    """

    def __init__(self, seed: int, processes: int, agents: int) -> None:
        self._chance = np.random.default_rng([seed, 0x50A4])
        self._processes, self._agents = processes, agents
        self._left = 0
        self._kills = processes // 2
        self.weather = CALM
        self.calm = 0
        self.sides = np.zeros(processes, np.int64)

    def plan(self, up: list[int]) -> list[Incident]:
        """What happens as a step begins; `up` are the processes that were not killed."""
        self._left -= 1
        self.calm += self.weather is CALM
        if self._left < 0:
            self.calm = 0
            return self._turn()
        if self._chance.random() >= self.weather.incident:
            return []
        return self._incident(up)

    def _turn(self) -> list[Incident]:
        """Another weather: a storm is followed by a calm, in which all that was done is undone, or by another storm."""
        chance = self._chance
        if self.weather is not CALM and chance.random() < 0.4:
            self.weather, self._left, self.sides = CALM, RECOVERY + int(chance.integers(10, 30)), 0 * self.sides
            return [Incident("mend", process, 0.0) for process in range(self._processes)]
        rates = chance.random(7) * (1.5, 0.4, 0.3, 0.2, 0.3, 0.3, 0.08)
        self.weather = Weather(*(rates * (chance.random(7) < 0.8)).tolist())
        self._left = int(chance.integers(20, 150))
        return []

    def _incident(self, up: list[int]) -> list[Incident]:
        chance = self._chance
        kind = str(chance.choice(("freeze", "freeze", "restart", "clock", "clock", "cut", "heal", "kill")))
        process = int(chance.choice(up))
        if kind in ("cut", "heal"):
            self.sides = chance.integers(0, 2, self._processes) * (kind == "cut")
            return []
        if kind == "kill":
            self._kills -= 1
            return [Incident(kind, process, 0.0)] if self._kills >= 0 and len(up) > 2 else []
        if kind == "clock":
            off = float(chance.uniform(-FURTHEST, FURTHEST) if chance.random() < 0.3 else chance.normal(0.0, 0.3))
            return [Incident(kind, process, off)]
        return [Incident(kind, process, float(chance.integers(1, 40)))]

    def fates(self, messages: int) -> Fates:
        """What becomes of so many messages."""
        weather, shape = self.weather, (messages, self._processes)
        dropped, copies, damaged, delays = self._chance.random((4, *shape))
        delays *= 2 * weather.delay
        np.square(delays, out=delays, where=delays > weather.delay)  # some overtake others
        delays[dropped < weather.drop] = -1.0
        return Fates(delays, np.where(copies < weather.copy, 3.0 * copies, -1.0), damaged < weather.damage)

    def damage(self, data: bytes) -> bytes:
        """A message with one byte changed, or cut short: what a checksum must see."""
        place = int(self._chance.integers(len(data)))
        if self._chance.random() < 0.2:
            return data[:place]
        return data[:place] + bytes([data[place] ^ int(self._chance.integers(1, 256))]) + data[place + 1 :]

    def noise(self, now: int, time_step: float, told: Any) -> tuple[bytes, str]:
        """A message that nobody of the fleet said, and what must be thought of it."""
        kind = int(self._chance.integers(5))
        report = Report(0, 1.0, 2.0, 0.0, 0.0, True, told, now * time_step)
        if kind == 0:
            return self._chance.bytes(int(self._chance.integers(0, 200))), "damaged"
        if kind == 1:
            data = report.to_bytes()[:-4].replace(np.float64(1.0).tobytes(), np.float64(math.nan).tobytes())
            return data + zlib.crc32(data).to_bytes(4, "little"), "damaged"
        if kind == 2:
            return report._replace(id=self._agents + int(self._chance.integers(9))).to_bytes(), "strange"
        off = -(now + 1.0) if kind == 3 else 0.5
        return report._replace(time=(now + off) * time_step).to_bytes(), "strange"

    def happens(self, chance: float) -> bool:
        """Whether something of this chance happens."""
        return bool(chance > 0.0 and self._chance.random() < chance)

    def one_of(self, number: int) -> int:
        """One of so many."""
        return int(self._chance.integers(number))
