"""The steersman of a session: changes its runs, logs that, and makes the changes of a log when their steps come."""

from collections import deque
from collections.abc import Callable, Sequence

from shoal.core.errors import ScenarioError
from shoal.run.change_log import MOST, ChangeLog, Entry, Logged
from shoal.run.changes import Change, Drag, Restart, Steering
from shoal.scenario.crew import crew_of
from shoal.viewer.live import LiveRun


class Steersman:
    """Steers runs that are in step with each other.

    Parameters
    ----------
    runs : one, or two side by side
    names : what they are called
    script : a log whose changes are made when their steps come; until its end nobody else can change anything
    busy : called with a sentence while a strategy is compiled, and with None when that is done

    Attributes
    ----------
    script_end : the step until which changes come from the script; None: from whoever asks
    """

    def __init__(
        self,
        runs: Sequence[LiveRun],
        names: Sequence[str],
        script: ChangeLog | None,
        busy: Callable[[str | None], None],
    ) -> None:
        self._runs = runs
        self._busy = busy
        began = zip(names, runs, strict=False)
        self._began = tuple(Logged(name, run.table, run.simulation.scenario.hash) for name, run in began)
        self._entries: list[Entry] = []
        self._script = deque(script.entries if script else ())
        self.script_end = script.last if script else None
        self._loaded = {run.simulation.crew.name for run in runs}

    @property
    def changes(self) -> int:
        """How many changes were made."""
        return len(self._entries)

    @property
    def log(self) -> ChangeLog:
        """What was run, and how it was changed until now."""
        return ChangeLog(self._began, tuple(self._entries), self._runs[0].simulation.number)

    def run(self, place: int) -> LiveRun:
        """Return a run by its place.

        Raises
        ------
        ScenarioError : there is none
        """
        if not 0 <= place < len(self._runs):
            raise ScenarioError("run", f"is {place}", f"name one from 0 to {len(self._runs) - 1}")
        return self._runs[place]

    def obey(self, steering: Steering) -> None:
        """Do what somebody asks for.

        Raises
        ------
        ScenarioError, StrategyError : it cannot be done; then nothing has changed
        """
        if self.script_end is not None:
            problem = f"the changes of a log are made until step {self.script_end:,}"
            raise ScenarioError("request", problem, "wait until then, or watch without --replay-changes")
        if len(self._entries) >= MOST:
            raise ScenarioError("request", f"{MOST:,} changes were made, the most that a log holds", "watch anew")
        self._steer(steering)

    def advance(self, until: int) -> bool:
        """Go to a step, and make what changes a script has on the way; return whether a script restarted the runs."""
        restarted = False
        while self._script and self._script[0].step <= until:
            self._go_to(self._script[0].step)
            steering = self._script.popleft().steering
            self._steer(steering)
            if isinstance(steering, Restart):
                until, restarted = 0, True
        self._go_to(until)
        return restarted

    def end_script(self) -> bool:
        """Let others steer where the script has ended; return whether it ended just now."""
        ends = self.script_end is not None and not self._script and self._number >= self.script_end
        if ends:
            self.script_end = None
        return ends

    def stop_of_script(self) -> int | None:
        """The step at which the script ends, if no restart comes before."""
        return None if any(isinstance(each.steering, Restart) for each in self._script) else self.script_end

    @property
    def _number(self) -> int:
        return self._runs[0].simulation.number

    def _go_to(self, step: int) -> None:
        for run in self._runs:
            run.advance(max(0, step - run.simulation.number))

    def _steer(self, steering: Steering) -> None:
        """Change a run, or start all over, and log that."""
        step = self._number
        if isinstance(steering, Restart):
            for run in self._runs:
                run.restart(steering.seed)
        else:
            run = self.run(steering.run)
            try:
                if isinstance(steering, Change):
                    self._warn_of_loading(run, steering)
                run.steer(steering)
            finally:
                self._busy(None)
        if self._entries and _again(self._entries[-1], step, steering):
            self._entries.pop()
        self._entries.append(Entry(step, steering))

    def _warn_of_loading(self, run: LiveRun, change: Change) -> None:
        name = crew_of(run.scenario_with(change.changes)).name
        if name not in self._loaded:
            self._busy(f"loading strategy {name!r}; the very first time it is compiled, for some 10 s")
            self._loaded.add(name)


def _again(before: Entry, step: int, steering: Steering) -> bool:
    """Whether a target is dragged on at the same step: where it was put before makes no difference."""
    last = before.steering
    if not (isinstance(last, Drag) and isinstance(steering, Drag)):
        return False
    return before.step == step and (last.run, last.target) == (steering.run, steering.target)
