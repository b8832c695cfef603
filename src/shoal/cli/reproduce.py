"""shoal reproduce: a paper's figures and claims from our own runs."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from shoal.cli.numbers import MaybeInteger
from shoal.cli.output import write
from shoal.cli.progress import note
from shoal.cli.sweep_progress import sweep_progress

if TYPE_CHECKING:
    from rich.console import Console

    from shoal.paper.results import Reproduction


def reproduce(
    paper: str,
    /,
    *,
    quick: Annotated[bool, Parameter(negative=())] = False,
    readings: Annotated[bool, Parameter(negative=())] = False,
    out: Path | None = None,
    jobs: MaybeInteger = None,
    device: Literal["cpu", "cuda"] = "cpu",
) -> None:
    """Run a paper's experiments, test its claims, and write a report; the same command again resumes.

    Parameters
    ----------
    paper
        oceans2020, aamas2020, or of the authors' later work alife2023 or density2023.
    quick
        20,000 steps, 2 seeds and fewer k instead of 100,000 steps and 5 seeds: minutes instead of half an hour.
    readings
        Of oceans2020: how much of the paper each of 30 readings of it meets, and which meets most.
    out
        Folder of the report and of all runs; default reproduction-PAPER, then -readings, -quick with these options.
    jobs
        Threads, one run each; default one per core.
    device
        Where runs happen: the processor's cores (cpu), or a graphics card (cuda), all at once; see docs/how-to/gpu.md.
    """
    from shoal.cli.options import check_positive
    from shoal.paper.reproduce import reproduce as run_all

    check_positive(jobs=jobs)
    folder = out or Path(f"reproduction-{paper}{'-readings' if readings else ''}{'-quick' if quick else ''}")
    with sweep_progress(folder) as report:
        found = run_all(paper, folder, quick=quick, readings=readings, jobs=jobs, device=device, report=report)
    failed = [row for row in (*found.main, *found.refit, *found.sensitivity) if row["status"] == "failed"]
    if failed:
        note(f"{len(failed)} runs failed, the first: {failed[0]['error']}\n  fix: correct it, then repeat the command")
    (_print_readings if readings else _print_claims)(found)
    write(f"report: {folder / 'report.html'}\n")


def _print_claims(found: "Reproduction") -> None:
    from rich.table import Table

    from shoal.cli.console import print_table, results_console, small_print

    console = results_console()
    table = Table(box=None, padding=(0, 2, 0, 0))
    names = ["as printed", "refit"] if found.refit_claims else ["verdict"]
    for title in ("", *names, "claim, and what was measured"):
        table.add_column(title)
    others = {claim.id: claim for claim in found.refit_claims}
    for claim in found.claims:
        judged = [claim, *([others[claim.id]] if claim.id in others else [])]
        verdicts = [small_print(each.verdict, each.cases.replace(", ", "\n")) for each in judged]
        measured = "\nrefit: ".join(each.measured for each in judged)
        table.add_row(claim.id, *verdicts, small_print(claim.statement, measured))
    print_table(console, table)
    differ = [claim.id for claim in found.claims if claim.id in others and claim.verdict != others[claim.id].verdict]
    if others:
        console.print(f"verdicts that depend on the reading: {', '.join(differ) or 'none'}")
    _print_length(console, found)


def _print_readings(found: "Reproduction") -> None:
    from rich.table import Table

    from shoal.cli.console import print_table, results_console

    console = results_console()
    table = Table(box=None, padding=(0, 2, 0, 0))
    scores = found.tables["readings_scores"]
    for title in ("reading", "trial", "hold", "do not", "score", ""):
        table.add_column(title)
    for row in scores:
        mark = "chosen" if row["chosen"] else "as printed" if row["printed"] else ""
        table.add_row(row["reading"], row["trial"], str(row["hold"]), str(row["do_not"]), f"{row['score']:g}", mark)
    print_table(console, table)
    _print_length(console, found)


def _print_length(console: "Console", found: "Reproduction") -> None:
    length = f"{found.seeds} seeds of {found.steps:,} steps"
    console.print(f"{found.paper}, {length}; in brackets 95 % intervals; {found.seconds:.0f} s", style="dim")
