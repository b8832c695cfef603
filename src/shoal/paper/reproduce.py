"""Reproduce a paper: run what is missing, judge its claims, draw its figures, write the report."""

import json
import os
import platform
import shlex
import time
from collections.abc import Callable
from pathlib import Path

import numba
import numpy as np

from shoal.core.errors import RecordError, ScenarioError
from shoal.core.files import check_folder, write_whole
from shoal.experiments.cells import make_cells
from shoal.experiments.executors import in_threads
from shoal.experiments.results import seal
from shoal.experiments.sweep import Progress, sweep
from shoal.paper.claims import oceans_claims
from shoal.paper.clusters import watch_clusters
from shoal.paper.plan import PAPERS, QUICK_STEPS, SPEEDS, Plan, make_plan
from shoal.paper.published import published_claims, residual_table
from shoal.paper.results import Reproduction, Row
from shoal.paper.sensitivity import conclusion_table, peak_table
from shoal.version import RESULTS_VERSION, VERSION

Report = Callable[[Progress], None]


def reproduce(
    paper: str, out: str | Path, *, quick: bool = False, jobs: int | None = None, report: Report | None = None
) -> Reproduction:
    """Run what is missing under `out`, and return the claims with their verdicts, the tables and the figures.

    The report is written to out/report.html, every run is in the stores under out/runs. Safe to stop at any moment: the
    same call goes on from there; runs that failed are tried again.

    Parameters
    ----------
    paper : oceans2020 or aamas2020
    quick : 20,000 steps, 2 seeds, fewer k
    jobs : threads, default one per core
    report : called after every run, with the progress of all sweeps together

    Raises
    ------
    ScenarioError : no such paper
    RecordError : `out` holds another reproduction, is in use, or cannot be written
    MissingExtraError : matplotlib is not installed; the runs are kept
    KeyboardInterrupt : interrupted; all finished runs are kept
    """
    if paper not in PAPERS:
        raise ScenarioError(str(paper), "is no paper that Shoal can reproduce", f"choose {' or '.join(PAPERS)}")
    begun, folder = time.monotonic(), Path(out)
    plan = make_plan(paper, quick=quick)
    _claim_folder(folder, plan)
    rows = run_plan(plan, folder, jobs, report)
    found = (judge_oceans if paper == "oceans2020" else judge_aamas)(plan, rows)
    found.command = _command(paper, folder, quick, jobs)
    found.versions = _versions()
    _draw(found)
    found.seconds = time.monotonic() - begun
    _write(found, folder)
    return found


def run_plan(plan: Plan, out: Path, jobs: int | None = None, report: Report | None = None) -> dict[str, list[Row]]:
    """Run what is missing, and return the rows of every group with its labels."""
    total = sum(len(make_cells(group.design, group.changes)) * group.design.runs for group in plan.groups)
    overall = Progress(total=total, before=0)
    rows = {}
    for group in plan.groups:
        before, done, failed = overall.before, overall.done, overall.failed

        def tell(now: Progress, before: int = before, done: int = done, failed: int = failed) -> None:
            overall.before, overall.done, overall.failed = before + now.before, done + now.done, failed + now.failed
            if report:
                report(overall)

        store = out / "runs" / group.name
        found = sweep(
            group.design, store, changes=group.changes, executor=in_threads(jobs), retry_failed=True, report=tell
        )
        overall.before += len(found) - (overall.before - before) - (overall.done - done)  # a group with nothing to do
        seal(store, found)
        rows[group.name] = [{**group.labels, **row} for row in found]
    return rows


def judge_oceans(plan: Plan, rows: dict[str, list[Row]]) -> Reproduction:
    """Claims C1-C13, the peaks, and what they depend on."""
    main, placement = rows["main"], rows["placement"]
    sensitivity = [row for name, group in rows.items() if name.startswith("sensitivity/") for row in group]
    episodes = watch_clusters(min(plan.steps, QUICK_STEPS), plan.seeds, SPEEDS)
    return Reproduction(
        plan.paper,
        plan.quick,
        plan.steps,
        plan.seeds,
        main,
        sensitivity,
        claims=oceans_claims(main, placement, episodes, plan.steps),
        tables={
            "peaks": peak_table(main),
            "sensitivity_peaks": peak_table(sensitivity),
            "sensitivity_conclusions": conclusion_table(sensitivity),
        },
    )


def judge_aamas(plan: Plan, rows: dict[str, list[Row]]) -> Reproduction:
    """Our numbers beside the published ones."""
    main = [row for group in rows.values() for row in group]
    table = residual_table(main)
    return Reproduction(
        plan.paper,
        plan.quick,
        plan.steps,
        plan.seeds,
        main,
        [],
        claims=published_claims(table),
        tables={"published": table},
    )


def _claim_folder(out: Path, plan: Plan) -> None:
    """Remember whose folder this is, or refuse one of another reproduction with a plain sentence."""
    file = out / "plan.json"
    mine = {"paper": plan.paper, "quick": plan.quick}
    check_folder(out, [file.name])
    try:
        out.mkdir(parents=True, exist_ok=True)
        known = json.loads(file.read_text(encoding="utf-8")) if file.exists() else mine
        if not isinstance(known, dict):
            raise ValueError("it is no plan")
    except OSError as error:
        told = f"cannot be used: {error.strerror or error}"
        raise RecordError(str(file), told, "name another folder with --out") from error
    except (ValueError, RecursionError) as error:
        raise RecordError(str(file), f"is damaged: {error}", "name another folder with --out") from error
    if known != mine:
        raise RecordError(
            str(out),
            f"holds the {_kind(known)} reproduction of {known.get('paper')}, not the {_kind(mine)} one of {plan.paper}",
            "name another folder with --out",
        )
    write_whole(file, (json.dumps(mine) + "\n").encode())


def _kind(plan: dict[str, object]) -> str:
    return "quick" if plan.get("quick") else "full"


def _draw(found: Reproduction) -> None:
    from shoal.paper.figures import make_aamas_figures, make_figures

    found.figures = (make_figures if found.paper == "oceans2020" else make_aamas_figures)(found)


def _write(found: Reproduction, out: Path) -> None:
    from shoal.paper.report import write_report

    write_report(found, out)


def _command(paper: str, out: Path, quick: bool, jobs: int | None) -> str:
    options = [*(["--quick"] if quick else []), "--out", str(out), *(["--jobs", str(jobs)] if jobs else [])]
    return shlex.join(["shoal", "reproduce", paper, *options])


def _versions() -> dict[str, str]:
    return {
        "shoal": VERSION,
        "results": str(RESULTS_VERSION),
        "numba": numba.__version__,
        "numpy": np.__version__,
        "python": platform.python_version(),
        "platform": f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores",
    }
