"""Reproduce a paper: run what is missing, judge its claims, draw its figures, write the report."""

import json
import os
import platform
import shlex
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import numba
import numpy as np

from shoal.core.errors import RecordError, ScenarioError
from shoal.core.files import check_folder, write_atomic
from shoal.core.version import RESULTS_VERSION, VERSION
from shoal.experiments.rows import Row
from shoal.paper.alife_claims import alife_claims
from shoal.paper.claims import oceans_claims
from shoal.paper.clusters import watch_clusters
from shoal.paper.density_claims import density_claims
from shoal.paper.later_plan import DENSITY, EVASIVE
from shoal.paper.plan import (
    PAPERS,
    PRINTED,
    QUICK_STEPS,
    REFIT,
    SENSITIVITY,
    SENSITIVITY_PLACEMENT,
    SPEEDS,
    Group,
    Plan,
    make_plan,
)
from shoal.paper.published import published_claims, residual_table
from shoal.paper.readings_study import STUDY, run_study
from shoal.paper.results import Claim, Reproduction
from shoal.paper.running import Report, run_plan
from shoal.paper.sensitivity import Extra, conclusion_table, peak_table
from shoal.paper.side_claims import side_claims
from shoal.paper.side_watch import watch_sides


def reproduce(
    paper: str,
    out: str | Path,
    *,
    quick: bool = False,
    readings: bool = False,
    jobs: int | None = None,
    device: str = "cpu",
    report: Report | None = None,
) -> Reproduction:
    """Run what is missing under `out`, and return the claims with their verdicts, the tables and the figures.

    The report is written to out/report.html, every run is in the stores under out/runs. Safe to stop at any moment: the
    same call goes on from there; runs that failed are tried again.

    Parameters
    ----------
    paper : oceans2020, aamas2020, alife2023 or density2023
    quick : 20,000 steps, 2 seeds, fewer k
    readings : of oceans2020, instead of its claims, which reading of the paper meets most of them (readings.csv)
    jobs : threads, default one per core
    device : cpu, or cuda: on a graphics card, see docs/how-to/gpu.md
    report : called after every run, with the progress of all sweeps together

    Raises
    ------
    ScenarioError : no such paper, or readings of another one
    RecordError : `out` holds another reproduction, is in use, or cannot be written
    MissingExtraError : matplotlib is not installed; the runs are kept. Or numba-cuda, which device="cuda" needs
    DeviceError : there is no graphics card
    KeyboardInterrupt : interrupted; all finished runs are kept
    """
    if paper not in PAPERS:
        choice = f"choose {', '.join(PAPERS[:-1])} or {PAPERS[-1]}"
        raise ScenarioError(str(paper), "is not a paper that Shoal can reproduce", choice)
    if readings and paper != "oceans2020":
        raise ScenarioError(f"{paper} --readings", "are studied of oceans2020 only", "leave out --readings")
    begun, folder = time.monotonic(), Path(out)
    _claim_folder(folder, STUDY if readings else paper, quick)
    if readings:
        found = run_study(folder, quick=quick, jobs=jobs, device=device, report=report)
    else:
        plan = make_plan(paper, quick=quick)
        rows = run_plan(plan, folder, jobs, report, device)
        found = _JUDGES[paper](plan, rows)
    found.command = _command(paper, folder, quick, readings, jobs, device)
    found.versions = _versions()
    _draw(found)
    found.seconds = time.monotonic() - begun
    _write(found, folder)
    return found


def judge_oceans(plan: Plan, rows: dict[str, list[Row]]) -> Reproduction:
    """Every claim under both readings, the peaks, and what they depend on."""
    variants = [group for group in plan.groups if group.name.startswith(f"{SENSITIVITY}/")]
    sensitivity = [row for group in variants for row in rows[group.name]]
    extras = {group.labels["variant"]: _extra(group, rows) for group in variants}
    readings = ((PRINTED, ""), (REFIT, "refit/"))
    sides = {
        preset: [row for name, group in rows.items() if name.startswith(f"{prefix}side/") for row in group]
        for preset, prefix in readings
    }
    claims = {preset: _judge_reading(plan, rows, sides[preset], preset, prefix) for preset, prefix in readings}
    return Reproduction(
        plan.paper,
        plan.quick,
        plan.steps,
        plan.seeds,
        rows["main"],
        sensitivity,
        claims=claims[PRINTED],
        refit=rows["refit/main"],
        refit_claims=claims[REFIT],
        sides=sides,
        tables={
            "verdicts": verdict_table(claims[PRINTED], claims[REFIT]),
            "peaks": peak_table(rows["main"]),
            "refit_peaks": peak_table(rows["refit/main"]),
            "sensitivity_peaks": peak_table(sensitivity),
            "sensitivity_conclusions": conclusion_table(sensitivity, extras),
        },
    )


