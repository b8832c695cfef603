"""What a strategy makes of what must have been heard, asked of the engine's function and not of a buoy's minds."""

from typing import NamedTuple

import numpy as np

from shoal.core.agents import as_records, width
from shoal.run.fleet.invariants import CONTENT, Floats, demand
from shoal.scenario.briefing import briefing_in, fleet_of
from shoal.scenario.crew import crew_of
from shoal.scenario.schema import Scenario
from shoal.strategies.one_agent import Inbox, Room, decide_several, key_of_run

_ID, _ON_TARGET = CONTENT.index("id"), CONTENT.index("on_target")


class Doubt(NamedTuple):
    """What a buoy made of what: what it measured (8,), what it must have heard (k, 7 + T), its memory before (M,).

    wants : (2,) what came of it, and after : what it remembers
    """

    id: int
    reading: Floats
    heard: Floats
    before: Floats
    wants: Floats
    after: Floats


class SecondOpinion:
    """Decides again.

    Parameters
    ----------
    scenario : of the fleet
    """

    def __init__(self, scenario: Scenario) -> None:
        self._crew = crew = crew_of(scenario)
        self._agents = scenario.agents
        self._decide, key_of = crew.compiled(decide_several, key_of_run)
        self._key = np.uint64(key_of(np.uint64(scenario.seed), 0))
        self._selves = np.zeros((scenario.agents, 21))
        for id, row in enumerate(self._selves):
            fleet = fleet_of(scenario, id)
            row[8:] = [id, scenario.fleets[fleet].max_speed, scenario.time_step, fleet, *briefing_in(scenario, id)]

    def check(self, doubts: list[Doubt], step: int) -> None:
        """What buoys want, and remember, is what their strategy makes of what they must have heard.

        Parameters
        ----------
        doubts : about n buoys
        step : by their clocks

        Raises
        ------
        BrokenInvariantError : something else
        """
        crew, count = self._crew, len(doubts)
        ids = [each.id for each in doubts]
        self._selves[ids, :8] = [each.reading for each in doubts]
        heard = [each.heard[~np.isnan(each.heard[:, 0])] for each in doubts]
        said = np.concatenate(heard)
        first = np.cumsum([0, *map(len, heard)])
        near = np.full((count, max(map(len, heard)), 2), -1)
        for n, its in enumerate(heard):
            square = ((its[:, :2] - self._selves[ids[n], :2]) ** 2).sum(axis=1)
            near[n, : len(its), 0] = np.arange(first[n], first[n + 1])
            near[n, : len(its), 1] = square.argsort(kind="stable").argsort()
        memory = np.zeros((self._agents, width(crew.memory)))
        memory[ids, : len(crew.memory)] = [each.before for each in doubts]
        tells = np.zeros((len(said) + count, width(crew.told)))
        tells[: len(said), : len(crew.told)] = said[:, len(CONTENT) :]
        tells[len(said) :, : len(crew.told)] = memory[ids, : len(crew.told)]
        told, remembered = (np.asarray(as_records(*each)) for each in ((tells, crew.told), (memory, crew.memory)))
        numbers, on_target = said[:, :_ID].copy(), said[:, _ON_TARGET] > 0.0
        inbox = Inbox(said[:, _ID].astype(np.int64), numbers, on_target, told)
        room = Room(np.zeros((crew.sums, 1)), np.zeros((count, 2)))
        self._decide(np.array(ids), self._selves, inbox, near, remembered, crew.params, (self._key, step), room)
        for n, (id, _, _, before, wants, after) in enumerate(doubts):
            who = f"buoy {id} in step {step}"
            demand(f"a buoy wants what its strategy says: {who}", wants.tolist(), room.wants[n].tolist())
            remembers = memory[id, : len(before)].tolist()
            demand(f"a buoy remembers what its strategy does: {who}", after.tolist(), remembers)
