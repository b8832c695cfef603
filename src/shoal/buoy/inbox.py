"""What a mesh brings: reports by step and speaker; late, repeated, reordered, damaged and strange ones are counted."""

from collections import Counter
from collections.abc import Collection

from shoal.core.errors import MessageError
from shoal.core.messages import Report

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
    counts : how many reports were new, and how many late, duplicate, reordered, early, damaged or strange; reordered
        ones are new, too, all others were dropped
    """

    def __init__(self, agents: int, told: tuple[str, ...], time_step: float, kept: int) -> None:
        self.counts: Counter[str] = Counter()
        self._agents = agents
        self._told = told
        self._time_step = time_step
        self._kept = kept
        self._said: dict[int, dict[int, Report]] = {}
        self._last: dict[int, int] = {}

    def put(self, data: bytes, now: int) -> None:
        """Keep a report that arrived, or count why not; nothing that arrives raises an error.

        Parameters
        ----------
        data : what arrived
        now : number of the step that it arrived in
        """
        try:
            report = Report.from_bytes(data, self._told)
        except MessageError:
            self.counts["damaged"] += 1
            return
        steps = report.time / self._time_step
        if report.id >= self._agents or not 0.0 <= steps < 2**53 or abs(steps - round(steps)) > 1e-3:
            self.counts["strange"] += 1
            return
        step = self.step_of(report)
        if step > now + AHEAD:
            self.counts["early"] += 1
        elif step < max(0, now - self._kept):
            self.counts["late"] += 1
        elif report.id in self._said.setdefault(step, {}):
            self.counts["duplicate"] += 1
        else:
            self._said[step][report.id] = report
            self.counts["new"] += 1
            self.counts["reordered"] += step < self._last.get(report.id, 0)
            self._last[report.id] = max(step, self._last.get(report.id, 0))

    def step_of(self, report: Report) -> int:
        """The step at which a report was said."""
        return round(report.time / self._time_step)

    def forget(self, now: int) -> None:
        """Drop what nobody will ask for from a step on."""
        for step in [step for step in self._said if step < now - self._kept]:
            del self._said[step]

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
