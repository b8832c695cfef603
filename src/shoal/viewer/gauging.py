"""The numbers beside the frames of a run as it goes, whose sums may begin anew on the way."""

import math
from collections import deque
from typing import NamedTuple

from shoal.record.course import value_of
from shoal.record.frames import moment_of
from shoal.record.trajectory import Trajectory
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation
from shoal.scenario.schema import Scenario
from shoal.viewer.frame import RECENT, Gauges


class _Mark(NamedTuple):
    """Sums of all steps before a step."""

    step: int
    present: float
    on_target: float


class Gauging:
    """Reads gauges off a run of a scenario, in the order of its steps."""

    def __init__(self, scenario: Scenario) -> None:
        self._facts = facts_of(scenario)
        self._before = _Mark(0, 0.0, 0.0)
        self._marks: deque[_Mark] = deque()

    def begin_anew(self, before: Simulation, scenario: Scenario) -> None:
        """Note what was counted, before a run goes on as another, whose sums are empty."""
        self._before = self._sums(before)
        self._facts = facts_of(scenario)

    def of(self, simulation: Simulation, shown: Trajectory) -> Gauges:
        """The gauges of a frame that a run would keep now."""
        tally, facts = simulation.tally, self._facts
        moment = moment_of(shown, 0, facts)
        return Gauges(
            time_on_target=value_of("time_on_target", tally, facts),
            recent=self._recent(simulation),
            xi=value_of("xi", tally, facts),
            xi_now=moment.xi,
            engaged=float(shown.engaged.sum()),
            phi=moment.phi.sum(axis=0),
        )

    def _sums(self, simulation: Simulation) -> _Mark:
        tally = simulation.tally
        present = self._before.present + float(tally.present.sum())
        return _Mark(simulation.number, present, self._before.on_target + float(tally.on_target.sum()))

    def _recent(self, simulation: Simulation) -> float:
        """Time on target over the last 1,000 steps, or since the last frame looked at before that."""
        now = self._sums(simulation)
        if not self._marks or self._marks[-1].step < now.step:
            self._marks.append(now)
        while len(self._marks) > 1 and self._marks[1].step <= now.step - RECENT:
            self._marks.popleft()
        then = self._marks[0]
        present = now.present - then.present
        return (now.on_target - then.on_target) / present if present > 0 else math.nan
