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
from shoal.run.changes import Add, Change, Restart
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
    settings, entries, fields = planned(known, run)
    started = datetime.now(UTC)
    with RecordFolder(out) if out is not None else nullcontext() as folder:
        keep = Keep(settings.scenario, every, 1, folder)
        steered = SteeredRun(settings, recorded=True, sums=True)
        first = steered.simulation
        begun = time.perf_counter()
        frames = _run(steered, entries, keep, fields, progress or (lambda done, total: None))
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


def planned(log: ChangeLog, run: int = 0) -> tuple[Settings, tuple[Entry, ...], list[str]]:
    """Return what one record of a log holds: settings since the last restart, changes to them, fields of memory.

    Raises
    ------
    ScenarioError : there is no such run, it has no step, or its changes are not of what one record can hold
    """
    entries, steps = log.of_run(run), log.last
    if steps < 1:
        raise ScenarioError("log", "is of a run without a step", "save the log later")
    begin = since_restart(entries)
    settings = _after(log.settings(run), entries[:begin]).lasting(steps)
    facts, now = facts_of(settings.scenario), settings
    fields = dict.fromkeys(crew_of(settings.scenario).memory)
    for step, steering in entries[begin:]:
        now = _after(now, (Entry(step, steering),))
        if isinstance(steering, Add) or facts_of(now.scenario) != facts:
            problem = "changes fleets or the size of a report, and a record has one of each"
            raise ScenarioError(f"log, step {step:,}", problem, "look at it: shoal watch --replay-changes")
        fields |= dict.fromkeys(crew_of(now.scenario).memory)
    return settings, entries[begin:], list(fields)


def _after(settings: Settings, entries: tuple[Entry, ...]) -> Settings:
    """What settings are after changes; who was removed is still of them."""
    for _, steering in entries:
        match steering:
            case Change(changes=changes):
                settings = settings.changed(changes)
            case Add(fleet=fleet):
                settings = settings.joined(settings.scenario.fleets[fleet].name)
            case Restart(seed=seed):
                settings = settings.seeded(seed)
    return settings


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
            stop = min(
                [steps, now + chunk_steps(steered.settings.scenario.agents), *(each.step for each in waiting[:1])]
            )
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
