"""shoal results, shoal plot: what a sweep found."""

import json
from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import Parameter

from shoal.cli.older import tell_of_version
from shoal.cli.output import write
from shoal.cli.progress import note


def results(
    folder: Path,
    /,
    *,
    by: str | None = None,
    metric: str = "time_on_target,xi,engaged",
    csv: Annotated[bool, Parameter(negative=())] = False,
    json_: Annotated[bool, Parameter(name="--json", negative=())] = False,
    parquet: Path | None = None,
) -> None:
    """Print means and 95 % intervals of a sweep, over the runs of each group.

    Parameters
    ----------
    folder
        The sweep's --out.
    by
        Fields to group by, such as neighbors,fast; default all that vary. Fields left out are pooled: their
        differences then widen the interval.
    metric
        What the table shows, such as time_on_target,first_empty,cost; CSV, JSON and parquet hold all.
    csv
        Print every run as CSV instead.
    json_
        Print every run as one JSON list instead.
    parquet
        Write every run to this parquet file instead.
    """
    from shoal.core.errors import ScenarioError
    from shoal.core.files import check_file
    from shoal.experiments.results import aggregate, read_rows, to_csv, unknown_metrics, write_parquet

    shown = _known(metric.split(","))
    kinds = [name for name, given in (("--csv", csv), ("--json", json_), ("--parquet", parquet)) if given]
    if len(kinds) > 1:
        raise ScenarioError(" and ".join(kinds), "are different outputs", "choose one of them")
    if parquet:
        check_file(parquet, ours=True)
    fields, rows = read_rows(folder)
    _tell_of(rows)
    unknown = unknown_metrics(folder)
    if unknown:
        note(f"left out: {', '.join(unknown)}; the package that measures this is not installed")
    if parquet:
        write_parquet(rows, parquet)
        note(f"{len(rows)} runs: {parquet}")
    elif csv and by is None:
        write(to_csv(rows))
    elif json_ and by is None:
        write(json.dumps(rows) + "\n")
    else:
        groups = aggregate(rows, by.split(",") if by else fields)
        if csv:
            write(to_csv(groups))
        elif json_:
            write(json.dumps(groups) + "\n")
        else:
            _print_groups(groups, by.split(",") if by else fields, shown)


def plot(
    folder: Path,
    /,
    *,
    x: str | None = None,
    y: str = "time_on_target",
    hue: str | None = None,
    figure: Annotated[Path | None, Parameter(name=["--figure", "--out"])] = None,
    width: Literal["single", "double"] = "single",
) -> None:
    """Draw one metric of a sweep against a field, with bands of the 95 % interval.

    Parameters
    ----------
    folder
        The sweep's --out.
    x
        Field on the horizontal axis; default the numeric one with most values.
    y
        Metric on the vertical axis.
    hue
        Field that makes one curve per value; default the next field that varies.
    figure
        Picture to draw (.png, .svg or .pdf); default plot.png in the folder.
    width
        One column of a journal (single, 3.5 in) or two (double, 7.16 in).
    """
    from shoal.drawing.files import check_figure
    from shoal.experiments.results import read_rows
    from shoal.study.plot import curves, save

    _tell_of(read_rows(folder)[1])
    target = figure or folder / "plot.png"
    check_figure(target)
    save(curves(folder, x=x, y=y, hue=hue, width=width), target)
    note(f"figure: {target}")


def _tell_of(rows: list[dict[str, Any]]) -> None:
    """Say what the numbers do not: which results version they are of, and which runs gave none."""
    if not rows:
        note("no run has ended yet; the same shoal sweep command continues it")
        return
    tell_of_version(rows[0]["results_version"])
    failed = [row["error"] for row in rows if row["status"] == "failed"]
    if failed:
        many = f"all {len(rows)} runs" if len(failed) == len(rows) else f"{len(failed)} of {len(rows)} runs"
        note(f"{many} failed and gave no numbers; the first: {failed[0]}")
        note("correct it, then repeat the shoal sweep command with --retry-failed")


def _known(metrics: list[str]) -> list[str]:
    """The same names, if metrics have them.

    Raises
    ------
    ScenarioError : one is none
    """
    from shoal.core.errors import ScenarioError, did_you_mean
    from shoal.core.text import plain
    from shoal.metrics.summary import METRICS

    for name in metrics:
        if name not in METRICS:
            fix = f"{did_you_mean(name, METRICS)}there are: {', '.join(METRICS)}"
            raise ScenarioError(f"--metric {plain(name)}", "is not a metric", fix)
    return list(dict.fromkeys(metrics))


def _print_groups(groups: list[dict[str, Any]], by: list[str], metrics: list[str]) -> None:
    from rich.table import Table

    from shoal.cli.console import print_table, results_console
    from shoal.record.names import label_of
    from shoal.record.words import told

    if not groups:
        return
    table = Table(box=None, padding=(0, 2, 0, 0))
    for name in (*by, "runs", *map(label_of, metrics)):
        table.add_column(name, justify="right", no_wrap=True)
    for group in groups:
        cells = [told(group[name], group[f"{name}_low"], group[f"{name}_high"]) for name in metrics]
        table.add_row(*(str(group[name]) for name in by), str(group["runs"]), *cells)
    print_table(results_console(), table)
