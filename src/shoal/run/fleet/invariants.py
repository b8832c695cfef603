"""What must be true of a fleet at every step, worked out from what was done to it and not from what it did."""

import math
from collections import Counter
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.buoy.inbox import Inbox
from shoal.buoy.said import Said
from shoal.buoy.tether import Commands, Tick
from shoal.core.wire import wire_dtype
from shoal.run.fleet.vessel import Thought
from shoal.run.fleet.virtual_mesh import Parcel

AHEAD = 2  # steps that a report may be ahead of a listener's clock: of the rule, not of its code
CONTENT = ("id", "x", "y", "vx", "vy", "on_target", "time")  # of what was said, and then what is told


class BrokenInvariantError(AssertionError):
    """Something that must be true is not.

    Parameters
    ----------
    invariant : its name; detail : what was found instead
    """

    def __init__(self, invariant: str, detail: str) -> None:
        super().__init__(invariant, detail)
        self.invariant, self.detail = invariant, detail

    def __str__(self) -> str:
        return f"{self.invariant}: {self.detail}"


def demand(invariant: str, found: Any, wanted: Any) -> None:
    """Two things must be equal.

    Raises
    ------
    BrokenInvariantError : they are not
    """
    if found != wanted:
        raise BrokenInvariantError(invariant, f"{str(found)[:300]} instead of {str(wanted)[:300]}")


def truths(said: list[bytes], tick: Tick, told: tuple[str, ...], time_step: float) -> list[bytes]:
    """What reports say, as numbers, which must be what the instruments do, at this step.

    Raises
    ------
    BrokenInvariantError : another number of reports, another content or another time
    """
    demand("every buoy speaks", len(said), len(tick.readings))
    kind = wire_dtype(told)
    demand("every report has its size", {len(each) for each in said} or {kind.itemsize}, {kind.itemsize})
    rows = np.frombuffer(b"".join(said), kind)
    found = np.array([*(rows[name] for name in CONTENT), *(rows["told"][name] for name in told)]).T
    true = np.array([tick.readings[name] for name in CONTENT[:-1]]).T
    if not np.array_equal(found[:, : len(CONTENT) - 1], true):
        demand("reports say what instruments do", found.tolist(), true.tolist())
    demand("reports say when", set(np.round(found[:, len(CONTENT) - 1] / time_step, 6).tolist()), {float(tick.step)})
    return [row.tobytes() for row in found]


class Ear:
    """What one process must have heard, from the parcels that reached it since it started.

    Parameters
    ----------
    agents : N; kept : steps for which a report counts; max_age : steps that it may be old to be heard
    """

    def __init__(self, agents: int, kept: int, max_age: int) -> None:
        self.counts: Counter[str] = Counter()
        self._agents, self._kept, self._max_age = agents, kept, max_age
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
        demand("what arrives is counted", +inbox.counts, +self.counts)

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

    def hears(self, spoken: int, present: npt.NDArray[np.bool_] | None) -> npt.NDArray[np.float64]:
        """The newest of each speaker within the age rule, in the order of speakers; who is not present is not heard."""
        found: dict[int, bytes] = {}
        for step in range(max(0, spoken - self._max_age), spoken + 1):
            found |= self._said.get(step, {})
        rows = np.frombuffer(b"".join([found[id] for id in sorted(found)])).reshape(len(found), -1 if found else 7)
        return rows if present is None else rows[present[rows[:, 0].astype(int)]]

    def candidates(self, tick: Tick, spoken: int) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.bool_]]:
        """Reports in the order of speakers, a row each, and which of them reach each buoy, (n, M)."""
        heard = self.hears(spoken, tick.alive if spoken == tick.step else None)
        if tick.hears is None:
            return heard, np.ones((len(tick.readings), len(heard)), bool)
        return heard, tick.hears[:, heard[:, 0].astype(int)]

    def check_thought(
        self, tick: Tick, spoken: int, thought: Thought, neighbors: int, time_step: float
    ) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
        """Every buoy decided on its own reading, and on exactly the reports of the k nearest of those it hears.

        Returns
        -------
        the reports that could be heard, in the order of CONTENT, and (n, k) rows of neighbors in them; -1: no more

        Raises
        ------
        BrokenInvariantError : it decided on anything else
        """
        rows = tick.readings
        demand("every buoy decides", thought.ids, rows["id"].tolist())
        demand("a buoy goes by its own clock", thought.step, tick.step)
        demand("a buoy believes its instruments", thought.readings, [row[1:] for row in rows.tolist()])
        heard, reached = self.candidates(tick, spoken)
        ids, (x, y) = heard[:, 0].astype(int), heard[:, 1:3].T
        square = (rows["x"][:, None] - x) * (rows["x"][:, None] - x) + (rows["y"][:, None] - y) * (
            rows["y"][:, None] - y
        )
        square[ids == rows["id"][:, None]] = np.inf
        square[~reached] = np.inf
        nearest = np.argsort(square, axis=1, kind="stable")[:, :neighbors]
        count = np.count_nonzero(square < np.inf, axis=1)[:, None]
        nearest[np.arange(nearest.shape[1]) >= count] = len(heard)  # nobody's row, behind all others
        nearest.sort(axis=1)
        nearest[nearest == len(heard)] = -1
        content, found = _content(thought.said, heard.shape[1]), thought.near[:, :, 0]
        same = np.array_equal(np.count_nonzero(found >= 0, axis=1), np.count_nonzero(nearest >= 0, axis=1))
        if not same or not np.array_equal(content[found[found >= 0]], heard[nearest[nearest >= 0]]):
            steps = spoken - self._max_age, spoken
            for id, its, near in zip(thought.ids, found, nearest, strict=True):
                one, other = content[its[its >= 0]], heard[near[near >= 0]]
                if not np.array_equal(one, other):
                    _accuse(f"buoy {id} in step {tick.step}", one, other, neighbors, steps, time_step)
        return heard, nearest


