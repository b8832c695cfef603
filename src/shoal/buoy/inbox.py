"""What a mesh brings: reports by step and speaker; late, repeated, reordered, damaged and strange ones are counted."""

from collections import Counter
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from shoal.buoy.rows import ID, TIME, read

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
        self._own: dict[tuple[int, int], set[bytes]] = {}
        self._agents = agents
        self._told = told
        self._time_step = time_step
        self._kept = kept
        self._said: dict[int, dict[int, bytes]] = {}
        self._last: dict[int, int] = {}

    def put(self, messages: Sequence[bytes], now: int) -> list[str]:
        """Keep reports that arrived, or count why not; nothing that arrives raises an error.

        Parameters
        ----------
        messages : what arrived, in its order
        now : number of the step that it arrived in

        Returns
        -------
        what each is in a word of `counts`
        """
        if not messages:
            return []
        numbers, sound = read(messages, self._told)
        with np.errstate(over="ignore", invalid="ignore"):
            times = numbers[:, TIME] / self._time_step
            steps = np.rint(times)
            ours = sound & (numbers[:, ID] < self._agents)
            ours &= (times >= 0.0) & (times < 2**53) & (abs(times - steps) <= 1e-3)
        ids, steps = np.where(ours, (numbers[:, ID], steps), -1.0).astype(int).tolist()
        rows, size = numbers.tobytes(), numbers.itemsize * numbers.shape[1]
        oldest, newest = max(0, now - self._kept), now + AHEAD
        words: list[str] = []
        for n, (id, step) in enumerate(zip(ids, steps, strict=True)):
            if id < 0:
                words.append("strange" if sound[n] else "damaged")
                continue
            own = self._own.get((step, id))
            self.foreign += own is not None and messages[n] not in own
            if step > newest:
                words.append("early")
            elif step < oldest:
                words.append("late")
            else:
                words.append(self._keep(id, step, rows[n * size : (n + 1) * size]))
        self.counts.update(words)
        return words

    def _keep(self, id: int, step: int, row: bytes) -> str:
        """Keep what somebody said at a step that may still be asked for; what it is in a word."""
        said = self._said.setdefault(step, {})
        before = said.get(id)
        said[id] = row
        if before is not None:
            return "duplicate" if before == row else "changed"
        last = self._last.get(id, 0)
        if step < last:
            self.counts["reordered"] += 1
        else:
            self._last[id] = step
        return "new"

    def spoke(self, id: int, step: int, data: bytes) -> None:
        """Note what a buoy of this process says itself at a step: all else under its number is another's."""
        self._own.setdefault((step, id), set()).add(data)

    def source(self, report: bytes) -> tuple[int, int]:
        """Who said a report that is in it, and at which step."""
        ((id, time),) = read([report], self._told)[0][:, [ID, TIME]].tolist()
        return int(id), round(time / self._time_step)

    def forget(self, now: int) -> None:
        """Drop what nobody will ask for from a step on, and what was heard by a clock that was ahead."""
        for step in [step for step in self._said if step < now - self._kept or step > now + AHEAD]:
            del self._said[step]
        for step, id in [key for key in self._own if key[0] < now - self._kept or key[0] > now + AHEAD]:
            del self._own[step, id]

    def of(self, step: int) -> Mapping[int, bytes]:
        """What was said at a step, as far as it arrived, by speaker: rows, see buoy/rows.py."""
        return self._said.get(step, {})

    def missing(self, step: int, speakers: Collection[int]) -> set[int]:
        """Of those who speak at a step, whose reports have not arrived."""
        return set(speakers) - self.of(step).keys()

    def newest(self, step: int, max_age: int) -> dict[int, bytes]:
        """The newest that each speaker said at a step or at most `max_age` steps before it: rows."""
        found: dict[int, bytes] = {}
        for then in range(max(0, step - max_age), step + 1):
            found |= self.of(then)
        return found

    def when(self, step: int, max_age: int) -> dict[int, int]:
        """The step at which each speaker said the newest, as `newest` has it."""
        found: dict[int, int] = {}
        for then in range(max(0, step - max_age), step + 1):
            found |= dict.fromkeys(self.of(then), then)
        return found
