"""A figure on disk: SVG, PNG or PDF, whole or not at all, the same bytes for the same figure."""

from pathlib import Path
from typing import TYPE_CHECKING

from shoal.core.errors import ShoalError
from shoal.core.files import whole_file
from shoal.drawing.style import RC, style
from shoal.version import VERSION

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
    kind = figure_format(path)
    with whole_file(path) as partial, style(), partial.open("xb") as stream:
        figure.savefig(stream, format=kind, dpi=dpi or RC["savefig.dpi"], facecolor="white", metadata=_NO_DATES[kind])


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
