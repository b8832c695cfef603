"""What a fleet's log keeps, as bulletins for all who watch: as many a second as anybody can see."""

import time
from collections.abc import Callable, Collection, Sequence

from shoal.core.links import link_bytes
from shoal.record.charted import FIRST, describe_metric
from shoal.record.trajectory import Trajectory
from shoal.run.simulation import Simulation
from shoal.scenario.crew import crew_of
from shoal.scenario.schema import Scenario
from shoal.viewer.bulletin import Bulletin
from shoal.viewer.frame import pack
from shoal.viewer.gauging import Gauging
from shoal.viewer.scene import scene_of

EVERY = 0.04  # [s] between two bulletins, at least


class Feed:
    """Tells those who watch a fleet what goes on in it; `see` is called by the fleet, which waits for nobody.

    Parameters
    ----------
    scenario : of the fleet
    speed : times real time; None: a step takes as long as it takes
    tell : who are told every bulletin, and must be quick
    """

    def __init__(self, scenario: Scenario, speed: float | None, tell: Sequence[Callable[[Bulletin], None]]) -> None:
        self._tell = tell
        self._gauging = Gauging(scenario)
        self._due = 0.0
        scene = scene_of(scenario, crew_of(scenario).memory, has_links=link_bytes(scenario.agents) > 0)
        scene["series"] = [describe_metric(name) for name in FIRST]
        origin = scenario.area.origin
        self._newest = Bulletin(scene, None if origin is None else (origin[0], origin[1]), speed, None, b"")

    def say(self, sentence: str | None) -> None:
        """Say why nothing goes on; None: it does."""
        self._newest = self._newest._replace(busy=sentence)
        for tell in self._tell:
            tell(self._newest)

    def see(self, simulation: Simulation, frame: Trajectory, silent: Collection[int]) -> None:
        """See the frame that a step begins with, before it is done."""
        now = time.monotonic()
        if now < self._due:
            return
        self._due = now + EVERY
        gauges = self._gauging.of(simulation, frame)
        self._newest = self._newest._replace(frame=pack(frame, 0, run=0, epoch=0, gauges=gauges, silent=silent))
        self.say(None if simulation.number else self._newest.busy)  # step 0 is shown while buoys start
