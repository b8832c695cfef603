"""What a mesh brings: reports by step and speaker; late, repeated, reordered, damaged and strange ones are counted."""

from collections import Counter
from collections.abc import Collection

from shoal.core.errors import MessageError
from shoal.core.messages import Report
from shoal.core.wire import VERSION, wire_bytes

AHEAD = 2  # steps that a report may be ahead of us: clocks differ, and others may be a step further


class Inbox:
    """The reports that arrived, each once, as long as somebody may still ask for them.

    Parameters
    ----------
    agents : N; reports of others than 0 to N - 1 are strange
    told : names of the fields that reports tell; Buoy.told
    time_step : [s]
    kept : steps for which a report is kept

    Attributes
    ----------
    counts : how many reports were new, and how many late, duplicate, changed, reordered, early, damaged or strange;
        reordered ones are new, too, and changed ones took the place of what their speaker had said of the same step, by
        a clock that was ahead; all others were dropped
    foreign : how many of all these were said by others under a number of this process, of steps at which it spoke
    """

    def __init__(self, agents: int, told: tuple[str, ...], time_step: float, kept: int) -> None:
        self.counts: Counter[str] = Counter()
        self.foreign = 0
        self._size = wire_bytes(len(told))
        self._own: dict[tuple[int, int], set[bytes]] = {}
        self._agents = agents
        self._told = told
        self._time_step = time_step
        self._kept = kept
        self._said: dict[int, dict[int, Report]] = {}
        self._last: dict[int, int] = {}

    def put(self, data: bytes, now: int) -> Report | None:
        """Keep a report that arrived, or count why not; nothing that arrives raises an error.

        Returns
        -------
        the report if it is kept, now or since before, else None

        Parameters
        ----------
        data : what arrived
        now : number of the step that it arrived in
        """
        if len(data) != self._size or data[0] != VERSION:  # garbage must cost nothing
            self.counts["damaged"] += 1
            return None
        try:
            report = Report.from_bytes(data, self._told)
        except MessageError:
            self.counts["damaged"] += 1
            return None
        counts, id, steps = self.counts, report.id, report.time / self._time_step
        if id >= self._agents or not 0.0 <= steps < 2**53 or abs(steps - round(steps)) > 1e-3:
            counts["strange"] += 1
            return None
        step = round(steps)
        self.foreign += (step, id) in self._own and data not in self._own[step, id]
        if step > now + AHEAD:
            counts["early"] += 1
        elif step < max(0, now - self._kept):
            counts["late"] += 1
        elif id in (said := self._said.setdefault(step, {})):
            known, said[id] = said[id], report
            counts["duplicate" if known == report else "changed"] += 1
            return report if known == report else None
        else:
            said[id] = report
            last = self._last.get(id, 0)
            counts["new"] += 1
            counts["reordered"] += step < last
            self._last[id] = max(step, last)
        return report if self._said.get(step, {}).get(id) == report else None

    def spoke(self, id: int, step: int, data: bytes) -> None:
        """Note what a buoy of this process says itself at a step: all else under its number is another's."""
        self._own.setdefault((step, id), set()).add(data)

    def step_of(self, report: Report) -> int:
        """The step at which a report was said."""
        return round(report.time / self._time_step)

    def forget(self, now: int) -> None:
        """Drop what nobody will ask for from a step on, and what was heard by a clock that was ahead."""
        for step in [step for step in self._said if step < now - self._kept or step > now + AHEAD]:
            del self._said[step]
        for step, id in [key for key in self._own if key[0] < now - self._kept or key[0] > now + AHEAD]:
            del self._own[step, id]

    def of(self, step: int) -> dict[int, Report]:
        """What was said at a step, as far as it arrived, by speaker."""
        return self._said.get(step, {})

    def missing(self, step: int, speakers: Collection[int]) -> set[int]:
        """Of those who speak at a step, whose reports have not arrived."""
        return set(speakers) - self.of(step).keys()

    def newest(self, step: int, max_age: int) -> dict[int, Report]:
        """The newest report of each speaker that was said at a step or at most `max_age` steps before it."""
        found: dict[int, Report] = {}
        for then in range(max(0, step - max_age), step + 1):
            found |= self.of(then)
        return found
