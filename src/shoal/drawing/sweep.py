"""A sweep as curves with bands: one metric against one field."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from shoal.drawing.curves import Curve, draw_curve
from shoal.drawing.foot import draw_foot, foot_height
from shoal.drawing.legend import legend_above, legend_room
from shoal.drawing.margins import keep_on_page
from shoal.drawing.style import Width, fleet_marker, line_color, new_figure, style, width_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LEFT, _RIGHT, _TOP, _BELOW = 0.55, 0.15, 0.1, 0.42  # [in] beside, above and below the axes
_NOTE = "bands: 95 % interval over runs"


def sweep_page(curves: list[Curve], x_label: str, y_label: str, width: Width = "single") -> "Figure":
    """Return a figure of curves, and a line that says what the bands are."""
    page = width_of(width)
    wide = page - _LEFT - _RIGHT
    tall = 0.72 * wide if width == "single" else 0.45 * wide
    bottom = foot_height(_NOTE, page) + _BELOW
    with style():
        height = bottom + tall + legend_room([curve.label for curve in curves], wide) + _TOP
        figure = new_figure(page, height)
        box = (_LEFT / page, bottom / height, wide / page, tall / height)
        axes = figure.add_axes(box)
        draw_sweep(axes, curves, x_label, y_label)
        keep_on_page(axes)
        draw_foot(figure, _NOTE)
    return figure


def draw_sweep(axes: "Axes", curves: Sequence[Curve], x_label: str, y_label: str, *, inside: bool = False) -> None:
    """Draw curves with bands and their legend, above or inside; words on the x axis become categories."""
    from matplotlib.ticker import MaxNLocator

    words = sorted({str(x) for curve in curves for x in curve.x if isinstance(x, str)})
    for number, curve in enumerate(curves):
        order = sorted(range(len(curve.x)), key=lambda i: words.index(str(curve.x[i])) if words else curve.x[i])
        placed = Curve(curve.label)
        for i in order:
            x = words.index(str(curve.x[i])) if words else curve.x[i]
            placed.add(x, curve.mean[i], curve.low[i], curve.high[i])
        draw_curve(axes, placed, line_color(number), fleet_marker(number))
    if words:
        axes.set_xticks(range(len(words)), words)
    elif all(float(x).is_integer() for curve in curves for x in curve.x):
        axes.xaxis.set_major_locator(MaxNLocator(8, steps=[1, 2, 5, 10], integer=True))
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.grid(visible=True)
    if any(curve.label for curve in curves) and inside:
        axes.legend(loc="best")
    elif any(curve.label for curve in curves):
        legend_above(axes)
