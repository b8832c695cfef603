"""Simulation: one run of a scenario that can be advanced, looked at, saved and resumed at any step."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.compiler.kernel import compile_for
from shoal.compiler.late import compiles
from shoal.compiler.placed import Placed
from shoal.core.agents import NEVER, Memories, as_records
from shoal.core.errors import ScenarioError, StrategyError
from shoal.core.plugin_errors import plugin_errors
from shoal.core.text import plain
from shoal.core.version import RESULTS_VERSION
from shoal.engine.phases import SPOILED_DRIFT, SPOILED_TARGETS, addresses
from shoal.engine.rollout import begin_run, look, rollout, set_out
from shoal.engine.stage import Frames, Run, Stage, new_frames, new_scratch
from shoal.metrics.chosen import counted
from shoal.metrics.tally import never_counted, new_tally
from shoal.record.saved_state import read_state, write_state
from shoal.record.trajectory import Trajectory
from shoal.run.build import (
    build_nature,
    build_radio,
    build_swarm,
    build_targets,
    build_world,
    kind_of_memories,
    losses_of,
    most_listed,
)
from shoal.run.facts import roster_of
from shoal.run.sea import build_sea
from shoal.run.state import State, arrays_of, read_only, state_of
from shoal.run.timetable import Timetable
from shoal.scenario.assumptions import assumptions
from shoal.scenario.at_sea import open_sea
from shoal.scenario.commands import Command
from shoal.scenario.crew import Crew, crew_of
from shoal.scenario.load import Source, load
from shoal.scenario.on_track import open_tracks
from shoal.scenario.stations import stations
from shoal.world.orders import ORDERS
from shoal.world.placement import PLACES

_set_out: Any = set_out  # kernels have no types that mypy sees
_look: Any = look
BATCHES = 20  # of one run, for batch means


class Simulation:
    """One run of a scenario. Same scenario, seed and run: same bits, however it is advanced.

    Parameters
    ----------
    scenario : what to run: a Scenario, or what shoal.load takes
    run : number of the replicate; with the seed it decides all chance
    crew : who decides instead of the strategies that the scenario names, such as buoys outside; default: these

    Attributes
    ----------
    number : steps done
    swarm : read-only arrays of the agents' state and make (padded: the first `scenario.agents` lanes count)
    targets : read-only array of target records, (T,)
    tally : read-only sums so far
    roster : what each agent was given: fleet, top speed, sensor, k, strategy, when it joins
    memories : read-only records of what agents remember, in the words of their strategy
    moment : all of the state, read-only; `edit` opens it for changes
    notes : what was assumed or dropped, in the scenario, in recorded tracks or in a saved state

    Raises
    ------
    ScenarioError : it cannot run
    TrackError : a recorded track cannot be used
    StrategyError : the strategy cannot be compiled, or raises an error
    """

    def __init__(self, scenario: Source, run: int = 0, *, crew: Crew | None = None) -> None:
        self.scenario = scenario = load(scenario)  # whoever made or copied it
        self.run = run
        self.number = 0
        self.crew = crew or crew_of(scenario)
        self._first_crew, self._decided_here = self.crew, crew is None
        self._timetable = Timetable(scenario)
        self.memory_fields = self.crew.memory
        opened = open_sea(scenario)
        tracks = open_tracks(scenario)
        self.notes = [*(opened.notes if opened else ()), *(note for track in tracks for note in track.notes)]
        self.notes += assumptions(scenario)
        self._sea = build_sea(scenario, opened)
        self.world = build_world(scenario, self._sea)
        self._swarm = build_swarm(scenario, self.crew)
        if opened and opened.shore is not None:
            places = stations(scenario, opened.shore)
            self._swarm.station_x[: scenario.agents], self._swarm.station_y[: scenario.agents] = places.T
        self._radio = build_radio(scenario, self.crew, self.world, self._swarm.x.size)
        self._targets, self.tracks = build_targets(scenario, tracks)
        self._nature = build_nature(scenario, self._swarm.x.size)
        network = scenario.network
        self.world = self.world._replace(listed=most_listed(scenario, self.world, self._swarm, self._radio))
        memories = kind_of_memories(scenario, self.world)(
            memory=as_records(self._swarm.memory, self.memory_fields),
            told=as_records(self._swarm.told, self.crew.told),
            arrived=as_records(self._radio.told, self.crew.told),
        )
        plain = type(memories)(*(np.asarray(each) for each in memories))
        self._memories = plain if compiles() else memories  # numba takes recarrays, too, but slowly
        batches = min(BATCHES, scenario.steps)
        self._tally = new_tally(scenario.steps, batches, len(scenario.fleets), scenario.agents, len(scenario.targets))
        self._state = state_of(self._swarm, self._radio, self._targets, self._nature, self._tally)
        self.swarm, self.targets, self.memories = read_only(self._swarm), read_only(self._targets), read_only(memories)
        self.moment: State = read_only(self._state)
        self.tally = counted(self.moment.tally, self.world.skipped)
        self._scratch = self._new_scratch()
        self._begin, self._rollout = self.crew.compiled(begin_run, rollout)
        self._which = Run(np.uint64(scenario.seed), run, scenario.steps)
        self._phases = addresses(self.world, collecting=network.collects, first=self._compile)
        self._placed = Placed(self._stage(self._new_frames(0)))
        self._looking: Placed | None = None  # until somebody looks
        starts = np.array([PLACES.index(fleet.start) for fleet in scenario.fleets])
        lifetimes = np.array([fleet.mean_lifetime or 0.0 for fleet in scenario.fleets])
        with plugin_errors():
            _set_out(self._placed.address, starts, lifetimes, losses_of(scenario))
        self._swarm.home_x[:], self._swarm.home_y[:] = self._swarm.fix_x, self._swarm.fix_y
        self.roster = roster_of(self._swarm, scenario.agents, self.crew)
        self.begin()
        self._settle()

    def __repr__(self) -> str:
        """One line: of what, and how far."""
        done = f"step {self.number:,} of {self.scenario.steps:,}"
        return f"<Simulation of {plain(self.scenario.name)}, run {self.run}: {done}>"

    def begin(self) -> None:
        """Set up every agent's memory, as its strategy does before the first step."""
        with plugin_errors(), self.crew.naming_errors():
            self._placed = self._in_place(self._placed)
            self._begin(self._placed.address, self._memories, self.crew.params)

    def advance(self, steps: int, *, every: int | None = None, tail: int | None = None) -> Trajectory | None:
        """Run a number of steps; with `every`, return the frames of every n-th step and of all from step `tail` on.

        Memory and results do not depend on how a run is cut into calls. When a call is back the state is true: agents
        are on target that are where they stand now.

        Raises
        ------
        ScenarioError : steps below 0
        StrategyError : the strategy cannot be compiled, raises an error, or spoils a number
        """
        if steps < 0:
            raise ScenarioError("advance", f"is asked for {steps} steps", "time goes forward: ask for 0 or more")
        legs = []
        for stop in self._timetable.stops(self.number, self.number + steps):
            legs.append(self._leg(stop, every, NEVER if tail is None else tail))
            self._follow_commands()
        kept = [leg for leg in legs if leg is not None]
        return Trajectory.join(kept) if len(kept) > 1 else next(iter(kept), None)

    def order(self, command: Command) -> None:
        """Let agents be under a command that the scenario does not have, from its step on; from now on if that is past.

        Parameters
        ----------
        command : what they are told

        Raises
        ------
        ScenarioError : it sets a field that cannot change on the way, or a value that it cannot have
        """
        self._timetable.add(command)
        self._follow_commands()

    def work(self, frames: int = 0) -> tuple[Stage, Memories, Any]:
        """What the engine works on, with room for so many frames: for those who run steps elsewhere, see `worked`."""
        return self._stage(self._new_frames(frames)), self._memories, self.crew.params

    def worked(self, steps: int) -> None:
        """Go on from a state that was brought so many steps further elsewhere.

        Raises
        ------
        StrategyError, ScenarioError : a number is not finite
        """
        self.number += steps
        self._settle()

    def look(self) -> Trajectory:
        """Return the current frame (K = 1), as the coming step would keep it. Nothing is changed.

        Its links are those of the coming step. In the sequential order, in which agents hear what others have just
        done, they are those of agents that all decide first.
        """
        self._keep_frames(looking=True)
        self._looking = self._in_place(self._looking or Placed(self._stage(self._new_frames(1))))
        _look(self._looking.address, self.number)
        seen = Frames(*(array.copy() for array in self._looking.stage.frames))
        return Trajectory.from_frames(seen, self.memory_fields)

    @contextmanager
    def edit(self) -> Iterator[State]:
        """Open the state for changes by hand; when the block ends, on_target is recomputed.

        >>> with simulation.edit() as now:
        ...     now.swarm.x[:2] = 0.0

        Raises
        ------
        StrategyError : a number is not finite
        """
        yield self._state
        self._settle()

    def state(self) -> dict[str, Any]:
        """Everything that a resumed run needs, as arrays by name; read-only."""
        return dict(arrays_of(self.moment)) | {"number": np.array(self.number)}

    def save(self, file: str | Path) -> None:
        """Write the state to a file (.npz), atomically."""
        write_state(file, self._identity(), self.state())

    def restore(self, file: str | Path) -> None:
        """Continue from a saved state of the same scenario, seed and run.

        Parameters
        ----------
        file : what `save` wrote

        Raises
        ------
        RecordError : no saved state, a damaged one, or one of something else
        """
        saved, lone = read_state(file, self._identity(), self.state())  # read whole before anything is overwritten
        for name, array in arrays_of(self._state):
            array[...] = saved[name] if name in saved else never_counted(array, name.removeprefix("tally."))
        self.number = int(saved["number"])
        self.catch_up()
        self.notes += [_note_of(name, self.state().get(name)) for name in lone]
        self._settle()

    def catch_up(self) -> None:
        """Go by what has been set until now, after `number` was set from outside; orders are part of the state."""
        self._timetable = Timetable(self.scenario)
        self.crew = self._first_crew
        if any(command.set for command in self._timetable.due(self.number)):
            self._go_by(self._state)

    @property
    def radio(self) -> Any:
        """Settings of the radio, and what is on the air; read-only."""
        return read_only(self._radio)

    @property
    def reached(self) -> npt.NDArray[np.bool_]:
        """Whose report (row) reaches whom (column) in the step looked at or done last, (N, N), relays included.

        Only where radios relay or keep reports is it known; what agents have from before is not part of it.
        """
        return np.asarray(self._scratch.hops[:, : self.scenario.agents] > 0)

    def _compile(self) -> None:
        """Compile what the strategy is part of, or load it from the cache."""
        with plugin_errors(), self.crew.naming_errors():
            compile_for(self._begin, 0, self._memories, self.crew.params)
            compile_for(self._rollout, 0, self._memories, self.crew.params, 0, 0, 0, 0)

    def _keep_frames(self, looking: bool = False) -> None:
        """Compile the phases that frames need, which runs without frames do without."""
        if not (self._phases.look_at_links if looking else self._phases.record_frame):
            looking = looking or bool(self._phases.look_at_links)
            self._phases = addresses(self.world, True, looking, self.scenario.network.collects)

    def _settle(self) -> None:
        """Make the state true after a change; where everybody is always there, the engine leaves a lot out."""
        if not self.world.ordered and self._swarm.order.any():
            self.world = self.world._replace(ordered=True)
        if not self.world.mortal and (self._swarm.leaves < NEVER).any():
            self.world = self.world._replace(mortal=True)
            self._radio = self._radio._replace(limited=True)
        if 0 < self.world.listed < (most := int(self._swarm.neighbors[: self.scenario.agents].max())):
            self.world = self.world._replace(listed=most)
            self._scratch = self._new_scratch()
        self.advance(0)

    def _leg(self, last: int, every: int | None, tail: int) -> Trajectory | None:
        """Run to a step; return the frames that are kept."""
        if every is None:
            self._placed = self._in_place(self._placed)
            self._roll(self._placed, self.number, last, NEVER, NEVER)
            return None
        self._keep_frames()
        frames = self._new_frames(count_frames(self.number, last, every, tail))
        self._roll(Placed(self._stage(frames)), self.number, last, every, tail)
        return Trajectory.from_frames(frames, self.memory_fields) if frames.step.size else None

    def _follow_commands(self) -> None:
        """Obey what is to be obeyed from the coming step on."""
        for command in self._timetable.due(self.number):
            with self.edit() as now:
                if command.set:
                    self._go_by(now)
                elif self._decided_here:  # whoever decides outside obeys there
                    now.swarm.order[command.among(self.scenario.agents)] = ORDERS.index(str(command.order))

    def _go_by(self, now: State) -> None:
        """Let agents go by what is set now."""
        instructions = self._timetable.instructions
        if instructions is not None:
            if not self.radio.adaptive:
                now.swarm.neighbors[: self.scenario.agents] = instructions.degrees(self.crew)
            if self._decided_here:
                self.crew = instructions.crew(self.crew)

    def _roll(self, placed: Placed, first: int, last: int, every: int, tail: int) -> None:
        """Run steps first..last on a stage.

        Raises
        ------
        StrategyError : a position, a velocity or a sum is not finite
        ScenarioError : the place of a target or a drift is not, which is the fault of a kind that is not ours
        """
        with plugin_errors(), self.crew.naming_errors():
            spoiled = self._rollout(placed.address, self._memories, self.crew.params, first, last, every, tail)
        self.number = last
        if spoiled:
            raise self._spoiled(spoiled)

    def _spoiled(self, what: int) -> StrategyError | ScenarioError:
        fix = "look for a division by zero or the root of a negative number"
        if what == SPOILED_DRIFT:
            kinds = ", ".join(dict.fromkeys(each.kind for each in self.scenario.disturbances))
            return ScenarioError(
                "disturbances", f"({kinds}) drift by no finite distance, before step {self.number}", fix
            )
        if what == SPOILED_TARGETS:
            kinds = ", ".join(dict.fromkeys(each.kind for each in self.scenario.targets))
            return ScenarioError("targets", f"({kinds}) are at no finite place, before step {self.number}", fix)
        problem = f"strategy {self.crew.name!r} wanted a velocity that is not finite, before step {self.number}"
        return StrategyError(self.crew.source, problem, fix)

    def _in_place(self, placed: Placed) -> Placed:
        """The stage, where kernels find it; it stays there from call to call unless a part of it is another one."""
        stage = self._stage(placed.stage.frames)
        same = all(one is other for one, other in zip(stage, placed.stage, strict=True))
        return placed if same else Placed(stage)

    def _identity(self) -> str:
        return f"{self.scenario.hash}-seed{self.scenario.seed}-run{self.run}-results{RESULTS_VERSION}"

    def _stage(self, frames: Frames) -> Stage:
        return Stage(
            self.world,
            self._swarm,
            self._radio,
            self._targets,
            self.tracks,
            self._nature,
            self._sea,
            self._tally,
            self._scratch,
            frames,
            self._phases,
            self._which,
        )

    def _new_scratch(self) -> Any:
        collects = self.scenario.network.collects
        return new_scratch(self.world, self._swarm.x.size, self.crew.sums, self.crew.ranked, collects)

    def _new_frames(self, count: int) -> Frames:
        return new_frames(count, self.scenario.agents, self._targets.size, self._swarm.memory.shape[1])


def _note_of(name: str, here: Any) -> str:
    """What is said of a sum that only the saved state has, or only this Shoal, which then has the array `here`."""
    called = name.removeprefix("tally.")
    if here is not None and here.dtype.kind == "f":
        return f"the saved state has no sum {called!r}, so that the metrics made of it are unknown"
    if here is not None:
        return f"the saved state has no sum {called!r}: the metrics made of it are of the rest of the run only"
    return f"the saved state has a sum {called!r}, which no installed package knows: it is dropped"


def count_frames(first: int, last: int, every: int | None, tail: int) -> int:
    """Number of frames that steps first..last keep."""
    if every is None:
        return 0
    before = min(last, max(tail, first))
    return (-(-before // every)) - (-(-first // every)) + (last - before)
