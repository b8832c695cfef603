"""Run a scenario: description in, record out."""

import os
import platform
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numba
import numpy as np

from shoal.core.errors import ScenarioError
from shoal.core.version import RESULTS_VERSION, VERSION
from shoal.core.waiting import first_done
from shoal.metrics.tally import Tally
from shoal.record.files import RecordFolder
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.run.compiling import mark_compiled
from shoal.run.facts import facts_of
from shoal.run.keep import Keep
from shoal.run.on_card import AT_ONCE, check_device, run_on_card
from shoal.run.simulation import Simulation
from shoal.scenario.edit import check_words
from shoal.scenario.load import Source, load
from shoal.scenario.schema import Scenario

ProgressCallback = Callable[[int, int], None]


def simulate(
    scenario: Source,
    *,
    runs: int = 1,
    jobs: int | None = None,
    device: str = "cpu",
    every: int | None = None,
    out: str | Path | None = None,
    progress: ProgressCallback | None = None,
    **changes: Any,
) -> Record:
    """Run a scenario and return its record.

    >>> shoal.simulate("oceans2020", runs=5, steps=20_000, neighbors=10, target_speed="6 kn")

    Parameters
    ----------
    scenario : what to run: a preset's name, a TOML file, a dict or a Scenario
    runs : independent replicates, R; replicate r of two scenarios with one seed shares its chance
    jobs : threads, one run each; default: one per core
    device : cpu, or cuda: all runs at once on a graphics card, for what docs/how-to/gpu.md lists
    every : keep the frame of every n-th step of every run; default: an overview of the first run, of 500 MB at most
    out : write the record to this new folder; trajectories stream there, so memory does not grow with steps
    progress : called as progress(steps done, steps in all) from time to time, from any thread
    changes : to the scenario, in the words of the command line, as in `Scenario.with_`

    Raises
    ------
    ScenarioError, TrackError, StrategyError : what cannot run, or keep so many frames
    RecordError : `out` exists or cannot be written
    MissingExtraError, DeviceError : there is no such device here, or it cannot do this
    """
    for name, number in (("runs", runs), ("jobs", jobs), ("every", every)):
        if number is not None and number < 1:
            raise ScenarioError(name, f"is {number}", "ask for 1 or more")
    check_words(changes, also=("runs", "jobs", "device", "every", "out", "progress"))
    scenario = load(scenario, **changes)
    card = check_device(device, [scenario])
    started = datetime.now(UTC)
    with RecordFolder(out) if out is not None else nullcontext() as folder:
        keep = Keep(scenario, every, runs, folder)
        first = Simulation(scenario)
        first.advance(0)  # compiles here and once, not in every thread
        mark_compiled(scenario)
        begun = time.perf_counter()
        if card:
            results = _run_on_card(scenario, first, runs, keep, progress or _silent)
        else:
            results = _run_all(scenario, first, runs, jobs or os.cpu_count() or 1, keep, progress or _silent)
        record = Record(
            scenario=scenario,
            facts=facts_of(scenario),
            roster=first.roster,
            tallies=tuple(tally for tally, _ in results),
            provenance=provenance(scenario, started, time.perf_counter() - begun, [*first.notes, *keep.notes])
            | ({"device": f"cuda: {card}"} if card else {}),
            trajectories={run: frames for run, (_, frames) in enumerate(results) if frames is not None},
        )
        return folder.finish(record) if folder else record


def provenance(scenario: Scenario, started: datetime, seconds: float, notes: list[str]) -> dict[str, Any]:
    """Where a result comes from."""
    return {
        "steps": scenario.steps,
        "seed": scenario.seed,
        "scenario_hash": scenario.hash,
        "results_version": RESULTS_VERSION,
        "versions": {
            "shoal": VERSION,
            "numba": numba.__version__,
            "numpy": np.__version__,
            "python": platform.python_version(),
        },
        "platform": f"{platform.system()} {platform.machine()}",
        "started": started.isoformat(timespec="seconds"),
        "seconds": round(seconds, 3),  # without compiling
        "notes": notes,
    }


