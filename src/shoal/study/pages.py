"""Pages for one drawing: where its axes are, and how it gets into the axes of somebody else."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from shoal.drawing.arena import arena_aspect
from shoal.drawing.layout import WIDE, snapshot_size
from shoal.drawing.style import WIDTHS, Width, dress, new_figure, style, width_of
from shoal.record.record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Page = tuple[tuple[float, float, float, float], float, float]  # [inch] axes; room right of and above them
LEFT, RIGHT, TOP, BELOW, BELOW_PHI = 0.55, 0.28, 0.32, 0.45, 0.72  # [inch] around a chart, and below a histogram
_LABELS = 0.48  # [inch] of ticks and a label below axes
TALL, NARROWEST = 2.0, 2.2  # [inch] height of a chart; width of one among several, labels included


def arena_page(record: Record, legend: Callable[[float], float]) -> Page:
    """Where the arena is on a page of its own [inch], and the room right of and above it."""
    aspect = arena_aspect(record.scenario.area)
    page = WIDTHS["double" if aspect > WIDE else "single"]
    width, height = snapshot_size(aspect, page)
    return (LEFT, BELOW, width, height), page - LEFT - width, TOP + legend(width)


def chart_page(width: Width, below: float = BELOW) -> Page:
    """Where a chart is on a page of its own."""
    wide = width_of(width) - LEFT - RIGHT
    return (LEFT, below, wide, TALL), RIGHT, TOP


def drawn(
    axes: "Axes | None",
    page: Page,
    draw: "Callable[[Axes], None]",
) -> "Figure":
    """Draw into new axes on a page that fits them; or into axes of somebody else, which keep their titles."""
    with style():
        if axes is None:
            (left, bottom, width, height), right, top = page
            across, tall = left + width + right, bottom + height + top
            axes = new_figure(across, tall).add_axes((left / across, bottom / tall, width / across, height / tall))
            draw(axes)
        else:
            with _own_titles(axes):
                draw(axes)
            dress(axes)
            _legend_below(axes)
        figure = axes.get_figure(root=True)
        assert figure is not None  # axes have one
        return figure


@contextmanager
def _own_titles(axes: "Axes") -> Iterator[None]:
    """Let the titles of axes be, where they are and as they look, whatever is drawn in the meantime."""
    from matplotlib.text import Text

    texts = [each for each in axes.get_children() if isinstance(each, Text)]
    before = [(each.get_text(), each.get_fontproperties().copy(), each.get_transform()) for each in texts]
    yield
    for each, (text, font, transform) in zip(texts, before, strict=True):
        each.set_text(text)
        each.set_fontproperties(font)
        each.set_transform(transform)


def _legend_below(axes: "Axes") -> None:
    """Put a legend that is above axes, where their title may be, below them."""
    from matplotlib.transforms import ScaledTranslation

    legend, figure = axes.get_legend(), axes.get_figure(root=True)
    if legend is None or figure is None or legend.get_bbox_to_anchor().y0 < axes.bbox.y1:
        return
    under = axes.transAxes + ScaledTranslation(0.0, -_LABELS, figure.dpi_scale_trans)
    legend.set_loc("upper left")
    legend.set_bbox_to_anchor((0.0, 0.0), transform=under)
