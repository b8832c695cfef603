"""How every figure looks: one palette, one set of rc values, one way to make a page."""

import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from string import ascii_lowercase
from typing import TYPE_CHECKING, Any, Literal

from shoal.core.errors import MissingExtraError, UnknownNameError
from shoal.core.palette import FLEET_COLORS as FLEET_COLORS
from shoal.core.palette import TARGET as TARGET

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Width = Literal["single", "double"]
WIDTHS: dict[str, float] = {"single": 3.5, "double": 7.16}  # [inch] of columns of journals (IEEE's)
INK = "#222222"
GRAY = "#6b6b6b"
GRID = "#e4e4e4"
LINE_COLORS = ("#0072B2", "#009E73", "#882255", INK, "#9A7A00", "#AA4499")  # 3:1 on white or more; the first four
# differ in gray, too; never the target's
_DARKER = {"#56B4E9": "#2E86C1", "#CC79A7": "#B35C8E", "#F0E442": "#8A8100", "#E69F00": "#A87300"}  # 3:1 on white
FLEET_MARKERS = ("o", "^", "s", "D", "v", "P", "X", "h")

RC: dict[str, Any] = {
    "font.family": "DejaVu Sans",  # travels with matplotlib: the same page everywhere
    "font.size": 8.0,
    "text.color": INK,
    "text.parse_math": False,  # a dollar sign in a name is one
    "axes.titlesize": 8.5,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "axes.titlepad": 6.0,
    "axes.labelsize": 8.0,
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
    "savefig.dpi": 300.0,
    "svg.fonttype": "none",  # text is text
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


def width_of(width: Width) -> float:
    """Width of a page [inch].

    Raises
    ------
    UnknownNameError : another word
    """
    if width not in WIDTHS:
        raise UnknownNameError.of("width", width, WIDTHS)
    return WIDTHS[width]


def lettered(number: int, title: str = "") -> str:
    """The title of a panel behind its letter: (a) Time on target."""
    return f"({ascii_lowercase[number % 26]}) {title}".rstrip()


def dress(axes: "Axes") -> None:
    """Give axes that were made elsewhere our look: edges, ticks, grid; fonts and titles stay."""
    axes.set_axisbelow(True)
    for side, spine in axes.spines.items():
        spine.set_color(GRAY)
        spine.set_linewidth(RC["axes.linewidth"])
        spine.set_visible(spine.get_visible() and side in ("left", "bottom"))
    axes.tick_params(color=GRAY, labelcolor=INK, width=RC["xtick.major.width"])
    axes.tick_params(grid_color=GRID, grid_linewidth=RC["grid.linewidth"], grid_alpha=1.0, grid_linestyle="-")


def line_color(number: int) -> str:
    """Color of a curve of this number, which stands out from white."""
    return LINE_COLORS[number % len(LINE_COLORS)]


def fleet_line(fleet: int) -> str:
    """Color of the lines and rims of a fleet: its own, darker where that is too pale on white."""
    return _DARKER.get(fleet_color(fleet), fleet_color(fleet))


def fleet_color(fleet: int) -> str:
    """Color of the fleet of this number."""
    return FLEET_COLORS[fleet % len(FLEET_COLORS)]


def fleet_marker(fleet: int) -> str:
    """Marker of the fleet of this number: color is never the only sign."""
    return FLEET_MARKERS[fleet % len(FLEET_MARKERS)]
