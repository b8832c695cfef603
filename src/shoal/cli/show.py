"""shoal show: the table and the figure of a saved record."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from shoal.cli.older import opened
from shoal.cli.told import print_and_draw


def show(
    record: Path,
    /,
    *,
    figure: Path | None = None,
    width: Literal["single", "double"] = "double",
    all_: Annotated[bool, Parameter(name="--all", negative=())] = False,
    json_: Annotated[bool, Parameter(name="--json", negative=())] = False,
) -> None:
    """Print the table of a saved record, and draw its figure.

    Parameters
    ----------
    record
        Folder made by `shoal run --out`.
    figure
        Where to draw the figure (.png, .svg or .pdf).
    width
        Of the figure: one column of a journal (single, 3.5 in) or two (double, 7.16 in).
    all_
        Show all metrics, not only the eight that matter most: those of each fleet, target and change of the swarm, too.
    json_
        Print one JSON object and nothing else.
    """
    if figure:
        from shoal.drawing.files import check_figure

        check_figure(figure)
    known = opened(record)
    print_and_draw(known, figure, json_, width=width, everything=all_)
