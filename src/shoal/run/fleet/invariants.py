"""What must be true of a fleet at every step, worked out from what was done to it and not from what it did."""

import math
from collections import Counter
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.buoy.inbox import Inbox
from shoal.buoy.tether import Commands, Tick
from shoal.core.messages import Report
from shoal.core.wire import wire_dtype
from shoal.run.fleet.vessel import Thought
from shoal.run.fleet.virtual_mesh import Parcel

AHEAD = 2  # steps that a report may be ahead of a listener's clock: of the rule, not of its code
Truth = tuple[Any, ...]


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


def truths(said: list[bytes], tick: Tick, told: tuple[str, ...], time_step: float) -> list[Truth]:
    """What reports say, which must be what the instruments do, at this step.

    Raises
    ------
    BrokenInvariantError : another number of reports, another content or another time
    """
    demand("every buoy speaks", len(said), len(tick.readings))
    kind = wire_dtype(told)
    demand("every report has its size", {len(each) for each in said} or {kind.itemsize}, {kind.itemsize})
    rows = np.frombuffer(b"".join(said), kind).tolist()
    found = [(*row[1:2], *row[3:8], tuple(row[8]) if told else ()) for row in rows]
    demand("reports say what instruments do", [each[:6] for each in found], [row[:6] for row in tick.readings.tolist()])
    demand("reports say when", {round(row[2] / time_step, 6) for row in rows}, {float(tick.step)})
    return found


class Ear:
    """What one process must have heard, from the parcels that reached it since it started.

    Parameters
    ----------
    agents : N; kept : steps for which a report counts; max_age : steps that it may be old to be heard
    """

    def __init__(self, agents: int, kept: int, max_age: int) -> None:
        self.counts: Counter[str] = Counter()
        self._agents, self._kept, self._max_age = agents, kept, max_age
        self._said: dict[int, dict[int, Truth]] = {}
        self._last: dict[int, int] = {}

    def take(self, parcels: list[Parcel], now: int) -> None:
        """Think of each parcel what the rule says."""
        words: list[str] = []
        for parcel in parcels:
            truth, step = parcel.truth, parcel.step
            if truth is None:
                words.append(parcel.word)
                continue
            speaker: Any = truth[0]
            said = self._said.setdefault(step, {})
            if step > now + AHEAD:
                words.append("early")
            elif step < now - self._kept:
                words.append("late")
            elif speaker in said:
                words.append("duplicate")
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

    def hears(self, spoken: int, present: npt.NDArray[np.bool_] | None) -> list[Truth]:
        """The newest of each speaker within the age rule, in the order of speakers; who is not present is not heard."""
        found: dict[int, Truth] = {}
        for step in range(max(0, spoken - self._max_age), spoken + 1):
            found |= self._said.get(step, {})
        return [found[id] for id in sorted(found) if present is None or present[id]]

    def check_thoughts(self, tick: Tick, spoken: int, thoughts: list[Thought], neighbors: int, time_step: float) -> int:
        """Every buoy decided on its own reading, and on exactly the reports of the k nearest of those it hears.

        Returns
        -------
        of how many buoys reports could be heard

        Raises
        ------
        BrokenInvariantError : it decided on anything else
        """
        rows = tick.readings.tolist()
        demand("every buoy decides", [each.me.id for each in thoughts], [row[0] for row in rows])
        heard = self.hears(spoken, tick.alive if spoken == tick.step else None)
        ids = np.array([each[0] for each in heard], int)
        x = np.array([each[1] for each in heard])
        y = np.array([each[2] for each in heard])
        own_x, own_y = tick.readings["x"][:, None], tick.readings["y"][:, None]
        square = (own_x - x) * (own_x - x) + (own_y - y) * (own_y - y)
        square[ids == tick.readings["id"][:, None]] = np.inf
        if tick.hears is not None:
            square[~tick.hears[:, ids]] = np.inf
        order = np.argsort(square, axis=1, kind="stable")[:, :neighbors]
        reached = np.take_along_axis(square, order, axis=1) < np.inf
        nearest = np.sort(np.where(reached, order, -1), axis=1).tolist()
        time = tick.step * time_step
        for n, thought in enumerate(thoughts):
            me = thought.me
            if (thought.step, me.time, me[1:6]) != (tick.step, time, rows[n][1:6]):
                demand("a buoy goes by its own clock", (thought.step, me.time), (tick.step, time))
                demand("a buoy believes its instruments", me[1:6], rows[n][1:6])
            wanted = [heard[place] for place in nearest[n] if place >= 0]
            found = [each[:7] for each in thought.heard]
            if found != wanted:
                _accuse(thought, wanted, neighbors, (spoken - self._max_age, spoken), time_step)
        return len(heard)


def _accuse(thought: Thought, wanted: list[Truth], k: int, steps: tuple[int, int], time_step: float) -> None:
    """Say what is wrong with the reports that a buoy decided on."""
    heard: list[Report] = thought.heard
    ids = [report.id for report in heard]
    found = [round(report.time / time_step) for report in heard]
    who = f"buoy {thought.me.id} in step {thought.step}"
    if thought.me.id in ids:
        raise BrokenInvariantError("nobody hears itself", who)
    if len(heard) > k:
        raise BrokenInvariantError("at most k are heard", f"{who} heard {len(heard)}, k is {k}")
    if found and max(found) > steps[1]:
        raise BrokenInvariantError("nothing is heard from the future", f"{who} heard step {max(found)}")
    if found and min(found) < steps[0]:
        raise BrokenInvariantError("nothing is heard that is too old", f"{who} heard step {min(found)}")
    if ids != [truth[0] for truth in wanted]:
        raise BrokenInvariantError("the k nearest that can be heard are", f"{who} heard {ids}, not {wanted}"[:400])
    raise BrokenInvariantError("what is heard is what was said", f"{who} heard {heard}, not {wanted}"[:400])


def check_commands(commands: Commands, thoughts: list[Thought], under: dict[int, str]) -> None:
    """What goes to the bodies is what was decided, or what a buoy wants under an order, and finite.

    Raises
    ------
    BrokenInvariantError : it is not
    """
    demand("commands are decisions", commands.ids.tolist(), [each.me.id for each in thoughts])
    for wants, each in zip(commands.wants.tolist(), thoughts, strict=True):
        order = under.get(each.me.id, "resume")
        if order == "hold":
            demand("who holds wants nothing", wants, [0.0, 0.0])
        elif order == "recall":
            demand("nobody comes home faster than its make", math.hypot(*wants) <= each.me.max_speed + 1e-9, True)
        else:
            demand("commands are decisions", wants, list(each.wants))
    if not np.isfinite(commands.wants).all():
        raise BrokenInvariantError("every number is finite", f"wanted are {commands.wants}"[:300])
