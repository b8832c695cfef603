"""Summary: a record on one page."""

import textwrap
from typing import TYPE_CHECKING, Any

from shoal.drawing.arena import arena_aspect
from shoal.drawing.curves import draw_batches
from shoal.drawing.histogram import draw_phi_histogram
from shoal.drawing.layout import Boxes, lay_out, snapshot_size
from shoal.drawing.legend import legend_height
from shoal.drawing.snapshot import draw_snapshot
from shoal.drawing.style import GRAY, new_figure, style
from shoal.drawing.words import interval_text, metric_phrases, provenance_phrases, setup_phrases, shorten
from shoal.record.record import Record

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_LINE = 0.19  # [inch] of small text
_MARGIN = 0.25  # [inch] from the page's edge to text
_LETTERS = 145  # of a line across the page
_NAME = 70  # letters of its title


def summary_figure(record: Record) -> "Figure":
    """Return the page of `shoal run --figure`: the swarm, headings relative to the target, time on target, settings.

    Raises
    ------
    MissingExtraError : matplotlib is not installed
    """
    with style():
        setup = _wrap(setup_phrases(record))
        footer = _wrap(metric_phrases(record)) + _wrap([interval_text(record), *provenance_phrases(record)])
        run = min(record.trajectories, default=None)
        aspect = arena_aspect(record.scenario.area) if run is not None else None
        legend = legend_height(record, snapshot_size(aspect)[0]) if aspect else 0.0
        boxes = lay_out(aspect, 0.55 + _LINE * len(setup), 0.2 + _LINE * len(footer), legend)
        figure = new_figure(boxes.width, boxes.height)
        _write(figure, boxes, record.scenario.name, setup, footer)
        if run is not None and boxes.snapshot:
            draw_snapshot(figure.add_axes(boxes.fraction(boxes.snapshot)), record, run)
        draw_phi_histogram(figure.add_axes(boxes.fraction(boxes.histogram)), record)
        draw_batches(figure.add_axes(boxes.fraction(boxes.curves)), record)
    return figure


def _wrap(phrases: list[str]) -> list[str]:
    """Phrases set apart by dots, in lines that fit the page; a phrase is broken only if it must be."""
    lines = [""]
    for phrase in phrases:
        longer = f"{lines[-1]}  \u00b7  {phrase}" if lines[-1] else phrase
        if len(longer) <= _LETTERS:
            lines[-1] = longer
        else:
            lines.extend(textwrap.wrap(phrase, _LETTERS))
    return [line for line in lines if line]


def _write(figure: "Figure", boxes: Boxes, name: str, setup: list[str], footer: list[str]) -> None:
    """Title and setup at the top, metrics and provenance at the bottom."""
    left = _MARGIN / boxes.width

    def line(text: str, height: float, **look: Any) -> None:
        figure.text(left, height / boxes.height, text, ha="left", va="baseline", **look)

    line(shorten(name, _NAME), boxes.height - 0.38, fontsize=14, fontweight="bold")
    for number, text in enumerate(setup):
        line(text, boxes.height - 0.62 - _LINE * number, fontsize=8.5)
    for number, text in enumerate(reversed(footer)):
        line(text, 0.16 + _LINE * number, fontsize=8, color=GRAY)
