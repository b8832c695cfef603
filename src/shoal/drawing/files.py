"""A figure on disk: SVG, PNG or PDF, written atomically, the same bytes for the same figure."""

from pathlib import Path
from typing import TYPE_CHECKING

from shoal.core.errors import ShoalError
from shoal.core.files import atomic_file, check_file
from shoal.core.version import VERSION
from shoal.drawing.style import RC, require_matplotlib, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORMATS = ("png", "svg", "pdf")
_NO_DATES: dict[str, dict[str, str | None]] = {
    "png": {"Software": f"shoal {VERSION}"},
    "svg": {"Creator": f"shoal {VERSION}", "Date": None},
    "pdf": {"Creator": f"shoal {VERSION}", "CreationDate": None},
}


def save_figure(figure: "Figure", path: str | Path, dpi: float | None = None) -> None:
    """Write a figure to a file; its suffix, .png, .svg or .pdf, says how. A file of Shoal's of this name is replaced.

    Parameters
    ----------
    dpi : pixels per inch of a .png; default 200

    Raises
    ------
    ShoalError : another suffix
    RecordError : it cannot be written, or Shoal did not make what has that name; that is untouched
    MissingExtraError : matplotlib is not installed
    """
    kind = figure_format(path)
    with atomic_file(path, ours=True) as partial, style(), partial.open("xb") as stream:
        figure.savefig(stream, format=kind, dpi=dpi or RC["savefig.dpi"], facecolor="white", metadata=_NO_DATES[kind])


def figure_format(path: str | Path) -> str:
    """Return png, svg or pdf, as the suffix of a file says; refuse a figure that cannot be drawn.

    Raises
    ------
    ShoalError : another suffix
    MissingExtraError : matplotlib is not installed
    """
    require_matplotlib()
    kind = Path(path).suffix.lower().removeprefix(".")
    if kind not in FORMATS:
        problem = (
            f"ends in .{kind}, which is not a format of a figure" if kind else "does not say the format of the figure"
        )
        raise ShoalError(str(path), problem, f"name a file that ends in .{', .'.join(FORMATS[:-1])} or .{FORMATS[-1]}")
    return kind


def check_figure(path: str | Path) -> None:
    """Refuse, before the work that it shows, a figure that cannot be written there.

    Raises
    ------
    ShoalError, RecordError, MissingExtraError : as `save_figure`
    """
    figure_format(path)
    check_file(path, ours=True)
