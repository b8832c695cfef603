"""Simulation: one run of a scenario that can be advanced, looked at, saved and resumed at any step."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from shoal.core.agents import NEVER, REPORT_BYTES, Minds, Swarm, as_records, new_swarm
from shoal.core.errors import RecordError, ScenarioError, StrategyError
from shoal.core.files import whole_file
from shoal.core.kernel import cache_folder, uncached
from shoal.core.phase import put
from shoal.engine.phases import PHASES, Addresses
from shoal.engine.rollout import begin_run, rollout, set_out
from shoal.engine.stage import Frames, Stage, new_scratch
from shoal.metrics.summary import Facts
from shoal.metrics.tally import new_tally
from shoal.record.trajectory import Trajectory
from shoal.scenario.crew import Crew, crew_of
from shoal.scenario.schema import Scenario
from shoal.scenario.strategy_errors import strategy_errors
from shoal.scenario.targets import (
    DriftTarget,
    EvasiveTarget,
    MovingTarget,
    StillTarget,
    TrackTarget,
    WalkTarget,
    WaypointTarget,
)
from shoal.scenario.tracks import Track, read_track
from shoal.version import RESULTS_VERSION
from shoal.world.arena import World
from shoal.world.placement import PLACES
from shoal.world.radio import Radio, new_radio
from shoal.world.targets import KINDS, TARGET, Tracks

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
        self.world = _build_world(scenario)
        self.swarm = _build_swarm(scenario, self.crew)
        self.radio = _build_radio(scenario, self.crew, self.swarm.x.size)
        tracks = open_tracks(scenario)
        self.notes = [note for track in tracks for note in track.notes]
        self.targets, self.tracks = _build_targets(scenario, tracks)
        self.minds = Minds(
            memory=as_records(self.swarm.memory, self.memory_fields),
            told=as_records(self.swarm.told, self.crew.told),
            arrived=as_records(self.radio.told, self.crew.told),
        )
        batches = min(BATCHES, scenario.steps)
        self.tally = new_tally(scenario.steps, batches, len(scenario.fleets), scenario.agents, len(scenario.targets))
        self._scratch = new_scratch(self.world, self.swarm.x.size)
        self._begin, self._rollout = _compiled(self.crew)
        self._seed = np.uint64(scenario.seed)
        places = np.array([PLACES.index(fleet.start) for fleet in scenario.fleets])
        lifetimes = np.array([fleet.mean_lifetime or 0.0 for fleet in scenario.fleets])
        here, held = put(self._stage(self._new_frames(0)))
        self._phases = Addresses._make(phase.address() for phase in PHASES)
        _set_out(here, places, lifetimes, _losses(scenario), self._seed, run)
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
            strategy = self.crew
            raise StrategyError(
                strategy.source,
                f"strategy {strategy.name!r} wanted a velocity that is no finite number, before step {self.number}",
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


def facts_of(scenario: Scenario) -> Facts:
    """What metrics need to know of a scenario."""
    fleets = scenario.fleets
    return Facts(
        fleets=tuple(fleet.name for fleet in fleets),
        counts=tuple(scenario.counts),
        max_speeds=tuple(fleet.max_speed for fleet in fleets),
        unit=scenario.unit,
        time_step=scenario.time_step,
        area=scenario.area.width * scenario.area.height,
        report_bytes=REPORT_BYTES + 8 * len(crew_of(scenario).told),
    )


def count_frames(first: int, last: int, every: int | None, tail: int) -> int:
    """Number of frames that steps first..last keep."""
    if every is None:
        return 0
    before = min(last, max(tail, first))
    return (-(-before // every)) - (-(-first // every)) + (last - before)


def needs_compiling(scenario: Scenario) -> bool:
    """Whether the first step will compile the engine for this strategy (once per version, about 10 s)."""
    crew = crew_of(scenario)
    return not crew.builtin or not _compiled_mark(crew.name).exists()


def engine_is_compiled() -> bool:
    """Whether the parts of the engine that know no strategy are in the cache."""
    return any(cache_folder().glob("compiled-*"))


def mark_compiled(scenario: Scenario) -> None:
    """Remember that this strategy's engine is in the cache."""
    crew = crew_of(scenario)
    if crew.builtin:
        try:
            _compiled_mark(crew.name).touch()
        except OSError:
            return  # only a message depends on it


def _compiled_mark(name: str) -> Path:
    return cache_folder() / f"compiled-{name}"


_UNCACHED: dict[Any, tuple[Any, Any]] = {}


def _compiled(strategy: Crew) -> tuple[Any, Any]:
    """begin_run and rollout: from the cache for our own strategies, fresh ones for a user's."""
    if strategy.builtin:
        return begin_run, rollout
    kind = tuple(each.params for each in strategy.strategies)
    if kind not in _UNCACHED:
        _UNCACHED[kind] = (uncached(begin_run), uncached(rollout))
    return _UNCACHED[kind]


def _build_world(scenario: Scenario) -> World:
    area, fleets = scenario.area, scenario.fleets
    return World(
        agents=scenario.agents,
        fleets=len(scenario.fleets),
        time_step=scenario.time_step,
        half_x=area.width / 2,
        half_y=area.height / 2,
        clamp_x=area.width / 2 - area.agent_margin,
        clamp_y=area.height / 2 - area.agent_margin,
        sequential=scenario.motion.update_order == "sequential",
        divide=scenario.motion.speed_rule == "divide",
        inertial=any(fleet.max_acceleration or fleet.max_turn_rate for fleet in fleets),
        imperfect=any(fleet.detection_probability < 1 or fleet.false_alarm_probability > 0 for fleet in fleets),
        mortal=_is_mortal(scenario),
        target_radius=min(target.radius for target in scenario.targets),
    )


