"""The report of a reproduction: one page that needs nothing else, and every number of it as a file."""

import base64
import csv
import io
import math
import shlex
from collections.abc import Sequence
from dataclasses import asdict, fields
from pathlib import Path

from shoal.core.errors import RecordError
from shoal.core.files import write_atomic
from shoal.drawing.files import save_figure
from shoal.experiments.rows import Row
from shoal.paper.report_page import Picture, page
from shoal.paper.results import Claim, Figure, Reproduction

LARGEST_SVG = 300_000  # [B] an SVG over this size is inlined as PNG


def write_report(reproduction: Reproduction, out: str | Path) -> Path:
    """Write report.html, claims.csv, command.txt, figures/ and data/ into a folder, and return the report's path.

    The report is one file: it opens from disk, asks no network, and prints. Files of the same names are replaced, each
    whole or not at all; the report comes last.

    Raises
    ------
    RecordError : the folder or a file cannot be written
    MissingExtraError : matplotlib is not installed, and there are figures
    """
    folder = Path(out)
    _make(folder / "figures")
    _make(folder / "data")
    pictures = [_write_figure(figure, folder) for figure in reproduction.figures]
    for name, rows in reproduction.tables.items():
        write_atomic(folder / "data" / f"table_{name}.csv", to_csv(rows).encode())
    write_atomic(folder / "claims.csv", _claims_csv(reproduction).encode())
    write_atomic(folder / "command.txt", _command_text(reproduction).encode())
    report = folder / "report.html"
    write_atomic(report, page(reproduction, pictures, _stores(folder)).encode())
    return report


def to_csv(rows: Sequence[Row]) -> str:
    """Rows as CSV, with the columns of all of them in order of first use; a number that does not exist is empty."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(names)
    writer.writerows([_cell(row.get(name)) for name in names] for row in rows)
    return stream.getvalue()


def _write_figure(figure: Figure, folder: Path) -> Picture:
    """Write a figure as SVG, PNG and numbers; return what the page shows of it."""
    svg, png = (folder / "figures" / f"{figure.name}.{kind}" for kind in ("svg", "png"))
    save_figure(figure.figure, svg)
    save_figure(figure.figure, png)
    write_atomic(folder / "data" / f"{figure.name}.csv", to_csv(figure.data).encode())
    try:
        kind, content = ("svg+xml", svg.read_bytes())
        if len(content) > LARGEST_SVG:
            kind, content = ("png", png.read_bytes())
    except OSError as error:
        raise _unusable(svg, error) from error
    source = f"data:image/{kind};base64,{base64.b64encode(content).decode()}"
    width, height = figure.figure.get_size_inches()
    return Picture(figure, source, float(width), float(height))


def _claims_csv(reproduction: Reproduction) -> str:
    """A row per claim, the columns refit_... of the other reading behind the others."""
    rows = [asdict(claim) for claim in reproduction.claims]
    for row, other in zip(rows, reproduction.refit_claims, strict=bool(reproduction.refit_claims)):
        row |= {f"refit_{name}": value for name, value in asdict(other).items() if name not in ("id", "statement")}
    return to_csv(rows) if rows else ",".join(field.name for field in fields(Claim)) + "\n"


def _command_text(reproduction: Reproduction) -> str:
    versions = "".join(f"# {name} {version}\n" for name, version in reproduction.versions.items())
    return (
        f"{reproduction.command or shlex.join(['shoal', 'reproduce', reproduction.paper])}\n"
        f"# {reproduction.steps} steps, {reproduction.seeds} seeds, {reproduction.seconds:.0f} s\n{versions}"
    )


def _stores(folder: Path) -> list[str]:
    """Folders of sweeps under the report's: where the row of every run is."""
    try:
        return sorted(file.parent.relative_to(folder).as_posix() for file in folder.glob("**/runs.sqlite"))
    except OSError as error:
        raise _unusable(folder, error) from error


def _cell(value: object) -> object:
    return "" if value is None or (isinstance(value, float) and not math.isfinite(value)) else value


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise _unusable(folder, error) from error


def _unusable(path: Path, error: OSError) -> RecordError:
    return RecordError(str(path), f"cannot be used: {error.strerror or error}", "name a folder that you may write")
