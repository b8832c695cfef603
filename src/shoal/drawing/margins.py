"""Room for what stands left of axes, whose width is known when its numbers are."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes

EDGE = 0.04  # [inch] from the edge of a page


def keep_on_page(axes: "Axes") -> None:
    """Move the left edge of axes to the right as far as their numbers and label need it to be on the page."""
    figure = axes.get_figure(root=True)
    box = None if figure is None else axes.get_tightbbox()
    if figure is None or box is None:
        return
    missing = EDGE - box.x0 / figure.dpi
    if missing > 0:
        place = axes.get_position(original=True)
        share = missing / figure.get_figwidth()
        axes.set_position((place.x0 + share, place.y0, place.width - share, place.height))