def _extra(variant: Group, rows: Mapping[str, list[Row]]) -> Extra:
    """What C11 to C13 need of a variant."""
    steps, seeds = int(variant.changes["steps"]), variant.design.runs
    placement = rows[variant.name.replace(SENSITIVITY, SENSITIVITY_PLACEMENT, 1)]
    return Extra(placement, watch_clusters(min(steps, QUICK_STEPS), seeds, SPEEDS, variant.changes), steps)


def verdict_table(printed: Sequence[Claim], refit: Sequence[Claim]) -> list[Row]:
    """One row per claim: its verdict under both readings, and whether they differ."""
    return [
        {
            "claim": one.id,
            "statement": one.statement,
            "oceans2020": one.verdict,
            "cases": one.cases,
            "oceans2020-refit": other.verdict,
            "refit_cases": other.cases,
            "depends": one.verdict != other.verdict,
        }
        for one, other in zip(printed, refit, strict=True)
    ]


def _judge_reading(
    plan: Plan, rows: dict[str, list[Row]], sides: Sequence[Row], preset: str, prefix: str
) -> list[Claim]:
    """All claims under one reading."""
    main, placement = rows[f"{prefix}main"], rows[f"{prefix}placement"]
    steps = min(plan.steps, QUICK_STEPS)
    episodes = watch_clusters(steps, plan.seeds, SPEEDS, preset=preset)
    claims = oceans_claims(main, placement, episodes, plan.steps)
    return claims + side_claims(main, sides, watch_sides(preset, steps // 2, plan.seeds))


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


def judge_alife(plan: Plan, rows: dict[str, list[Row]]) -> Reproduction:
    """Four statements on mixed fleets after a target that flees."""
    return Reproduction(
        plan.paper, plan.quick, plan.steps, plan.seeds, rows["main"], [], claims=alife_claims(rows), groups=rows
    )


def judge_density(plan: Plan, rows: dict[str, list[Row]]) -> Reproduction:
    """Five statements on the density of a swarm."""
    return Reproduction(
        plan.paper, plan.quick, plan.steps, plan.seeds, rows["side"], [], claims=density_claims(rows), groups=rows
    )


_JUDGES: dict[str, Callable[[Plan, dict[str, list[Row]]], Reproduction]] = {
    "oceans2020": judge_oceans,
    "aamas2020": judge_aamas,
    EVASIVE: judge_alife,
    DENSITY: judge_density,
}


def _claim_folder(out: Path, paper: str, quick: bool) -> None:
    """Remember whose folder this is, or refuse one of another reproduction with a plain sentence."""
    file = out / "plan.json"
    mine = {"paper": paper, "quick": quick}
    check_folder(out, [file.name])
    try:
        out.mkdir(parents=True, exist_ok=True)
        known = json.loads(file.read_text(encoding="utf-8")) if file.exists() else mine
        if not isinstance(known, dict):
            raise ValueError("it is not a plan")
    except OSError as error:
        problem = f"cannot be used: {error.strerror or error}"
        raise RecordError(str(file), problem, "name another folder with --out") from error
    except (ValueError, RecursionError) as error:
        raise RecordError(str(file), f"is damaged: {error}", "name another folder with --out") from error
    if known != mine:
        raise RecordError(
            str(out),
            f"holds the {_kind(known)} reproduction of {known.get('paper')}, not the {_kind(mine)} one of {paper}",
            "name another folder with --out",
        )
    write_atomic(file, (json.dumps(mine) + "\n").encode())


def _kind(plan: dict[str, object]) -> str:
    return "quick" if plan.get("quick") else "full"


def _draw(found: Reproduction) -> None:
    from shoal.paper.figures import (
        make_aamas_figures,
        make_alife_figures,
        make_density_figures,
        make_figures,
        make_study_figures,
    )

    makers = {
        "oceans2020": make_figures,
        "aamas2020": make_aamas_figures,
        STUDY: make_study_figures,
        EVASIVE: make_alife_figures,
        DENSITY: make_density_figures,
    }
    found.figures = makers[found.paper](found)


def _write(found: Reproduction, out: Path) -> None:
    from shoal.paper.report import to_csv, write_report

    if found.paper == STUDY:
        write_atomic(out / "readings.csv", to_csv(found.tables["readings"]).encode())
    write_report(found, out)


def _command(paper: str, out: Path, quick: bool, readings: bool, jobs: int | None, device: str) -> str:
    chosen = [*(["--readings"] if readings else []), *(["--quick"] if quick else [])]
    options = [*chosen, "--out", str(out), *(["--jobs", str(jobs)] if jobs else [])]
    options += ["--device", device] if device != "cpu" else []
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
