"""What a process must have heard, worked out from the parcels that reached it and not from what it says."""

from collections import Counter
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.buoy.inbox import Inbox
from shoal.buoy.tether import Tick
from shoal.run.fleet.invariants import CONTENT, BrokenInvariantError, demand
from shoal.run.fleet.virtual_mesh import Parcel

AHEAD = 2  # steps that a report may be ahead of a listener's clock: of the rule, not of its code


class Heard(NamedTuple):
    """What n buoys of a process can have heard.

    tables : (q, N + 1, 7 + T) what each of N speakers said, in the order of CONTENT, and nobody at the end; not numbers
        where it is not heard
    table : (n,) which of them is each buoy's; reached : (n, N) whose reports reach each, None: everybody's
    """

    tables: npt.NDArray[np.float64]
    table: npt.NDArray[np.int64]
    reached: npt.NDArray[np.bool_] | None


class Ear:
    """What one process must have heard, from the parcels that reached it since it started.

    Parameters
    ----------
    agents : N; told : fields that reports tell, T
    kept : steps for which a report counts; max_age : steps that it may be old to be heard
    """

    def __init__(self, agents: int, told: int, kept: int, max_age: int) -> None:
        self.counts: Counter[str] = Counter()
        self._agents, self._columns = agents, len(CONTENT) + told
        self._kept, self._max_age = kept, max_age
        self._said: dict[int, dict[int, bytes]] = {}
        self._last: dict[int, int] = {}

    def take(self, parcels: list[Parcel], now: int) -> None:
        """Think of each parcel what the rule says."""
        words: list[str] = []
        oldest, newest = now - self._kept, now + AHEAD
        for _, speaker, truth, step, word in parcels:
            if speaker is None:
                words.append(word)
            elif step > newest:
                words.append("early")
            elif step < oldest:
                words.append("late")
            elif speaker in (said := self._said.setdefault(step, {})):
                words.append("duplicate" if said[speaker] == truth else "changed")
                said[speaker] = truth
            else:
                said[speaker] = truth
                words.append("new")
                if step < self._last.get(speaker, 0):
                    words.append("reordered")
                else:
                    self._last[speaker] = step
        self.counts.update(words)

    def check_counts(self, inbox: Inbox) -> None:
        """An inbox counts everything that arrived once, as what it is.

        Raises
        ------
        BrokenInvariantError : another count
        """
        demand("what arrives is counted", dict(inbox.counts), dict(self.counts))

    def check_kept(self, inbox: Inbox) -> None:
        """After a decision an inbox keeps no more than the next one needs.

        Raises
        ------
        BrokenInvariantError : too much kept
        """
        if len(inbox._said) > self._kept + 1 + AHEAD:
            raise BrokenInvariantError("an inbox stays small", f"it keeps reports of {len(inbox._said)} steps")

    def forget(self, now: int) -> None:
        """Drop what is too old from a step on."""
        for step in [step for step in self._said if not now - self._kept <= step <= now + AHEAD]:
            del self._said[step]

    def hears(self, tick: Tick, spoken: int) -> Heard:
        """The newest of each speaker within the age rule; who is not present is not heard."""
        found: dict[int, bytes] = {}
        for step in range(max(0, spoken - self._max_age), spoken + 1):
            found |= self._said.get(step, {})
        table = self._nobody()
        if found:
            table[list(found)] = np.frombuffer(b"".join(found.values())).reshape(len(found), -1)
        if spoken == tick.step:
            table[:-1][~tick.alive] = np.nan
        listeners = len(tick.readings)
        return Heard(table[None], np.zeros(listeners, int), tick.hears)

    def _nobody(self) -> npt.NDArray[np.float64]:
        return np.full((self._agents + 1, self._columns), np.nan)


class KeptEar(Ear):
    """The same where a scenario keeps reports (network.max_age): each buoy has what reached it, the dead's too."""

    def __init__(self, agents: int, told: int, kept: int, max_age: int) -> None:
        super().__init__(agents, told, kept, max_age)
        self._reached: list[tuple[int, int, npt.NDArray[np.bool_]]] = []  # step, listener, speakers

    def hears(self, tick: Tick, spoken: int) -> Heard:
        """The newest report in the window of the age rule of those that reached each buoy."""
        listeners = tick.readings["id"].tolist()
        everywhere = [tick.alive] * len(listeners)
        reach = everywhere if tick.hears is None else tick.hears
        self._reached = [each for each in self._reached if each[0] >= spoken - self._max_age]
        self._reached += [(spoken, id, row) for id, row in zip(listeners, reach, strict=True)]
        tables = np.stack([self._nobody() for _ in listeners])
        for step in range(max(0, spoken - self._max_age), spoken + 1):  # later ones are newer
            said = self._said.get(step, {})
            for n, listener in enumerate(listeners):
                rows = [row for then, id, row in self._reached if (then, id) == (step, listener)]
                for speaker in [speaker for speaker in said if any(row[speaker] for row in rows)]:
                    tables[n, speaker] = np.frombuffer(said[speaker])
        return Heard(tables, np.arange(len(listeners)), None)
