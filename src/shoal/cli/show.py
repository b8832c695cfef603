"""shoal show: the table and the figure of a saved record."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from shoal.cli.older import opened
from shoal.cli.progress import note


def show(
    record: Path,
    /,
    *,
    figure: Path | None = None,
    json_: Annotated[bool, Parameter(name="--json", negative=())] = False,
) -> None:
    """Print the table of a saved record, and draw its figure.

    Parameters
    ----------
    record
        Folder made by `shoal run --out`.
    figure
        Where to draw the figure (.png, .svg or .pdf).
    json_
        Print one JSON object and nothing else.
    """
    from shoal.cli.table import print_record

    if figure:
        from shoal.drawing.files import check_figure

        check_figure(figure)
    known = opened(record)
    if json_:
        from shoal.cli.summary import print_json

        print_json(known)
    else:
        print_record(known)
    if figure:
        from shoal.study.plot import save, summary

        save(summary(known), figure)
        note(f"figure: {figure}")