class KeptEar(Ear):
    """The same where a scenario keeps reports (network.max_age): each buoy has what reached it, the dead's too."""

    def __init__(self, agents: int, kept: int, max_age: int) -> None:
        super().__init__(agents, kept, max_age)
        self._reached: list[tuple[int, int, npt.NDArray[np.bool_]]] = []  # step, listener, speakers

    def candidates(self, tick: Tick, spoken: int) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.bool_]]:
        """Every report in the window of the age rule, and which of them is the newest that reached each buoy."""
        listeners = tick.readings["id"].tolist()
        everywhere = [tick.alive] * len(listeners)
        reach = everywhere if tick.hears is None else tick.hears
        self._reached = [each for each in self._reached if each[0] >= spoken - self._max_age]
        self._reached += [(spoken, id, row) for id, row in zip(listeners, reach, strict=True)]
        window = range(max(0, spoken - self._max_age), spoken + 1)
        said = sorted((id, step) for step in window for id in self._said.get(step, {}))
        newest = np.zeros((len(listeners), len(said)), bool)
        for n, id in enumerate(listeners):
            mine: dict[int, int] = {}
            rows = [(step, row) for step, listener, row in self._reached if listener == id]
            for place, (speaker, step) in enumerate(said):  # later ones are newer
                if any(then == step and row[speaker] for then, row in rows):
                    mine[speaker] = place
            newest[n, list(mine.values())] = True
        truths = np.frombuffer(b"".join([self._said[step][id] for id, step in said]))
        return truths.reshape(len(said), -1 if said else 7), newest


def _content(said: Said, columns: int) -> npt.NDArray[np.float64]:
    """What is said in the order of CONTENT."""
    inbox, count = said.inbox, len(said.reports)
    content = np.empty((count, columns))
    content[:, 0], content[:, 1:5], content[:, 5] = inbox.id, inbox.numbers[:, :4], inbox.on_target
    content[:, 6], content[:, 7:] = inbox.numbers[:, 4], said.tells[:count, : columns - 7]
    return content


def _accuse(who: str, found: Any, wanted: Any, k: int, steps: tuple[int, int], time_step: float) -> None:
    """Say what is wrong with the reports that a buoy decided on."""
    ids, times = found[:, 0].astype(int).tolist(), np.round(found[:, 6] / time_step).tolist()
    if int(who.split()[1]) in ids:
        raise BrokenInvariantError("nobody hears itself", who)
    if len(found) > k:
        raise BrokenInvariantError("at most k are heard", f"{who} heard {len(found)}, k is {k}")
    if times and max(times) > steps[1]:
        raise BrokenInvariantError("nothing is heard from the future", f"{who} heard step {max(times):g}")
    if times and min(times) < steps[0]:
        raise BrokenInvariantError("nothing is heard that is too old", f"{who} heard step {min(times):g}")
    if ids != wanted[:, 0].tolist():
        raise BrokenInvariantError(
            "the k nearest that can be heard are", f"{who} heard {ids}, not {wanted[:, 0]}"[:400]
        )
    raise BrokenInvariantError("what is heard is what was said", f"{who} heard {found}, not {wanted}"[:400])


def check_commands(commands: Commands, thought: Thought, speeds: list[float], under: dict[int, str]) -> None:
    """What goes to the bodies is what was decided, or what a buoy wants under an order, and finite; so is the memory.

    Parameters
    ----------
    commands : of a process; thought : what it decided
    speeds : top speed of every agent [m/s]
    under : the order that an agent is under; who is not in it is under none

    Raises
    ------
    BrokenInvariantError : it is not
    """
    demand("commands are decisions", commands.ids.tolist(), thought.ids)
    for id, wants, decided in zip(thought.ids, commands.wants.tolist(), thought.wants, strict=True):
        order = under.get(id, "resume")
        if order == "hold":
            demand("who holds wants nothing", wants, [0.0, 0.0])
        elif order == "recall":
            demand("nobody comes home faster than its make", math.hypot(*wants) <= speeds[id] + 1e-9, True)
        else:
            demand("commands are decisions", wants, decided)
    demand("commands have the memory", list(map(tuple, commands.memory.tolist())), thought.after)
    if not np.isfinite(commands.wants).all():
        raise BrokenInvariantError("every number is finite", f"wanted are {commands.wants}"[:300])
