"""Where the parts of the summary page go, in inches: the shape of the arena decides."""

from typing import NamedTuple

PAGE = 10.0  # width
LEFT, RIGHT = 0.7, 0.4  # room for a y label; page margin
TITLE = 0.33  # above an axes
BELOW_CURVES, BELOW_HISTOGRAM, BELOW_SNAPSHOT = 0.55, 0.85, 0.6  # room for ticks and x label
GUTTER = 0.85  # between columns, y label of the right one included
SNAPSHOT = 4.7  # height
NARROWEST = 3.0  # column of a snapshot
WIDE = 1.5  # width / height from which the snapshot takes the whole width

Box = tuple[float, float, float, float]  # left, bottom, width, height


class Boxes(NamedTuple):
    """Size of a page and the axes on it [inch]; `snapshot` is None where there is nothing to show."""

    width: float
    height: float
    snapshot: Box | None
    histogram: Box
    curves: Box

    def fraction(self, box: Box) -> Box:
        """A box as matplotlib counts it, in shares of the page."""
        left, bottom, width, height = box
        return left / self.width, bottom / self.height, width / self.width, height / self.height


def snapshot_size(aspect: float) -> tuple[float, float]:
    """Width and height [inch] of a snapshot whose arena is `aspect` times as wide as high."""
    if aspect > WIDE:
        width = min(PAGE - LEFT - RIGHT, SNAPSHOT * aspect)
    else:
        width = min(SNAPSHOT * aspect, 5.2)
    return width, width / aspect


def lay_out(aspect: float | None, header: float, footer: float, legend: float = 0.0) -> Boxes:
    """Return the boxes of a page.

    Parameters
    ----------
    aspect : width / height of the arena, None for a page without a snapshot
    header, footer : room for text above and below [inch]
    legend : room for the legend above the snapshot [inch]
    """
    if aspect is None:
        return _charts_in_a_row(header, footer, None)
    if aspect > WIDE:
        width, height = snapshot_size(aspect)
        return _charts_in_a_row(header + legend + TITLE + height + BELOW_SNAPSHOT, footer, (width, height))
    return _charts_in_a_column(aspect, header, footer, legend)


def _charts_in_a_row(above: float, footer: float, snapshot: tuple[float, float] | None) -> Boxes:
    """Histogram left, curves right, below everything else."""
    width, height = (PAGE - LEFT - RIGHT - GUTTER) / 2, 2.1
    bottom = footer + BELOW_HISTOGRAM
    page = bottom + height + TITLE + above
    top = bottom + height + TITLE + BELOW_SNAPSHOT
    box = None if snapshot is None else (LEFT, top, *snapshot)
    return Boxes(PAGE, page, box, (LEFT, bottom, width, height), (LEFT + width + GUTTER, bottom, width, height))


def _charts_in_a_column(aspect: float, header: float, footer: float, legend: float) -> Boxes:
    """Snapshot left; right of it the histogram over the curves, in line with its top and bottom."""
    width, height = snapshot_size(aspect)
    column = max(width, NARROWEST)
    left = LEFT + column + GUTTER
    page = header + legend + TITLE + SNAPSHOT + BELOW_SNAPSHOT + footer
    top, bottom = page - header - TITLE, footer + BELOW_SNAPSHOT
    chart = (top - bottom - BELOW_HISTOGRAM - TITLE) / 2
    wide = PAGE - RIGHT - left
    return Boxes(
        PAGE,
        page,
        (LEFT, page - header - legend - TITLE - height, width, height),
        (left, top - chart, wide, chart),
        (left, bottom, wide, chart),
    )