def _run_all(
    scenario: Scenario, first: Simulation, runs: int, jobs: int, keep: Keep, progress: ProgressCallback
) -> list[tuple[Tally, Trajectory | None]]:
    stop = threading.Event()
    done, total, lock = 0, runs * scenario.steps, threading.Lock()

    def count(steps: int) -> None:
        nonlocal done
        with lock:
            done += steps
            progress(done, total)

    def one(run: int) -> tuple[Tally, Trajectory | None]:
        simulation = first if run == 0 else Simulation(scenario, run)
        return _run_one(simulation, keep, stop, count)

    if min(runs, jobs) == 1:
        return [one(run) for run in range(runs)]
    with ThreadPoolExecutor(min(runs, jobs)) as pool:
        tasks = [pool.submit(one, run) for run in range(runs)]
        try:
            waiting = set(tasks)
            while waiting:
                finished = first_done(waiting)
                waiting -= finished
                for task in finished:
                    task.result()  # raises what ended it, without waiting for the others
            return [task.result() for task in tasks]
        except BaseException:
            stop.set()  # every thread ends at its next chunk
            pool.shutdown(cancel_futures=True)
            raise


def _run_on_card(
    scenario: Scenario, first: Simulation, runs: int, keep: Keep, progress: ProgressCallback
) -> list[tuple[Tally, Trajectory | None]]:
    """All runs together, so many at a time that the memory of one machine holds them."""
    results: list[tuple[Tally, Trajectory | None]] = []
    done = 0

    def count(steps: int) -> None:
        nonlocal done
        done += steps
        progress(done, runs * scenario.steps)

    for begin in range(0, runs, AT_ONCE):
        numbers = range(begin, min(begin + AT_ONCE, runs))
        simulations = [first if run == 0 else Simulation(scenario, run) for run in numbers]
        recorded = [keep.all_runs or run == 0 for run in numbers]
        writers = {
            index: keep.folder.trajectory(run, keep.frames)
            for index, run in enumerate(numbers)
            if keep.folder and recorded[index]
        }
        parts: dict[int, list[Trajectory]] = {}

        def take(
            index: int, part: Trajectory, writers: Any = writers, parts: dict[int, list[Trajectory]] = parts
        ) -> None:
            if index in writers:
                writers[index].append(part)
            else:
                parts.setdefault(index, []).append(part)

        try:
            run_on_card(simulations, every=keep.every, tail=keep.tail, recorded=recorded, keep=take, count=count)
        finally:
            for writer in writers.values():
                writer.close()
        results += [
            (each.tally, Trajectory.join(parts[index]) if index in parts else None)
            for index, each in enumerate(simulations)
        ]
    return results


def _run_one(
    simulation: Simulation, keep: Keep, stop: threading.Event, count: Callable[[int], None]
) -> tuple[Tally, Trajectory | None]:
    """Run to the end in chunks, so that progress is seen and an interrupt is heard."""
    steps = simulation.scenario.steps
    records = keep.all_runs or simulation.run == 0
    parts: list[Trajectory] = []
    writer = keep.folder.trajectory(simulation.run, keep.frames) if records and keep.folder else None
    try:
        while simulation.number < steps and not stop.is_set():
            chunk = min(chunk_steps(simulation.scenario.agents), steps - simulation.number)
            part = simulation.advance(chunk, every=keep.every if records else None, tail=keep.tail)
            if part and writer:
                writer.append(part)
            elif part:
                parts.append(part)
            count(chunk)
    finally:
        if writer:
            writer.close()
    return simulation.tally, Trajectory.join(parts) if parts else None


def chunk_steps(agents: int) -> int:
    """Steps of one compiled call: some 20 ms."""
    return max(1, 8_000_000 // (max(agents, 8) * max(agents, 50)))


def _silent(done: int, total: int) -> None:
    """Report nothing."""
