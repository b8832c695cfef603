"""What a fleet did, as a record: every step, who was lost when, and what went wrong on the way."""

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from io import BytesIO
from tempfile import TemporaryFile
from time import perf_counter
from typing import IO, Any

import numpy as np
import numpy.typing as npt

from shoal.buoy.named import buoys_of
from shoal.record.files import RecordFolder
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.run.facts import facts_of
from shoal.run.fleet.ocean import Ocean
from shoal.run.simulate import provenance
from shoal.run.simulation import Simulation
from shoal.scenario.commands import Command
from shoal.scenario.crew import crew_of
from shoal.scenario.frozen import MOST_ENTRIES
from shoal.scenario.presence import Loss
from shoal.scenario.schema import Scenario

Onlooker = Callable[[Simulation, Trajectory, Collection[int]], None]  # told the run, the frame, and who is silent


class Log:
    """Everything that a fleet does, step by step.

    Parameters
    ----------
    ocean : that it is in
    folder : what the record is written to, frame by frame; default: it is kept in memory
    onlooker : told of every frame before the step that begins with it; default: nobody is

    Attributes
    ----------
    steps : that are kept
    lost : step and number of every buoy that was lost and that the scenario does not lose
    silent : who is there and says nothing, by number
    commands : what buoys were told on their way beside the scenario's, and obeyed
    notes : what else is to be told
    """

    def __init__(self, ocean: Ocean, folder: RecordFolder | None = None, onlooker: Onlooker | None = None) -> None:
        self.steps = 0
        self.lost: list[tuple[int, int]] = []
        self.silent: Collection[int] = ()
        self.commands: list[Command] = []
        self.notes: list[str] = []
        if onlooker:
            ocean.on_step = lambda frame: onlooker(ocean.simulation, self._as_buoys_have_it(frame), self.silent)
        self._ocean = ocean
        self._fields = crew_of(ocean.simulation.scenario).memory
        self._folder = folder
        self._writer = folder and folder.trajectory(ocean.simulation.run, ocean.simulation.scenario.steps)
        self._frames: list[Trajectory] = []
        self._wants: IO[bytes] = TemporaryFile() if folder else BytesIO()  # noqa: SIM115  # `close` does
        self._memory = np.zeros((ocean.simulation.scenario.agents, len(self._fields)))
        self._heard: npt.NDArray[np.bool_] | None = None
        self._begun, self._started = perf_counter(), datetime.now(UTC)

    def remember(self, ids: npt.NDArray[np.int32], memory: npt.NDArray[np.float64]) -> None:
        """Note what buoys remember now, (n, M)."""
        self._memory[ids] = memory

    def hear(self, ids: npt.NDArray[np.int32], heard: npt.NDArray[np.bool_] | None) -> None:
        """Note whom buoys heard in the step that comes, (n, N); who decides nothing in it hears nobody."""
        if heard is not None and heard.shape[1] == len(self._memory):
            self._heard = np.zeros((len(self._memory),) * 2, np.bool_) if self._heard is None else self._heard
            self._heard[ids] = heard

    def keep(self, frame: Trajectory) -> None:
        """Keep the frame of a step, which began with what buoys remembered; puppets remember what they want."""
        self._wants.write(np.stack([frame.memory["want_x"][0], frame.memory["want_y"][0]], axis=1).tobytes())
        whole = self._as_buoys_have_it(frame)
        if self._writer:
            self._writer.append(whole)
        else:
            self._frames.append(whole)
        self.steps += 1
        if self._heard is not None:
            self._heard[:] = False

    def _as_buoys_have_it(self, frame: Trajectory) -> Trajectory:
        """The sea's frame with what the buoys remember, and whom they heard if they said so."""
        memory = {name: self._memory[None, :, m].copy() for m, name in enumerate(self._fields)}
        if self._heard is None or not frame.links.size:
            return replace(frame, memory=memory)
        heard = self._heard & frame.alive[0][:, None]
        return replace(frame, memory=memory, links=np.packbits(heard, axis=1, bitorder="little")[None])

    def lose(self, step: int, ids: list[int]) -> None:
        """Note who was lost at a step."""
        self.lost += [(step, id) for id in ids]

    def heed(self, facts: dict[str, Any]) -> None:
        """Note what buoys say of an order: that they obey it, or why not."""
        if "refused" in facts:
            self.notes.append(str(facts["refused"]))
        else:
            command = Command.model_validate(facts["command"])
            self.commands.append(command)
            self._ocean.order(command)

    def record(self, notes: list[str]) -> Record:
        """Return the record of the steps done, and finish its folder.

        Its scenario is that of the run with the buoys lost, and as many steps as were done.

        Raises
        ------
        RecordError : the folder cannot be written
        """
        planned = self._ocean.simulation
        scenario = as_it_was(planned.scenario, self._ocean.leaves, self.lost, self.steps, self.commands)
        tally = planned.tally if scenario.steps == planned.scenario.steps else self._counted_again(scenario)
        said = [*planned.notes, *self.notes, *map(_told, together(self.commands, scenario.agents)), *notes]
        about = provenance(scenario, self._started, perf_counter() - self._begun, said)
        self.close()
        if self._folder and self._writer:
            if self.steps < planned.scenario.steps:
                self._writer.cut(self.steps)
            return self._folder.finish(Record(scenario, facts_of(scenario), planned.roster, (tally,), about, {}))
        frames = {planned.run: Trajectory.join(self._frames)}
        return Record(scenario, facts_of(scenario), planned.roster, (tally,), about, frames)

    def close(self) -> None:
        """Close its files; without `record`, nothing is left of them."""
        self._wants.close()
        if self._writer:
            self._writer.close()

    def _counted_again(self, scenario: Scenario) -> Any:
        """The sums of a run that ended early, in the batches of its length."""
        again = Ocean(scenario, self._ocean.simulation.run)
        everybody = np.arange(scenario.agents, dtype=np.int32)
        self._wants.seek(0)
        for _ in range(self.steps):
            again.obey(everybody, np.frombuffer(self._wants.read(16 * scenario.agents)).reshape(-1, 2))
            again.advance()
        return again.simulation.tally


