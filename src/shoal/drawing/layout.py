"""Where the parts of the summary page go, in inches: its width and the shape of the arena decide."""

from typing import NamedTuple

from shoal.drawing.style import WIDTHS

DOUBLE = WIDTHS["double"]
LEFT, RIGHT = 0.55, 0.28  # room for a y label; page margin
TITLE = 0.3  # above an axes
BELOW_CURVES, BELOW_HISTOGRAM, BELOW_SNAPSHOT = 0.42, 0.7, 0.48  # room for ticks and x label
GUTTER = 0.68  # between columns, y label of the right one included
SNAPSHOT = 3.3  # height beside the charts
WIDEST = 3.35  # width beside the charts
TALLEST = 5.0  # height of a snapshot above the charts
NARROWEST = 2.2  # column of a snapshot beside the charts
CHART = 1.55  # height of a chart below the snapshot
COLUMN_CHART, COLUMN_SNAPSHOT = 1.15, 2.55  # heights in one column of a journal, which is 9.5 in tall
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


def snapshot_size(aspect: float, page: float = DOUBLE) -> tuple[float, float]:
    """Width and height [inch] of a snapshot whose arena is `aspect` times as wide as high, on a page of a width."""
    beside = page >= DOUBLE and aspect <= WIDE
    room = WIDEST if beside else page - LEFT - RIGHT
    highest = SNAPSHOT if beside else TALLEST if page >= DOUBLE else COLUMN_SNAPSHOT
    width = min(room, highest * aspect)
    return width, width / aspect


def lay_out(aspect: float | None, header: float, footer: float, legend: float = 0.0, page: float = DOUBLE) -> Boxes:
    """Return the boxes of a page.

    Parameters
    ----------
    aspect : width / height of the arena, None for a page without a snapshot
    header, footer : room for text above and below [inch]
    legend : room for the legend above the snapshot [inch]
    page : its width [inch]
    """
    size = None if aspect is None else snapshot_size(aspect, page)
    above = header + (legend + TITLE + size[1] + BELOW_SNAPSHOT if size else 0.0)
    if page < DOUBLE:
        return _one_below_the_other(page, above, footer, size)
    if aspect is None or aspect > WIDE:
        return _charts_in_a_row(page, above, footer, size)
    return _charts_in_a_column(aspect, header, footer, legend)


def _one_below_the_other(page: float, above: float, footer: float, size: tuple[float, float] | None) -> Boxes:
    """Snapshot, histogram, curves."""
    wide = page - LEFT - RIGHT
    curves = footer + BELOW_CURVES
    histogram = curves + COLUMN_CHART + TITLE + BELOW_HISTOGRAM
    top = histogram + COLUMN_CHART + TITLE
    box = None if size is None else (LEFT + (wide - size[0]) / 2, top + BELOW_SNAPSHOT, *size)
    return Boxes(page, top + above, box, (LEFT, histogram, wide, COLUMN_CHART), (LEFT, curves, wide, COLUMN_CHART))


def _charts_in_a_row(page: float, above: float, footer: float, size: tuple[float, float] | None) -> Boxes:
    """Histogram left, curves right, below everything else."""
    width = (page - LEFT - RIGHT - GUTTER) / 2
    bottom = footer + BELOW_HISTOGRAM
    top = bottom + CHART + TITLE
    box = None if size is None else (LEFT, top + BELOW_SNAPSHOT, *size)
    return Boxes(page, top + above, box, (LEFT, bottom, width, CHART), (LEFT + width + GUTTER, bottom, width, CHART))


def _charts_in_a_column(aspect: float, header: float, footer: float, legend: float) -> Boxes:
    """Snapshot left; right of it the histogram over the curves, in line with its top and bottom."""
    width, height = snapshot_size(aspect)
    left = LEFT + max(width, NARROWEST) + GUTTER
    page = header + legend + TITLE + SNAPSHOT + BELOW_SNAPSHOT + footer
    top, bottom = page - header - TITLE, footer + BELOW_SNAPSHOT
    chart = (top - bottom - BELOW_HISTOGRAM - TITLE) / 2
    wide = DOUBLE - RIGHT - left
    return Boxes(
        DOUBLE,
        page,
        (LEFT, page - header - legend - TITLE - height, width, height),
        (left, top - chart, wide, chart),
        (left, bottom, wide, chart),
    )
