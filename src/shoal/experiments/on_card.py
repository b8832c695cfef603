"""Runs of a sweep on a graphics card, as many at once as it takes."""

import time
from collections.abc import Iterable, Iterator
from datetime import UTC, datetime
from itertools import islice

from shoal.core.errors import ShoalError
from shoal.experiments.executors import Done, Executor, Task, in_threads
from shoal.experiments.replicate import numbers_of, reason_of
from shoal.experiments.rows import failed_row
from shoal.run.on_card import AT_ONCE, check_card, check_device, run_on_card
from shoal.run.simulation import Simulation


def executor_on(device: str, jobs: int | None = None) -> Executor:
    """Where runs happen: in threads on the cores of this machine (cpu), or on a graphics card (cuda).

    Raises
    ------
    UnknownNameError : there is no such device
    MissingExtraError, DeviceError : it is not here
    """
    return on_card if check_device(device, ()) else in_threads(jobs)


def on_card(tasks: Iterable[Task]) -> Iterator[Done]:
    """Run on the card, thousands at once; rows come when all of these are done.

    Raises
    ------
    MissingExtraError, DeviceError : there is no card, or it cannot do one of these; nothing has run then
    """
    waiting = list(tasks)
    check_card({id(cell): cell.scenario for cell, _ in waiting}.values())
    rest = iter(waiting)
    while group := list(islice(rest, AT_ONCE)):
        yield from _together(group)


def _together(group: list[Task]) -> Iterator[Done]:
    """Run a group; what one cannot begin or end is its failed row."""
    begun, started = time.perf_counter(), datetime.now(UTC).isoformat(timespec="milliseconds")
    simulations: list[Simulation] = []
    ready: list[Task] = []
    for cell, run in group:
        try:
            simulations.append(Simulation(cell.scenario, run))
            ready.append((cell, run))
        except Exception as failure:  # as `replicate` does: the night's work goes on
            yield cell, run, failed_row(reason_of(failure), started)
    failures: dict[int, ShoalError] = {}
    run_on_card(simulations, fail=failures.__setitem__)
    seconds = (time.perf_counter() - begun) / max(len(ready), 1)
    for number, ((cell, run), simulation) in enumerate(zip(ready, simulations, strict=True)):
        if number in failures:
            yield cell, run, failed_row(reason_of(failures[number]), started)
            continue
        row = {"status": "done", "error": "", **numbers_of(simulation), "started": started, "seconds": seconds}
        yield cell, run, row
