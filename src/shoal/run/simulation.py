"""Simulation: one run of a scenario that can be advanced, looked at, saved and resumed at any step."""

from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from shoal.compiler.phase import put
from shoal.core.agents import NEVER, Minds, as_records
from shoal.core.errors import RecordError, ScenarioError, StrategyError
from shoal.core.files import whole_file
from shoal.engine.phases import PHASES, Addresses
from shoal.engine.rollout import set_out
from shoal.engine.stage import Frames, Stage, new_scratch
from shoal.metrics.tally import new_tally
from shoal.record.trajectory import Trajectory
from shoal.run.build import build_radio, build_swarm, build_targets, build_world, losses_of, open_tracks
from shoal.run.compiling import entry_points
from shoal.run.crew import crew_of
from shoal.run.strategy_errors import strategy_errors
from shoal.scenario.schema import Scenario
from shoal.version import RESULTS_VERSION
from shoal.world.placement import PLACES

_set_out: Any = set_out  # kernels have no types that mypy sees
BATCHES = 20  # of one run, for batch means


class Simulation:
    """One run of a scenario. Same scenario, seed and run: same bits, however it is advanced.

    Parameters
    ----------
    scenario : what to run
    run : number of the replicate; with the seed it decides all chance

    Attributes
    ----------
    number : steps done
    swarm : arrays of the agents' state (padded: the first `scenario.agents` lanes count)
    targets : array of target records
    tally : sums so far
    notes : what was assumed or dropped in reading recorded tracks

    Raises
    ------
    TrackError : a recorded track cannot be used
    StrategyError : the strategy cannot be compiled, or raises an error
    """

    def __init__(self, scenario: Scenario, run: int = 0) -> None:
        self.scenario = scenario
        self.run = run
        self.number = 0
        self.crew = crew_of(scenario)
        self.memory_fields = self.crew.memory
        self.world = build_world(scenario)
        self.swarm = build_swarm(scenario, self.crew)
        self.radio = build_radio(scenario, self.crew, self.swarm.x.size)
        tracks = open_tracks(scenario)
        self.notes = [note for track in tracks for note in track.notes]
        self.targets, self.tracks = build_targets(scenario, tracks)
        self.minds = Minds(
            memory=as_records(self.swarm.memory, self.memory_fields),
            told=as_records(self.swarm.told, self.crew.told),
            arrived=as_records(self.radio.told, self.crew.told),
        )
        batches = min(BATCHES, scenario.steps)
        self.tally = new_tally(scenario.steps, batches, len(scenario.fleets), scenario.agents, len(scenario.targets))
        self._scratch = new_scratch(self.world, self.swarm.x.size, self.crew.sums, self.crew.ranked)
        self._begin, self._rollout = entry_points(self.crew)
        self._seed = np.uint64(scenario.seed)
        places = np.array([PLACES.index(fleet.start) for fleet in scenario.fleets])
        lifetimes = np.array([fleet.mean_lifetime or 0.0 for fleet in scenario.fleets])
        here, held = put(self._stage(self._new_frames(0)))
        self._phases = Addresses._make(phase.address() for phase in PHASES)
        _set_out(here, places, lifetimes, losses_of(scenario), self._seed, run)
        del held
        self.begin()

    def begin(self) -> None:
        """Set up every agent's memory, as its strategy does before the first step."""
        here, held = put(self._stage(self._new_frames(0)))
        with strategy_errors(self.crew):
            self._begin(here, self.minds, self.crew.params, self._seed, self.run)
        del held

    def advance(self, steps: int, *, every: int | None = None, tail: int | None = None) -> Trajectory | None:
        """Run so many steps; with `every`, return the frames of every so many-th step and of all from step `tail` on.

        Memory and results do not depend on how a run is cut into calls.
        """
        if steps < 0:
            raise ScenarioError("advance", f"is asked for {steps} steps", "time goes forward: ask for 0 or more")
        last = self.number + steps
        tail = NEVER if tail is None else tail
        kept = count_frames(self.number, last, every, tail)
        frames = self._new_frames(kept)
        here, held = put(self._stage(frames))
        with strategy_errors(self.crew):
            self._rollout(
                here,
                self.minds,
                self.crew.params,
                self._phases,
                self._seed,
                self.run,
                self.number,
                last,
                self.scenario.steps,
                every or NEVER,
                tail,
            )
        del held
        self.number = last
        self._check_finite()
        return Trajectory.from_frames(frames, self.memory_fields) if kept else None

    def state(self) -> dict[str, Any]:
        """Everything that a resumed run needs, as arrays by name."""
        parts = {f"swarm.{name}": part for name, part in self.swarm._asdict().items()}
        parts |= {f"tally.{name}": part for name, part in self.tally._asdict().items()}
        parts |= {f"radio.{name}": part for name, part in self.radio._asdict().items() if isinstance(part, np.ndarray)}
        return parts | {
            "targets": self.targets,
            "number": np.array(self.number),
            "identity": np.array(self._identity()),
        }

    def save(self, file: str | Path) -> None:
        """Write the state to an .npz file, whole or not at all."""
        with whole_file(file) as partial, partial.open("wb") as stream:
            np.savez(stream, **self.state())

    def restore(self, file: str | Path) -> None:
        """Continue from a saved state of the same scenario, seed and run.

        Raises
        ------
        RecordError : no saved state, or one of something else
        """
        try:
            with Path(file).open("rb") as stream, np.load(stream) as state:
                if str(state["identity"]) != self._identity():
                    raise RecordError(
                        str(file),
                        f"was saved by {state['identity']}, this is {self._identity()}",
                        "use the same scenario",
                    )
                saved = dict(state)  # read whole before anything is overwritten
                number = int(saved["number"])
                mine = self.state()
                for name in mine:
                    if saved[name].shape != mine[name].shape:
                        raise ValueError(f"{name} has another shape")
                for name in mine.keys() - {"number", "identity"}:
                    mine[name][...] = saved[name]
                self.number = number
        except (OSError, ValueError, KeyError, EOFError, BadZipFile) as error:
            if isinstance(error, RecordError):
                raise
            raise RecordError(
                str(file), f"is no saved state: {error}", "name a file made by Simulation.save"
            ) from error

    def _check_finite(self) -> None:
        """Refuse to go on with numbers that a strategy has spoiled.

        Raises
        ------
        StrategyError : a position, a velocity or a sum is not finite
        """
        swarm = self.swarm
        parts = (swarm.x, swarm.y, swarm.vx, swarm.vy, self.tally.fluctuation)
        if not all(np.isfinite(part).all() for part in parts):
            raise StrategyError(
                self.crew.source,
                f"strategy {self.crew.name!r} wanted a velocity that is no finite number, before step {self.number}",
                "look for a division by zero or the root of a negative number",
            )

    def _identity(self) -> str:
        return f"{self.scenario.hash}-seed{self.scenario.seed}-run{self.run}-results{RESULTS_VERSION}"

    def _stage(self, frames: Frames) -> Stage:
        return Stage(self.world, self.swarm, self.radio, self.targets, self.tracks, self.tally, self._scratch, frames)

    def _new_frames(self, count: int) -> Frames:
        agents, targets = self.scenario.agents, self.targets.size
        return Frames(
            step=np.empty(count, np.int64),
            x=np.empty((count, agents)),
            y=np.empty((count, agents)),
            vx=np.empty((count, agents)),
            vy=np.empty((count, agents)),
            on_target=np.empty((count, agents), np.bool_),
            alive=np.empty((count, agents), np.bool_),
            memory=np.empty((count, agents, self.swarm.memory.shape[1])),
            target_x=np.empty((count, targets)),
            target_y=np.empty((count, targets)),
            target_present=np.empty((count, targets), np.bool_),
        )


def count_frames(first: int, last: int, every: int | None, tail: int) -> int:
    """Number of frames that steps first..last keep."""
    if every is None:
        return 0
    before = min(last, max(tail, first))
    return (-(-before // every)) - (-(-first // every)) + (last - before)
