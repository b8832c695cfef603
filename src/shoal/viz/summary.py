"""Summary: a record on one page."""

from typing import TYPE_CHECKING

from shoal.record.record import Record
from shoal.viz.curves import draw_batches
from shoal.viz.histogram import draw_phi_histogram
from shoal.viz.layout import Boxes, lay_out
from shoal.viz.snapshot import draw_snapshot
from shoal.viz.style import GRAY, new_figure, style
from shoal.viz.words import interval_text, metric_phrases, provenance_phrases, setup_phrases

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_LINE = 0.19  # [inch] of small text
_LETTERS = 125  # of a line across the page


def summary_figure(record: Record) -> "Figure":
    """Return the page of `shoal run --figure`: the swarm, who heads where, time on target, what was run and how sure.

    Raises
    ------
    MissingExtraError : matplotlib is not installed
    """
    with style():
        setup = _wrap(setup_phrases(record))
        footer = [*_wrap([*metric_phrases(record), interval_text(record)]), *_wrap(provenance_phrases(record))]
        run = min(record.trajectories, default=None)
        area = record.scenario["area"]
        header = 0.5 + _LINE * len(setup)
        boxes = lay_out(area["width"] / area["height"] if run is not None else None, header, 0.3 + _LINE * len(footer))
        figure = new_figure(boxes.width, boxes.height)
        _write(figure, boxes, record.scenario["name"], setup, footer)
        if run is not None:
            draw_snapshot(figure.add_axes(boxes.fraction(boxes.snapshot)), record, run)
        draw_phi_histogram(figure.add_axes(boxes.fraction(boxes.histogram)), record)
        draw_batches(figure.add_axes(boxes.fraction(boxes.curves)), record)
    return figure