def together(commands: list[Command], agents: int) -> list[Command]:
    """Commands to the buoys of several processes as one, where they are alike and of one step."""
    found: dict[tuple[int, str], list[Command]] = {}
    for command in commands:
        found.setdefault((command.step, command.words), []).append(command)
    joined = []
    for alike in found.values():
        ids = sorted({id for command in alike for id in command.agents})
        joined.append(alike[0].model_copy(update={"agents": [] if len(ids) == agents else ids}))
    return joined


def _told(command: Command) -> str:
    who = buoys_of(command.agents) if command.agents else "all"
    return f"ordered by mesh, from step {command.step:,} on: {command.words}: {who}"


def as_it_was(
    scenario: Scenario,
    leaves: npt.NDArray[np.int64],
    lost: list[tuple[int, int]],
    steps: int,
    commands: Sequence[Command] = (),
) -> Scenario:
    """The scenario that does in the simulator what the fleet did: these agents are lost, so many steps are done.

    What buoys were told on their way are commands of it, as many as a scenario can have.

    Where any are lost, those that the scenario loses by lot are named, too: fewer would take part in the lots.
    """
    changes: dict[str, Any] = {"steps": steps}
    if commands:
        told = [*scenario.commands, *together(list(commands), scenario.agents)][:MOST_ENTRIES]
        changes["commands"] = tuple(sorted(told, key=lambda command: command.step))
    if lost:
        gone = {id for _, id in lost}
        meant = {loss.step for loss in scenario.losses}
        named = [*lost, *((step, id) for id, step in enumerate(leaves.tolist()) if step in meant and id not in gone)]
        changes["losses"] = tuple(
            Loss(step=step, agents=tuple(sorted(id for then, id in named if then == step)))
            for step in sorted({step for step, _ in named})
        )
    return Scenario.model_validate({**dict(scenario), **changes})
