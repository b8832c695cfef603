"""shoal reproduce: a paper's figures and claims from our own runs."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from shoal.cli.output import write
from shoal.cli.progress import note
from shoal.cli.sweep_progress import sweep_progress
from shoal.cli.whole import MaybeWhole

if TYPE_CHECKING:
    from shoal.paper.results import Reproduction


def reproduce(
    paper: str,
    /,
    *,
    quick: Annotated[bool, Parameter(negative=())] = False,
    out: Path | None = None,
    jobs: MaybeWhole = None,
) -> None:
    """Run a paper's experiments, test its claims, and write a report; the same command again resumes.

    Parameters
    ----------
    paper
        oceans2020 or aamas2020.
    quick
        20,000 steps, 2 seeds and fewer k instead of 100,000 steps and 5 seeds: minutes instead of half an hour.
    out
        Folder of the report and of all runs; default reproduction-PAPER, with --quick reproduction-PAPER-quick.
    jobs
        Threads, one run each; default one per core.
    """
    from shoal.cli.options import check_positive
    from shoal.paper.reproduce import reproduce as run_all

    check_positive(jobs=jobs)
    folder = out or Path(f"reproduction-{paper}{'-quick' if quick else ''}")
    with sweep_progress(folder) as report:
        found = run_all(paper, folder, quick=quick, jobs=jobs, report=report)
    failed = [row for row in (*found.main, *found.sensitivity) if row["status"] == "failed"]
    if failed:
        note(f"{len(failed)} runs failed, the first: {failed[0]['error']}\n  fix: mend it, then the same command again")
    _print_claims(found)
    write(f"report: {folder / 'report.html'}\n")


def _print_claims(found: "Reproduction") -> None:
    from rich.table import Table

    from shoal.cli.console import results_console, small_print

    console = results_console()
    table = Table(box=None, padding=(0, 2, 0, 0))
    for title in ("", "verdict", "claim, and what was measured"):
        table.add_column(title)
    for claim in found.claims:
        verdict = small_print(claim.verdict, claim.cases.replace(", ", "\n"))
        table.add_row(claim.id, verdict, small_print(claim.statement, claim.measured))
    console.print(table)
    length = f"{found.seeds} seeds of {found.steps:,} steps"
    console.print(f"{found.paper}, {length}; in brackets 95 % intervals; {found.seconds:.0f} s", style="dim")
