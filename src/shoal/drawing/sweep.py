"""A sweep as curves with bands: one metric against one field."""

from typing import TYPE_CHECKING

from shoal.drawing.curves import Curve, draw_curve
from shoal.drawing.style import FLEET_COLORS, GRAY, fleet_marker, new_figure, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_WIDTH, _HEIGHT = 6.4, 3.9  # [in]
_COLORS = tuple(FLEET_COLORS[at] for at in (0, 2, 3, 1, 5, 6))  # neighbors in a legend differ most


def sweep_page(curves: list[Curve], x_label: str, y_label: str, unit: str) -> "Figure":
    """Return a figure of curves, and a line that says what the bands are."""
    with style():
        figure = new_figure(_WIDTH, _HEIGHT)
        draw_sweep(figure.add_axes((0.1, 0.13, 0.87, 0.74)), curves, x_label, y_label, unit)
        figure.text(0.97, 0.015, "bands: 95 % interval over runs", ha="right", va="bottom", fontsize=7, color=GRAY)
    return figure


def draw_sweep(axes: "Axes", curves: list[Curve], x_label: str, y_label: str, unit: str) -> None:
    """Draw curves with bands and their legend above; words on the x axis become categories."""
    from matplotlib.ticker import MaxNLocator

    words = sorted({str(x) for curve in curves for x in curve.x if isinstance(x, str)})
    for number, curve in enumerate(curves):
        order = sorted(range(len(curve.x)), key=lambda i: words.index(str(curve.x[i])) if words else curve.x[i])
        placed = Curve(curve.label)
        for i in order:
            x = words.index(str(curve.x[i])) if words else curve.x[i]
            placed.add(x, curve.mean[i], curve.low[i], curve.high[i])
        draw_curve(axes, placed, _COLORS[number % len(_COLORS)], fleet_marker(number))
    if words:
        axes.set_xticks(range(len(words)), words)
    elif all(float(x).is_integer() for curve in curves for x in curve.x):
        axes.xaxis.set_major_locator(MaxNLocator(8, steps=[1, 2, 5, 10], integer=True))
    axes.set_xlabel(x_label)
    axes.set_ylabel("" if unit == "1" else f"[{unit}]")
    axes.set_title(y_label, pad=22 if any(curve.label for curve in curves) else 7, wrap=True)
    axes.grid(visible=True)
    if any(curve.label for curve in curves):
        axes.legend(loc="lower left", bbox_to_anchor=(-0.01, 0.995), ncols=min(len(curves), 5), borderaxespad=0.1)
