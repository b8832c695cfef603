"""A figure on disk: SVG, PNG or PDF, whole or not at all, the same bytes for the same figure."""

from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING
from uuid import uuid4

from shoal.core.errors import RecordError, ShoalError
from shoal.version import VERSION
from shoal.viz.style import RC, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORMATS = ("png", "svg", "pdf")
_NO_DATES: dict[str, dict[str, str | None]] = {
    "png": {"Software": f"shoal {VERSION}"},
    "svg": {"Creator": f"shoal {VERSION}", "Date": None},
    "pdf": {"Creator": f"shoal {VERSION}", "CreationDate": None},
}


def save_figure(figure: "Figure", path: str | Path, dpi: float | None = None) -> None:
    """Write a figure to a file; its suffix, .png, .svg or .pdf, says how. A file of this name is replaced.

    Parameters
    ----------
    dpi : pixels per inch of a .png; default 200

    Raises
    ------
    ShoalError : another suffix
    RecordError : the file cannot be written; what was there before is untouched
    MissingExtraError : matplotlib is not installed
    """
    file = Path(path)
    kind = figure_format(file)
    partial = file.with_name(f".{file.name}.{uuid4().hex}.partial")
    try:
        with style(), partial.open("xb") as stream:
            figure.savefig(
                stream, format=kind, dpi=dpi or RC["savefig.dpi"], facecolor="white", metadata=_NO_DATES[kind]
            )
        partial.replace(file)
    except OSError as error:
        raise _unwritable(file, error) from error
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)


def figure_format(path: str | Path) -> str:
    """Return png, svg or pdf, as the suffix of a file says.

    Raises
    ------
    ShoalError : another suffix
    """
    kind = Path(path).suffix.lower().removeprefix(".")
    if kind not in FORMATS:
        problem = (
            f"ends in .{kind}, which is no format of a figure" if kind else "does not say the format of the figure"
        )
        raise ShoalError(str(path), problem, f"name a file that ends in .{', .'.join(FORMATS[:-1])} or .{FORMATS[-1]}")
    return kind


def _unwritable(file: Path, error: OSError) -> RecordError:
    return RecordError(
        str(file),
        f"cannot be written: {error.strerror or error}",
        "name a file in a folder that exists and you may write",
    )
