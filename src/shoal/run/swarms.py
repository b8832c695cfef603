"""Swarms: many runs of one scenario, side by side, a step of all of them in one compiled call; decided from outside."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.compiler.kernel import compile_for
from shoal.compiler.late import compiles
from shoal.compiler.placed import Placed
from shoal.core.agents import Floats, aligned_zeros, as_records
from shoal.core.errors import ScenarioError, StrategyError
from shoal.core.plugin_errors import plugin_errors
from shoal.engine.environment import LOOK, NOT_ASKED, REST, STEP, Asked, Earned, step_swarms
from shoal.engine.observation import Seen
from shoal.engine.rollout import begin_run, set_out
from shoal.engine.stage import RUN, Run, Stage, new_scratch
from shoal.run.build import build_nature, build_radio, build_swarm, build_targets, losses_of
from shoal.run.simulation import Simulation
from shoal.scenario.crew import Crew
from shoal.scenario.on_track import open_tracks
from shoal.scenario.schema import Scenario
from shoal.world.placement import PLACES

_set_out: Any = set_out  # kernels have no types that mypy sees
_CHANGED = ("swarm", "radio", "targets", "nature", "tally")  # parts of a stage that a run changes


class Actions(NamedTuple):
    """What actions mean: of E swarms of N agents, A numbers each; see engine/environment.py.

    low, high : (A,) what others are cut to; middle, half : (N, A) of what is written; columns : (A,) of memory
    """

    low: Floats
    high: Floats
    middle: Floats
    half: Floats
    columns: npt.NDArray[np.int64]


class Swarms:
    """E runs of a scenario that take their steps together.

    A swarm that is reset to a seed and a run goes as `Simulation` goes of that seed and run, to the bit, as long as
    what is written into memories is the same.

    Parameters
    ----------
    scenario : of all of them
    count : E
    crew : who decides; its memory is what actions are written into
    actions : what they mean
    seen, earned : where to write what agents know, and their rewards

    Attributes
    ----------
    number : (E,) steps that each has done since it was reset
    actions : (E, N, A) room for what is asked for
    template : a Simulation of the scenario, for what all have in common; it takes no steps

    Raises
    ------
    ScenarioError : agents decide one after the other, or are under commands: there is no one moment to decide for all;
        or distances are in single precision
    """

    def __init__(
        self, scenario: Scenario, count: int, crew: Crew, actions: Actions, seen: Seen, earned: Earned
    ) -> None:
        if scenario.motion.update_order == "sequential":
            problem = "is sequential: agents decide one after the other, on what the others have just done"
            raise ScenarioError("motion.update_order", problem, "an environment decides for all at once: synchronous")
        if scenario.precision == "single":
            raise ScenarioError("precision", "is single", "an environment has double precision: leave it out")
        if scenario.commands:
            raise ScenarioError("commands", "change what agents go by on the way", "an environment has none: drop them")
        self.scenario, self.crew = scenario, crew
        self.template = Simulation(scenario, crew=crew)
        stage, memories, self._params = self.template.work()
        self._pristine = _pristine(self.template, stage)
        kind = type(memories)
        told = stage.radio.told
        self.memory: Floats = np.zeros((count, *stage.swarm.memory.shape))
        self._told, self._arrived = np.zeros((count, *stage.swarm.told.shape)), np.zeros((count, *told.shape))
        parts = (self.memory, crew.memory), (self._told, crew.told), (self._arrived, crew.told)
        records = [as_records(numbers, names) for numbers, names in parts]
        self._memories = kind(*(np.asarray(each) if compiles() else each for each in records))
        self._begin, self._step = crew.compiled(begin_run, step_swarms)
        self._starts = np.array([PLACES.index(fleet.start) for fleet in scenario.fleets])
        self._lifetimes = np.array([fleet.mean_lifetime or 0.0 for fleet in scenario.fleets])
        self._losses = losses_of(scenario)
        self._placed = [Placed(self._new_stage(stage, e)) for e in range(count)]
        addresses = [each.address for each in self._placed]
        self._addresses: Any = np.array(addresses, np.int64) if compiles() else addresses
        self.number = np.zeros(count, np.int64)
        wanted = np.zeros((count, scenario.agents, actions.columns.size))
        self.actions = wanted
        self._begun = False
        self._asked = Asked(np.full(count, REST), self.number, wanted, *actions)
        self._views = (seen, earned)
        with plugin_errors(), crew.naming_errors():
            compile_for(self._step, self._addresses, self._memories, self._params, self._asked, *self._views)

    def reset(self, e: int, seed: int, run: int) -> None:
        """Let swarm e begin a run; what its agents know is written by the next `step`, which it takes no part in."""
        stage = self._placed[e].stage
        for now, then in zip(_changing(stage), self._pristine, strict=True):
            np.copyto(now, then)
        self._told[e] = self._arrived[e] = 0.0
        self._placed[e].change(RUN, Run(np.uint64(seed), run, self.scenario.steps))
        address = self._placed[e].address
        with plugin_errors(), self.crew.naming_errors():
            _set_out(address, self._starts, self._lifetimes, self._losses)
            swarm = stage.swarm
            swarm.home_x[:], swarm.home_y[:] = swarm.fix_x, swarm.fix_y
            self._begin(address, self._memories_of(e), self._params)
        self.number[e] = 0
        self._asked.doing[e] = LOOK
        self._begun = True

    def step(self, actions: Any) -> bool:
        """Do a step of all swarms; those that were reset only say what their agents know. False: nothing was done.

        Parameters
        ----------
        actions : (E, N, A), finite, else nothing is done; None: those that were reset are looked at, the others rest

        Raises
        ------
        StrategyError : a position or a velocity is not finite
        """
        doing = self._asked.doing
        if actions is None:
            doing[doing == STEP] = REST
            self.actions[:] = 0.0
            self._begun = True
        else:
            np.copyto(self.actions, actions, casting="same_kind")
        spoiled = self._step(self._addresses, self._memories, self._params, self._asked, *self._views)
        if spoiled == NOT_ASKED:
            return False
        if self._begun:
            doing[:] = STEP
            self._begun = False
        if spoiled:
            fix = "look for a division by zero or the root of a negative number, in the strategy or what it was told"
            raise StrategyError(self.crew.source, f"swarm {spoiled - 1} has a number that is not finite", fix)
        return True

    def swarm(self, e: int) -> Any:
        """The arrays of swarm e, padded: the first N lanes count. To look at."""
        return self._placed[e].stage.swarm

    def targets(self, e: int) -> Any:
        """The targets of swarm e, (T,) records. To look at."""
        return self._placed[e].stage.targets

    def _new_stage(self, model: Stage, e: int) -> Stage:
        """A stage of its own for swarm e; what no run changes is shared."""
        stage = model._replace(**{name: _copy(getattr(model, name)) for name in _CHANGED})
        exact = model.swarm.fix_x is model.swarm.x
        swarm = stage.swarm._replace(memory=self.memory[e], told=self._told[e])
        swarm = swarm._replace(fix_x=swarm.x, fix_y=swarm.y) if exact else swarm
        collects = self.scenario.network.collects
        scratch = new_scratch(model.world, swarm.x.size, self.crew.sums, self.crew.ranked, collects)
        return stage._replace(swarm=swarm, radio=stage.radio._replace(told=self._arrived[e]), scratch=scratch)

    def _memories_of(self, e: int) -> Any:
        return type(self._memories)(*(each[e] for each in self._memories))


def _pristine(template: Simulation, stage: Stage) -> list[npt.NDArray[Any]]:
    """What changes of a stage, as it is before a run is set out."""
    scenario, crew = template.scenario, template.crew
    swarm = build_swarm(scenario, crew)
    swarm.station_x[:], swarm.station_y[:] = stage.swarm.station_x, stage.swarm.station_y
    lanes = swarm.x.size
    targets, _ = build_targets(scenario, open_tracks(scenario))
    radio, nature = build_radio(scenario, crew, stage.world, lanes), build_nature(scenario, lanes)
    tally = _copy(stage.tally)  # the template has done no step
    return _changing(stage._replace(swarm=swarm, radio=radio, targets=targets, nature=nature, tally=tally))


def _changing(stage: Stage) -> list[npt.NDArray[Any]]:
    """The arrays of a stage that a run changes."""
    return [array for name in _CHANGED for array in _arrays(getattr(stage, name))]


def _arrays(value: Any) -> Iterator[npt.NDArray[Any]]:
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, tuple):
        for each in value:
            yield from _arrays(each)


def _copy(value: Any) -> Any:
    """Nested NamedTuples with arrays of their own, numbers on whole cache lines."""
    if isinstance(value, tuple):
        return type(value)(*(_copy(each) for each in value))
    if not isinstance(value, np.ndarray):
        return value
    if value.dtype != np.float64:
        return value.copy()
    own = aligned_zeros(value.size).reshape(value.shape)
    own[...] = value
    return own
