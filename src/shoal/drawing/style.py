"""How every figure looks: one palette, one set of rc values, one way to make a page."""

import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from shoal.core.errors import MissingExtraError
from shoal.core.palette import FLEET_COLORS as FLEET_COLORS
from shoal.core.palette import TARGET as TARGET

if TYPE_CHECKING:
    from matplotlib.figure import Figure

INK = "#222222"
GRAY = "#6b6b6b"
GRID = "#e4e4e4"
FLEET_MARKERS = ("o", "^", "s", "D", "v", "P", "X", "h")

RC: dict[str, Any] = {
    "font.family": "DejaVu Sans",  # travels with matplotlib: the same page everywhere
    "font.size": 8.5,
    "text.color": INK,
    "text.parse_math": False,  # a dollar sign in a name is one
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.titlepad": 7.0,
    "axes.labelsize": 8.5,
    "axes.labelcolor": INK,
    "axes.edgecolor": GRAY,
    "axes.linewidth": 0.7,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.unicode_minus": True,
    "axes.formatter.useoffset": False,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "xtick.color": GRAY,
    "ytick.color": GRAY,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "legend.handletextpad": 0.4,
    "legend.columnspacing": 1.4,
    "lines.linewidth": 1.4,
    "lines.solid_capstyle": "round",
    "figure.dpi": 100.0,
    "savefig.dpi": 200.0,
    "svg.fonttype": "path",
    "svg.hashsalt": "shoal",  # same figure, same bytes
    "pdf.fonttype": 42,
}

_LOCK = threading.RLock()  # matplotlib's rc values belong to the whole process


def require_matplotlib() -> None:
    """Refuse, before anything is run for it, a figure that cannot be drawn.

    Raises
    ------
    MissingExtraError : matplotlib is not installed
    """
    try:
        import matplotlib  # noqa: F401
    except ImportError as error:
        raise MissingExtraError.of("matplotlib", "plots", "drawing a figure") from error


@contextmanager
def style() -> Iterator[None]:
    """Draw or save inside this context: our look over matplotlib's defaults, whatever the user's own settings are.

    Raises
    ------
    MissingExtraError : matplotlib is not installed
    """
    require_matplotlib()
    import matplotlib.style

    with _LOCK, matplotlib.style.context(RC, after_reset=True), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")  # a box stands for it
        yield


def new_figure(width: float, height: float) -> "Figure":
    """Return an empty page of a size [inch] that no window and no global state knows; call it inside `style`."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    from shoal.drawing.page import Page

    figure = Page(figsize=(width, height))
    FigureCanvasAgg(figure)
    return figure


def fleet_color(fleet: int) -> str:
    """Color of the fleet of this number."""
    return FLEET_COLORS[fleet % len(FLEET_COLORS)]


def fleet_marker(fleet: int) -> str:
    """Marker of the fleet of this number: color is never the only sign."""
    return FLEET_MARKERS[fleet % len(FLEET_MARKERS)]
