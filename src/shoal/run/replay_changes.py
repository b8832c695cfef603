"""Make a steered run again from its log of changes: unwatched, and as one record."""

import hashlib
import time
from contextlib import nullcontext
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from shoal.core.errors import ScenarioError
from shoal.record.files import LOG, RecordFolder
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.run.change_log import ChangeLog, Entry, read_log, since_restart, told
from shoal.run.changes import Change, Restart
from shoal.run.facts import facts_of
from shoal.run.keep import Keep
from shoal.run.settings import Settings
from shoal.run.simulate import ProgressCallback, chunk_steps, provenance
from shoal.run.steered import SteeredRun
from shoal.scenario.crew import crew_of


def replay_changes(
    log: str | Path | ChangeLog,
    *,
    run: int = 0,
    every: int | None = None,
    out: str | Path | None = None,
    progress: ProgressCallback | None = None,
) -> Record:
    """Make a run again that was changed while it was watched, from its last restart on, and return its record.

    The same changes at the same steps: the same bits. The record's scenario is what the run began with; its numbers are
    over all of its steps, whatever the swarm was set to; `record.steered` says what was changed, and when.

    Parameters
    ----------
    log : file that the page saved, or what `read_log` made of it
    run : 0, or 1 of the second of two runs side by side
    every : keep the frame of every n-th step; default: an overview, and the last steps
    out : write the record and the log to this new folder
    progress : called as progress(steps done, steps in all) from time to time

    Raises
    ------
    ScenarioError : not a log, one of another scenario, or of changes that no single record can hold: of fleets
    TrackError, StrategyError : what cannot run
    RecordError : `out` exists or cannot be written
    """
    known = log if isinstance(log, ChangeLog) else read_log(log)
    if every is not None and every < 1:
        raise ScenarioError("every", f"is {every}", "ask for 1 or more")
    entries, steps = known.of_run(run), known.last
    if steps < 1:
        raise ScenarioError("log", "is of a run without a step", "save the log later")
    begin = since_restart(entries)
    settings = _after(known.settings(run), entries[:begin]).lasting(steps)
    entries = entries[begin:]
    begun, started = time.perf_counter(), datetime.now(UTC)
    with RecordFolder(out) if out is not None else nullcontext() as folder:
        keep = Keep(settings.scenario, every, 1, folder)
        steered = SteeredRun(settings, recorded=True, sums=True)
        first = steered.simulation
        frames = _run(steered, entries, keep, _fields(settings, entries), progress or (lambda done, total: None))
        notes = [*first.notes, *keep.notes, *filter(None, [known.note])]
        record = Record(
            scenario=settings.scenario,
            facts=facts_of(settings.scenario),
            roster=first.roster,
            tallies=(steered.simulation.tally,),
            provenance=provenance(settings.scenario, started, time.perf_counter() - begun, notes)
            | {"scenario_hash": _identity(settings, entries), "steered": told(entries)},
            trajectories={} if frames is None else {0: frames},
        )
        if not folder:
            return record
        folder.add(LOG, known.text())
        return folder.finish(record)


def _after(settings: Settings, entries: tuple[Entry, ...]) -> Settings:
    """The settings that a restart begins with, after changes; who was removed is back."""
    for _, steering in entries:
        match steering:
            case Change(changes=changes):
                settings = settings.changed(changes)
            case Restart(seed=seed):
                settings = settings.seeded(seed)
            case _ if steering.do == "add":
                raise ScenarioError("log", "adds buoys, and a record has one roster", "watch it with --replay-changes")
    return settings


def _fields(settings: Settings, entries: tuple[Entry, ...]) -> list[str]:
    """Names of everything that agents ever remember."""
    names = dict.fromkeys(crew_of(settings.scenario).memory)
    for _, steering in entries:
        if isinstance(steering, Change):
            settings = settings.changed(steering.changes)
            names |= dict.fromkeys(crew_of(settings.scenario).memory)
    return list(names)


def _run(
    steered: SteeredRun, entries: tuple[Entry, ...], keep: Keep, fields: list[str], progress: ProgressCallback
) -> Trajectory | None:
    """Run to the end of the settings, steered on the way; frames go to the folder, if there is one."""
    steps = steered.settings.scenario.steps
    parts: list[Trajectory] = []
    writer = keep.folder.trajectory(0, keep.frames) if keep.folder else None
    waiting = list(entries)
    try:
        while (now := steered.simulation.number) < steps or waiting:
            while waiting and waiting[0].step <= now:
                steered.steer(waiting.pop(0).steering)
            stop = min([steps, now + chunk_steps(steered.settings.scenario.agents), *(each.step for each in waiting[:1])])
            part = steered.simulation.advance(stop - now, every=keep.every, tail=keep.tail)
            if part:
                (writer.append if writer else parts.append)(_with_fields(part, fields))
            progress(stop, steps)
    finally:
        if writer:
            writer.close()
    return Trajectory.join(parts) if parts else None


def _with_fields(part: Trajectory, fields: list[str]) -> Trajectory:
    """Frames with every field of memory; 0 where agents have none of this name."""
    arrays = part.arrays()
    none = np.zeros_like(part.x)
    memory = {f"memory.{name}": arrays.pop(f"memory.{name}", none) for name in fields}
    return Trajectory.from_arrays(arrays | memory)


def _identity(settings: Settings, entries: tuple[Entry, ...]) -> str:
    """What was run: a scenario and the changes to it. No other run is taken for it."""
    if not entries:
        return settings.scenario.hash
    said = repr([(step, steering.model_dump()) for step, steering in entries])
    return f"{settings.scenario.hash}-steered-{hashlib.sha256(said.encode()).hexdigest()[:8]}"
