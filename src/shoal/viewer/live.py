"""One run that goes on while its scenario changes, as pages see it: its frames, its numbers and its scenes."""

from typing import Any

from shoal.core.links import link_bytes
from shoal.run.settings import Settings, Table
from shoal.run.simulation import Simulation
from shoal.run.steered import SteeredRun
from shoal.viewer.conditions import comings_and_goings
from shoal.viewer.frame import FULL, pack
from shoal.viewer.gauging import Gauging
from shoal.viewer.geography import geography_of
from shoal.viewer.measures import Measures
from shoal.viewer.scene import as_json, scene_of


class LiveRun(SteeredRun):
    """A run of the scenario that a raw table describes.

    Same table and same changes at the same steps: same bits.

    Attributes
    ----------
    place : 0, or 1 of the second of two runs side by side
    simulation : the run; its scenario is the current one
    since : the step at which its sums began
    message : the current scene, as the page gets it
    measures : its metrics, to be charted
    """

    def __init__(
        self, table: Table, place: int = 0, *, where: str = "scenario", text: str = "", recorded: bool = False
    ) -> None:
        self.place = place
        self._epoch = -1
        super().__init__(Settings.of(table, where=where, text=text), recorded=recorded)

    @property
    def ends(self) -> int | None:
        """The step from which no target will be there any more: where all recorded tracks are over; None if never."""
        scenario = self.simulation.scenario
        if any(target.kind != "track" for target in scenario.targets):
            return None
        return int(self.simulation.tracks.time.max() / scenario.time_step) + 1

    def frame(self) -> bytes:
        """The bytes of the current frame."""
        shown = self.simulation.look()
        gauges = self._gauging.of(self.simulation, shown)
        lean = self.simulation.scenario.agents > FULL
        return pack(shown, 0, run=self.place, epoch=self._epoch, gauges=gauges, lean=lean)

    def numbers(self) -> str:
        """What the metrics are now, as the page gets it."""
        values = self.measures.values(self.simulation)
        return as_json({"type": "numbers", "run": self.place, "step": self.simulation.number, "values": values})

    def _settle(self, simulation: Simulation, before: Simulation | None) -> None:
        scenario = simulation.scenario
        if before is None:
            self._gauging = Gauging(scenario)
        else:
            self._gauging.begin_anew(before, scenario)
        super()._settle(simulation, before)
        self.measures = Measures(scenario)
        self._epoch += 1
        self.since = simulation.number
        agents = scenario.agents
        scene: dict[str, Any] = scene_of(
            scenario,
            simulation.memory_fields,
            has_links=link_bytes(agents) > 0,
            epoch=self._epoch,
            since=self.since,
            events=comings_and_goings(simulation.swarm.joins[:agents], simulation.swarm.leaves[:agents]),
            ends=self.ends,
            geography=geography_of(simulation.scenario),
        )
        scene["series"] = self.measures.told()
        self.message = as_json({"type": "scene", "run": self.place, "scene": scene})
