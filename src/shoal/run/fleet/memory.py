"""All buoys of a fleet in this process, on a mesh in memory: needs no library and waits for nothing."""

from shoal.buoy.aboard import Aboard
from shoal.buoy.mesh import MemoryMesh
from shoal.buoy.tether import BEGIN, Commands, Tick
from shoal.scenario.schema import Scenario


class InMemory:
    """A crowd of buoys that share one inbox.

    Parameters
    ----------
    scenario : of the fleet
    max_age : steps that a report may be old to be heard; default: the scenario's
    """

    def __init__(self, scenario: Scenario, max_age: int | None = None) -> None:
        self._aboard = Aboard(scenario, range(scenario.agents), max_age=max_age)
        self._mesh = MemoryMesh([])

    def ask(self, tick: Tick) -> tuple[list[Commands], list[int]]:
        """Let all buoys begin a step: what they want, and nobody is lost meanwhile."""
        if tick.turn == BEGIN:
            return [self._aboard.begin(tick)], []
        for report in self._aboard.speak(tick):
            self._mesh.publish(report)
        while messages := self._mesh.take(0.0):
            self._aboard.hear(messages, tick.step)
        return [self._aboard.act(tick)], []
