"""A figure on disk: SVG, PNG or PDF, whole or not at all, the same bytes for the same figure."""

import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from shoal.core.errors import RecordError, ShoalError
from shoal.version import VERSION
from shoal.viz.style import style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORMATS = ("png", "svg", "pdf")
_NO_DATES: dict[str, dict[str, str | None]] = {
    "png": {"Software": f"shoal {VERSION}"},
    "svg": {"Creator": f"shoal {VERSION}", "Date": None},
    "pdf": {"Creator": f"shoal {VERSION}", "CreationDate": None},
}


def save_figure(figure: "Figure", path: str | Path) -> None:
    """Write a figure to a file; its suffix, .png, .svg or .pdf, says how. A file of this name is replaced.

    Raises
    ------
    ShoalError : another suffix
    RecordError : the file cannot be written; what was there before is untouched
    MissingExtraError : matplotlib is not installed
    """
    file = Path(path)
    kind = figure_format(file)
    try:
        handle, partial = tempfile.mkstemp(dir=file.parent, prefix=f".{file.name}.", suffix=".partial")
    except OSError as error:
        raise _unwritable(file, error) from error
    try:
        with os.fdopen(handle, "wb") as stream, style():
            figure.savefig(stream, format=kind, facecolor="white", metadata=_NO_DATES[kind])
        Path(partial).chmod(0o666 & ~_umask())
        Path(partial).replace(file)
    except OSError as error:
        raise _unwritable(file, error) from error
    finally:
        Path(partial).unlink(missing_ok=True)


def figure_format(path: str | Path) -> str:
    """Return png, svg or pdf, as the suffix of a file says.

    Raises
    ------
    ShoalError : another suffix
    """
    kind = Path(path).suffix.lower().removeprefix(".")
    if kind not in FORMATS:
        problem = f"ends in .{kind}, which is no format of a figure" if kind else "does not say the format of the figure"
        raise ShoalError(str(path), problem, f"name a file that ends in .{', .'.join(FORMATS[:-1])} or .{FORMATS[-1]}")
    return kind


def _umask() -> int:
    """Permissions that new files do without; mkstemp's are for its owner alone."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _unwritable(file: Path, error: OSError) -> RecordError:
    return RecordError(
        str(file), f"cannot be written: {error.strerror or error}", "name a file in a folder that exists and you may write"
    )