def _is_mortal(scenario: Scenario) -> bool:
    return bool(scenario.losses or scenario.joins or any(fleet.mean_lifetime for fleet in scenario.fleets))


def _build_swarm(scenario: Scenario, crew: Crew) -> Swarm:
    """Agents in the order of the fleets, nowhere yet; those who join later are the last of their fleet."""
    agents, fleets, counts = scenario.agents, scenario.fleets, scenario.counts
    swarm = new_swarm(counts, crew.memory, crew.told)

    def fill(array: Any, values: list[Any]) -> None:
        array[:agents] = np.repeat(values, counts)

    fill(swarm.max_speed, [fleet.max_speed for fleet in fleets])
    fill(swarm.sensor_radius, [fleet.sensor_radius for fleet in fleets])
    fill(swarm.detection, [fleet.detection_probability for fleet in fleets])
    fill(swarm.false_alarm, [fleet.false_alarm_probability for fleet in fleets])
    fill(swarm.max_acceleration, [fleet.max_acceleration or math.inf for fleet in fleets])
    fill(swarm.max_turn_rate, [math.radians(fleet.max_turn_rate or math.inf) for fleet in fleets])
    degrees = [
        "all" if strategy.hears_all else fleet.neighbors or scenario.network.neighbors
        for strategy, fleet in zip(crew.strategies, fleets, strict=True)
    ]
    fill(swarm.neighbors, [agents - 1 if degree == "all" else degree for degree in degrees])
    swarm.share_end[:agents] = np.cumsum(swarm.max_speed[:agents]) / swarm.max_speed[:agents].sum()
    nobody = swarm.fleet_end - [
        sum(join.count for join in scenario.joins if join.fleet == each.name) for each in fleets
    ]
    for join in scenario.joins:
        fleet = scenario.fleet_names.index(join.fleet)
        swarm.joins[nobody[fleet] : nobody[fleet] + join.count] = join.step
        nobody[fleet] += join.count
    return swarm


def _build_radio(scenario: Scenario, crew: Crew, lanes: int) -> Radio:
    network, adaptive = scenario.network, scenario.network.adaptive
    radio = new_radio(
        lanes,
        crew.told,
        limited=network.range is not None or network.delay > 0 or _is_mortal(scenario),
        reach=network.range or math.inf,
        delay=network.delay,
        loss=network.loss,
        degree=(adaptive.fewest, adaptive.most, adaptive.patience) if adaptive else None,
    )
    everybody = np.repeat([strategy.hears_all for strategy in crew.strategies], scenario.counts)
    for limit in (radio.fewest, radio.most):
        limit[: scenario.agents][everybody] = scenario.agents - 1
    return radio


def _losses(scenario: Scenario) -> Any:
    """Step, fleet (-1: any) and count of every loss, in the order of the steps, (C, 3)."""
    names = scenario.fleet_names
    rows = [[loss.step, names.index(loss.fleet) if loss.fleet else -1, loss.count] for loss in scenario.losses]
    return np.array(sorted(rows), np.int64).reshape(-1, 3)


def open_tracks(scenario: Scenario) -> list[Track]:
    """Read the recorded tracks of a scenario, in the order of its targets.

    Raises
    ------
    TrackError : one cannot be used
    ScenarioError : one is not what the scenario was made with
    """
    return [_open_track(target, scenario) for target in scenario.targets if isinstance(target, TrackTarget)]


def _build_targets(scenario: Scenario, tracks: Sequence[Track]) -> tuple[Any, Tracks]:
    """One record per target; the fixes of recorded ones behind each other."""
    targets = np.zeros(len(scenario.targets), TARGET).view(np.recarray)
    unread = list(tracks)
    first_fix = 0
    for record, target in zip(targets, scenario.targets, strict=True):
        record["kind"] = KINDS.index(target.kind)
        record["radius"] = target.radius
        record["present"] = 1
        record["lost"] = -1
        if isinstance(target, StillTarget):
            record["x"], record["y"] = target.x, target.y
        elif isinstance(target, MovingTarget):
            _fill_moving(record, target, scenario)
        else:
            track = unread.pop(0)
            record["first_fix"] = first_fix
            record["fixes"] = track.time.size
            record["max_gap"] = track.max_gap
            first_fix += track.time.size
    return targets, _join_tracks(tracks)


def _fill_moving(record: Any, target: MovingTarget, scenario: Scenario) -> None:
    """What a target's rule says; fields of the same name are the same thing."""
    record["half_x"] = scenario.area.width / 2 - target.margin
    record["half_y"] = scenario.area.height / 2 - target.margin
    for name, value in target.model_dump(exclude={"kind", "margin", "max_turn", "persistence"}).items():
        record[name] = value or 0.0
    if isinstance(target, WaypointTarget | EvasiveTarget):
        record["turn_cos"] = math.cos(math.radians(target.max_turn))
        record["turn_sin"] = math.sin(math.radians(target.max_turn))
    if isinstance(target, WalkTarget | EvasiveTarget | DriftTarget):
        record["diffusion"] = 1.0 / target.persistence


def _open_track(target: TrackTarget, scenario: Scenario) -> Track:
    track = read_track(
        target.file,
        track_id=target.id,
        origin=scenario.area.origin,
        max_gap=target.max_gap,
        max_speed=target.max_speed,
    )
    if target.digest not in (None, track.digest):
        raise ScenarioError(
            target.file, "does not hold the track that this scenario was made with", "restore it, or drop `digest`"
        )
    return track


def _join_tracks(tracks: Sequence[Track]) -> Tracks:
    if not tracks:
        return Tracks(np.zeros(1), np.zeros(1), np.zeros(1))
    return Tracks(*(np.concatenate([getattr(track, name) for track in tracks]) for name in ("time", "x", "y")))
