"""Run a plan: one sweep after the other, with one progress over all."""

from collections.abc import Callable
from pathlib import Path

from shoal.experiments.cells import make_cells
from shoal.experiments.on_card import executor_on
from shoal.experiments.results import seal
from shoal.experiments.rows import Row
from shoal.experiments.sweep import Progress, sweep
from shoal.paper.plan import Plan

Report = Callable[[Progress], None]


def run_plan(
    plan: Plan, out: Path, jobs: int | None = None, report: Report | None = None, device: str = "cpu"
) -> dict[str, list[Row]]:
    """Run what is missing, and return the rows of every group with its labels."""
    total = sum(len(make_cells(group.design, group.changes)) * group.design.runs for group in plan.groups)
    execute = executor_on(device, jobs)
    overall = Progress(total=total, before=0)
    rows = {}
    for group in plan.groups:
        before, done, failed = overall.before, overall.done, overall.failed

        def tell(now: Progress, before: int = before, done: int = done, failed: int = failed) -> None:
            overall.before, overall.done, overall.failed = before + now.before, done + now.done, failed + now.failed
            if report:
                report(overall)

        store = out / "runs" / group.name
        found = sweep(group.design, store, changes=group.changes, executor=execute, retry_failed=True, report=tell)
        overall.before += len(found) - (overall.before - before) - (overall.done - done)  # a group with nothing to do
        seal(store, found)
        rows[group.name] = [{**group.labels, **row} for row in found]
    return rows
