"""What a strategy makes of what must have been heard, asked of the engine's function and not of a buoy's minds."""

import numpy as np
import numpy.typing as npt

from shoal.core.agents import as_records, width
from shoal.run.fleet.invariants import CONTENT, demand
from shoal.run.fleet.vessel import Thought
from shoal.scenario.briefing import briefing_in, fleet_of
from shoal.scenario.crew import crew_of
from shoal.scenario.schema import Scenario
from shoal.strategies.one_agent import Inbox, Room, decide_several, key_of_run

_TOLD = len(CONTENT)


class SecondOpinion:
    """Decides again.

    Parameters
    ----------
    scenario : of the fleet
    """

    def __init__(self, scenario: Scenario) -> None:
        self._crew = crew = crew_of(scenario)
        self._decide, key_of = crew.compiled(decide_several, key_of_run)
        self._key = np.uint64(key_of(np.uint64(scenario.seed), 0))
        self._selves = np.zeros((scenario.agents, 21))
        for id, row in enumerate(self._selves):
            fleet = fleet_of(scenario, id)
            row[8:] = [id, scenario.fleets[fleet].max_speed, scenario.time_step, fleet, *briefing_in(scenario, id)]

    def check(
        self, thought: Thought, one: int, heard: npt.NDArray[np.float64], nearest: npt.NDArray[np.int64], step: int
    ) -> None:
        """A buoy wants, and remembers, what its strategy makes of what it must have heard.

        Parameters
        ----------
        thought, one : of some buoys, and which of them
        heard, nearest : what they must have heard: see `Ear.check_thought`
        step : by their clock

        Raises
        ------
        BrokenInvariantError : something else
        """
        crew, id, count = self._crew, thought.ids[one], len(heard)
        self._selves[id, :8] = thought.readings[one]
        memory = np.array([thought.before[one] or (0.0,)])
        tells = np.zeros((count + 1, width(crew.told)))
        if crew.told:
            tells[:count], tells[count] = heard[:, _TOLD:], memory[0, : len(crew.told)]
        told, remembered = (np.asarray(as_records(*each)) for each in ((tells, crew.told), (memory, crew.memory)))
        inbox = Inbox(heard[:, 0].astype(np.int64), heard[:, [1, 2, 3, 4, 6]], heard[:, 5] > 0.0, told)
        square = ((heard[nearest[one], 1:3] - self._selves[id, :2]) ** 2).sum(axis=1)
        near = np.stack([nearest[one], np.argsort(np.argsort(square, kind="stable"))], axis=1)[None]
        room = Room(np.zeros((crew.sums, 1)), np.zeros((1, 2)))
        places, own = np.array([0]), self._selves[id : id + 1]
        self._decide(places, own, inbox, near, remembered, crew.params, (self._key, step), room)
        who = f"buoy {id} in step {step}"
        demand(f"a buoy wants what its strategy says: {who}", thought.wants[one], room.wants[0].tolist())
        after = tuple(memory[0, : len(crew.memory)].tolist())
        demand(f"a buoy remembers what its strategy does: {who}", thought.after[one], after)
