"""What must be true of bodies, and of the log of what they did, whatever the buoys are told and do."""

import hashlib

import numpy as np

from shoal.buoy.tether import Commands, Tick
from shoal.record.frames import trajectory_sha256
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.run.fleet.invariants import BrokenInvariantError, demand
from shoal.run.fleet.log import Log
from shoal.run.fleet.ocean import Ocean
from shoal.scenario.crew import crew_of
from shoal.scenario.schema import Scenario

SILENCE = 1.0  # seconds without a command after which a body must stop: of the rule, not of its code
_SLIGHT = 1e-9


class SeaWatch:
    """Sees every command and every frame of a fleet.

    Parameters
    ----------
    scenario : of the fleet; ocean : that it is in
    """

    def __init__(self, scenario: Scenario, ocean: Ocean) -> None:
        agents = scenario.agents
        self._scenario = scenario
        self._top = np.array([fleet.max_speed for fleet in scenario.fleets for _ in range(fleet.count)])
        area = scenario.area
        self._half = np.array([area.width, area.height]) / 2 - area.agent_margin
        self._quiet = max(2, round(SILENCE / scenario.time_step))
        self._wants = np.zeros((agents, 2))
        self._memory = np.zeros((agents, len(crew_of(scenario).memory)))
        self._said = np.zeros(agents, np.int64)
        self._silent: dict[int, int] = {}
        self._notes: list[str] = []
        self._alive = ocean.alive
        self._lost: list[tuple[int, int]] = []
        self._hash, self._minds = hashlib.sha256(), hashlib.sha256()
        self._before: Trajectory | None = None

    def check_tick(self, tick: Tick, ocean: Ocean) -> None:
        """Instruments say what is so: of the buoys that are there, in their order.

        Raises
        ------
        BrokenInvariantError : they say anything else
        """
        self._minds.update(self._memory.tobytes())
        swarm, said = ocean.simulation.swarm, tick.readings
        here = np.flatnonzero(self._alive)
        demand("instruments are those of who is there", said["id"].tolist(), here.tolist())
        demand("who is there is known", tick.alive.tolist(), self._alive.tolist())
        for name, true in zip(("x", "y", "vx", "vy"), (swarm.fix_x, swarm.fix_y, swarm.vx, swarm.vy), strict=True):
            if not np.array_equal(said[name], true[here]):
                raise BrokenInvariantError("instruments say what is so", f"{name} in step {tick.step}")
        if not np.array_equal(said["on_target"], swarm.on_target[here] > 0):
            raise BrokenInvariantError("instruments say what is so", f"on_target in step {tick.step}")

    def note(self, commands: Commands, now: int) -> None:
        """Note what buoys want from now on."""
        self._wants[commands.ids] = commands.wants
        self._said[commands.ids] = now
        self._memory[commands.ids] = commands.memory

    def lose(self, now: int, ids: tuple[int, ...]) -> None:
        """Note who is lost."""
        self._lost += [(now, id) for id in ids]
        self._alive[list(ids)] = False

    def check_before(self, now: int, ocean: Ocean, log: Log) -> None:
        """Before a step bodies want what buoys decided last, and nothing if they have said nothing for too long.

        Raises
        ------
        BrokenInvariantError : they want anything else, or the wrong ones are there
        """
        silent = (now - self._said > self._quiet) & self._alive
        self._wants[silent] = 0.0
        for id in np.flatnonzero(silent).tolist():
            self._silent.setdefault(id, int(self._said[id]))
        for id in [id for id in self._silent if not silent[id]]:
            self._notes.append(f"buoy {id} was silent from step {self._silent.pop(id):,} to {now:,}")
        found = ocean.simulation.swarm.memory[: len(self._alive), :2]
        demand("the silent stop", found[silent].any(), False)
        if not np.array_equal(found[self._alive], self._wants[self._alive]):
            raise BrokenInvariantError("bodies do what was decided last", f"in step {now}")
        demand("the log has every silence", log.notes, self._notes)

    def check_after(self, frame: Trajectory, ocean: Ocean, log: Log) -> None:
        """After a step everybody is within what it can do and where it may be, and the log has the step.

        Raises
        ------
        BrokenInvariantError : not so
        """
        now = ocean.number
        swarm = ocean.simulation.swarm
        place = np.stack([swarm.x, swarm.y], axis=1)[: len(self._alive)]
        numbers = np.stack([swarm.vx, swarm.vy], axis=1)[: len(self._alive)]
        if not (np.isfinite(place).all() and np.isfinite(numbers).all()):
            raise BrokenInvariantError("every number is finite", f"after step {now}")
        if (np.abs(place[self._alive]) > self._half + _SLIGHT).any():
            raise BrokenInvariantError("nobody leaves the arena", f"after step {now}: {np.abs(place).max(axis=0)}")
        made = np.hypot(*(place - np.stack([frame.x[0], frame.y[0]], axis=1)).T) / self._scenario.time_step
        if (made > self._top + _SLIGHT).any() or (np.hypot(*numbers.T) > self._top + _SLIGHT).any():
            raise BrokenInvariantError("nobody is faster than its make", f"after step {now}: {made.max():g} m/s")
        stopped = list(self._silent)
        demand("the silent stop", bool(made[stopped].any()), False)
        demand("the lost are gone, the others are there", frame.alive[0].tolist(), self._alive.tolist())
        demand("the log has every step", log.steps, now)
        demand("the log has every loss", log.lost, self._lost)
        self._hash.update(frame.x.astype("<f8").tobytes() + frame.y.astype("<f8").tobytes())
        if self._before is not None:
            demand("steps follow each other", int(frame.step[0]), int(self._before.step[0]) + 1)
        self._before = frame

    def check_record(self, record: Record) -> None:
        """The record has every frame to the bit, and everything that befell buoys.

        Raises
        ------
        BrokenInvariantError : not so
        """
        frames, steps = record.trajectories[0], self._scenario.steps
        demand("the record has every frame", trajectory_sha256(frames, steps), self._hash.hexdigest())
        memories = np.stack(list(frames.memory.values()), axis=-1)
        demand("the record has every memory", hashlib.sha256(memories.tobytes()).hexdigest(), self._minds.hexdigest())
        named = [(loss.step, id) for loss in record.scenario.losses for id in loss.agents or ()]
        demand("the record has every loss", sorted(named), sorted(self._lost))
        still = [f"buoy {id} was silent from step {since:,} on" for id, since in sorted(self._silent.items())]
        found = [note for note in record.provenance["notes"] if "was silent" in note]
        demand("the record has every silence", found, self._notes + still)
