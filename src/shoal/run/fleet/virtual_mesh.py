"""A mesh in virtual time: messages are under way for as long as an adversary wants, if they arrive at all."""

import itertools
from bisect import bisect_left
from collections import Counter, deque
from typing import NamedTuple

import numpy as np

from shoal.run.fleet.adversary import Adversary


class Parcel(NamedTuple):
    """A message on its way.

    speaker : who said it, at a step by its own clock; None: it must not be believed
    truth : what was said, as numbers in the order of invariants.CONTENT, 8 bytes each
    word : what a listener must think of it if it is not believable
    """

    data: bytes
    speaker: int | None
    truth: bytes = b""
    step: int = 0
    word: str = ""


class VirtualMesh:
    """What all processes of a soak publish, on the way to each of them.

    Parameters
    ----------
    processes : P; adversary : who decides what becomes of messages

    Attributes
    ----------
    counts : of messages, once for each listener: `meant` for it and `more` that nobody meant; of these `dropped`, `cut`
        off, without a listener (`nobody`), `gone` with one, and `arrived`; all others are under way
    """

    def __init__(self, processes: int, adversary: Adversary) -> None:
        self.counts: Counter[str] = Counter()
        self._adversary = adversary
        self._under_way: list[list[tuple[float, int, Parcel]]] = [[] for _ in range(processes)]  # when, which, what
        self._listens = np.ones(processes, bool)
        self._kept: deque[Parcel] = deque(maxlen=400)
        self._number = 0

    def under_way(self) -> int:
        """How many have neither arrived nor been lost."""
        return sum(map(len, self._under_way))

    def publish(self, now: float, said: list[Parcel], senders: list[int]) -> None:
        """Send parcels to all processes, from those in `senders`."""
        adversary, counts = self._adversary, self.counts
        fates = adversary.fates(len(said))
        cut = adversary.sides[senders][:, None] != adversary.sides
        dropped = (fates.delays < 0.0) & ~cut
        nobody = ~self._listens & ~cut & ~dropped
        arrives = ~(cut | dropped | nobody)
        counts["meant"] += cut.size
        counts["cut"] += int(cut.sum())
        counts["dropped"] += int(dropped.sum())
        counts["nobody"] += int(nobody.sum())
        damaged = {(m, p): self._damaged(said[m]) for m, p in np.argwhere(fates.damaged & arrives).tolist()}
        for p, way in enumerate(self._under_way):
            theirs = np.flatnonzero(arrives[:, p])
            at = (now + fates.delays[theirs, p]).tolist()
            parcels = [damaged.get((m, p)) or said[m] for m in theirs.tolist()]
            way.extend(zip(at, itertools.count(self._number + 1), parcels))
            self._number += len(at)
        for m, p in np.argwhere((fates.copies >= 0.0) & arrives).tolist():
            self._more(p, now + float(fates.copies[m, p]), said[m])
        self._kept.extend(said[:: max(1, len(said) // 4)])

    def _damaged(self, parcel: Parcel) -> Parcel:
        return Parcel(self._adversary.damage(parcel.data), None, word="damaged")

    def disturb(self, now: int, time_step: float, told: tuple[float, ...]) -> None:
        """Let come what nobody says at this time: noise, and what was said long ago."""
        weather = self._adversary.weather
        for p in np.flatnonzero(self._listens).tolist():
            if self._adversary.happens(weather.noise):
                data, word = self._adversary.noise(now, time_step, told)
                self._more(p, now + 0.1, Parcel(data, None, word=word))
            if self._kept and self._adversary.happens(weather.again):
                self._more(p, now + 0.1, self._kept[self._adversary.one_of(len(self._kept))])

    def _more(self, listener: int, at: float, parcel: Parcel) -> None:
        self._number += 1
        self.counts["more"] += 1
        self._under_way[listener].append((at, self._number, parcel))

    def take(self, listener: int, until: float) -> list[Parcel]:
        """What arrives at a process before a time, in the order of arrival."""
        way = self._under_way[listener]
        way.sort()
        end = bisect_left(way, (until,))
        arrived = [parcel for _, _, parcel in way[:end]]
        del way[:end]
        self.counts["arrived"] += len(arrived)
        return arrived

    def listen(self, listener: int, listens: bool) -> None:
        """Let a process be there, or not: what is on its way to it then is gone."""
        if not listens:
            self.counts["gone"] += len(self._under_way[listener])
            self._under_way[listener].clear()
        self._listens[listener] = listens

    def broken(self) -> str | None:
        """What is wrong with the counts, if anything is."""
        counts = self.counts
        ended = sum(counts[word] for word in ("dropped", "cut", "nobody", "gone", "arrived"))
        if counts["meant"] + counts["more"] != ended + self.under_way():
            return f"{dict(counts)} and {self.under_way()} under way do not add up"
        return None
