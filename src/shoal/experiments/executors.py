"""Where runs happen: in threads here, or on a Dask cluster. Both yield rows as they are done."""

import os
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, cast

from shoal.core.errors import MissingExtraError, ScenarioError
from shoal.core.waiting import first_done
from shoal.experiments.cells import Cell
from shoal.experiments.replicate import Stopped, replicate, replicate_table
from shoal.experiments.rows import Row, failed_row

Task = tuple[Cell, int]
Done = tuple[Cell, int, Row]
Executor = Callable[[Iterable[Task]], Iterator[Done]]


def in_threads(jobs: int | None = None) -> Executor:
    """Run on the cores of this machine; the engine releases the GIL, so threads scale like processes."""

    def execute(tasks: Iterable[Task]) -> Iterator[Done]:
        stop = threading.Event()
        workers = jobs or os.cpu_count() or 1
        queue = iter(tasks)
        pending: dict[Future[Row], Task] = {}
        with ThreadPoolExecutor(workers) as pool:
            try:
                while True:
                    while len(pending) < 2 * workers and (task := next(queue, None)) is not None:
                        pending[pool.submit(replicate, task[0].scenario, task[1], stop)] = task
                    if not pending:
                        return
                    for future in first_done(pending):
                        yield (*pending.pop(future), future.result())
            except Stopped:
                return
            finally:
                stop.set()  # on Ctrl-C every thread ends at its next chunk
                for future in pending:
                    future.cancel()

    return execute


def on_dask(scheduler: str | None = None, workers: int | None = None) -> Executor:
    """Run on a Dask cluster; without the address of a scheduler, on local worker processes.

    A worker that dies loses the runs that it was on; Dask gives them to another.

    Raises
    ------
    MissingExtraError : dask.distributed is absent
    ScenarioError : no scheduler answers
    """
    try:
        import distributed
    except ImportError:
        raise MissingExtraError.of("distributed", "cluster", "running on Dask") from None

    dask: Any = distributed  # untyped

    def execute(tasks: Iterable[Task]) -> Iterator[Done]:
        cluster: Any = None
        if scheduler is None:
            cluster = dask.LocalCluster(
                n_workers=workers or os.cpu_count() or 1, threads_per_worker=1, dashboard_address=None
            )
        try:
            client = dask.Client(cluster or scheduler, timeout="10s")
        except (OSError, TimeoutError) as error:
            raise ScenarioError(
                "--scheduler", f"{scheduler} does not answer: {error}", "start dask scheduler"
            ) from error
        try:
            with client:
                submitted = {_submit(client, cell, run): (cell, run) for cell, run in tasks}
                for future in dask.as_completed(submitted):
                    yield (*submitted[future], _result(future))
        finally:
            if cluster is not None:
                cluster.close()

    return execute


def _submit(client: Any, cell: Cell, run: int) -> Any:
    table = cell.scenario.model_dump(mode="json")
    return client.submit(replicate_table, table, run, key=f"shoal-{cell.run_id(run)}", retries=3)


def _result(future: Any) -> Row:
    """The row of a finished task; one that killed every worker it ran on is a failed row."""
    try:
        return cast(Row, future.result())
    except Exception as failure:
        return failed_row(repr(failure))
