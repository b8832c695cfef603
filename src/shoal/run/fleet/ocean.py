"""The stand-in for the sea: the engine's own world, whose agents want what buoys outside want."""

from collections.abc import Callable, Iterable

import numpy as np
import numpy.typing as npt

from shoal.buoy.named import buoys_of
from shoal.buoy.tether import READINGS, Commands, Tick
from shoal.core.errors import FleetError, ScenarioError, StrategyError
from shoal.core.links import MOST_LINKED, unpacked
from shoal.record.trajectory import Trajectory
from shoal.run.simulation import Simulation
from shoal.scenario.commands import Command
from shoal.scenario.crew import Crew, crew_of
from shoal.scenario.schema import Scenario


class Ocean:
    """A run of a scenario in which everything but deciding is done by the engine, one step at a time.

    It limits what buoys want as their make is limited, so that a buoy that wants too much gets what it can have.

    Parameters
    ----------
    scenario : of the run; run : number of the replicate

    Attributes
    ----------
    simulation : the engine's run; roster, tally, notes are there
    leaves : the step at which the scenario loses each agent, (N,)
    ideal : whether radios reach everybody: then buoys choose whom they hear, else the sea says whom they can
    on_step : called with the frame that a step begins with, before it is done

    Raises
    ------
    StrategyError : a strategy is told where targets are, which no buoy can know
    ScenarioError : buoys cannot do what the scenario says
    """

    def __init__(self, scenario: Scenario, run: int = 0) -> None:
        crew = crew_of(scenario)
        check_buoys_can(scenario, crew)
        network = scenario.network
        self.simulation = Simulation(scenario, run, crew=crew.puppets())
        self.ideal = not (
            network.range
            or network.loss
            or network.delay
            or scenario.report_steps > 1
            or scenario.disturbances
            or self.simulation.world.coastal
        )
        if not self.ideal and scenario.agents > MOST_LINKED:
            problem = f"has limited radios and {scenario.agents} agents, but whom each hears is known of {MOST_LINKED}"
            raise ScenarioError(scenario.name, problem, f"take {MOST_LINKED} agents at most, or radios without limits")
        self._agents = scenario.agents
        self.on_step: Callable[[Trajectory], None] = lambda frame: None
        self.leaves = self.simulation.swarm.leaves[: scenario.agents].copy()

    @property
    def number(self) -> int:
        """Steps done."""
        return self.simulation.number

    @property
    def alive(self) -> npt.NDArray[np.bool_]:
        """Which agents are there, (N,)."""
        return np.asarray(self.simulation.swarm.alive[: self._agents] > 0.0)

    def tick(self, turn: int = 0) -> Tick:
        """What the coming step begins with, for all buoys that are there."""
        everybody = self.readings()
        alive = self.alive
        return Tick(self.number, turn, everybody[alive], alive, None if self.ideal else self._hears()[alive])

    def _hears(self) -> npt.NDArray[np.bool_]:
        """Whom each agent hears in the coming step, (N, N); where they keep reports, or relay, who reaches each."""
        links = unpacked(self.simulation.look().links[0])
        return self.simulation.reached.T if self.simulation.scenario.network.collects else links

    def readings(self) -> npt.NDArray[np.void]:
        """What all instruments say, those of absent agents too, (N,) of READINGS."""
        swarm = self.simulation.swarm
        said = np.zeros(self._agents, READINGS)
        said["id"] = np.arange(self._agents)
        said["x"], said["y"] = swarm.fix_x[: self._agents], swarm.fix_y[: self._agents]
        for name in ("vx", "vy", "on_target", "drift_x", "drift_y", "aground"):
            said[name] = getattr(swarm, name)[: self._agents]
        return said

    def obey(self, ids: npt.NDArray[np.int32], wants: npt.NDArray[np.float64]) -> None:
        """Let agents want velocities (n, 2) [m/s] from now on; what is no number is left out."""
        sound = np.isfinite(wants).all(axis=1) & (ids >= 0) & (ids < self._agents)
        with self.simulation.edit() as now:
            now.swarm.memory[ids[sound], :2] = wants[sound]

    def order(self, command: Command) -> None:
        """Let the engine go by what buoys are told: whom they can hear, where that is limited, is its to say."""
        self.simulation.order(command)

    def follow(self, answers: list[Commands]) -> None:
        """Let agents want what they say; of what one says twice, the later."""
        if answers:
            self.obey(np.concatenate([each.ids for each in answers]), np.concatenate([each.wants for each in answers]))

    def advance(self) -> Trajectory:
        """Do a step; return the frame that it began with."""
        frame = self.simulation.look()  # not `every=1`, which makes room for frames anew
        self.on_step(frame)
        self.simulation.advance(1)
        return frame

    def lose(self, ids: Iterable[int]) -> list[int]:
        """Let agents be absent from the coming step on; return those that were there or would have come.

        Raises
        ------
        FleetError : no step is done yet
        """
        lost = sorted(id for id in set(ids) if self.simulation.swarm.leaves[id] > self.number)
        if lost and self.number == 0:
            raise FleetError(buoys_of(lost), "lost before the first step was done", "start the fleet again")
        with self.simulation.edit() as now:
            now.swarm.leaves[lost] = self.number
        return lost


def check_buoys_can(scenario: Scenario, crew: Crew) -> None:
    """Refuse what agents of a simulation can do and buoys cannot.

    Raises
    ------
    StrategyError : they are told where targets are
    ScenarioError : they decide one after the other, each on what the others have just done, or in single precision
    """
    informed = [each.name for each in crew.strategies if each.informed]
    if informed:
        problem = f"strategy {informed[0]!r} is told where targets are, which no buoy can know"
        raise StrategyError(scenario.name, problem, "choose another; `shoal strategies` says which are informed")
    if scenario.motion.update_order == "sequential":
        problem = "is sequential: agents decide one after the other, on what the others have just done"
        raise ScenarioError("motion.update_order", problem, "buoys decide at once: write synchronous")
    if scenario.precision == "single":
        problem = "is single, in which an engine adds up what all neighbors exert; a buoy has few, and is exact"
        raise ScenarioError("precision", problem, "write double, or leave it out")
