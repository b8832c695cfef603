"""Summary: a record on one page."""

import textwrap
from typing import TYPE_CHECKING, Any

from shoal.drawing.arena import arena_aspect
from shoal.drawing.curves import draw_batches
from shoal.drawing.histogram import draw_phi_histogram
from shoal.drawing.layout import Boxes, lay_out, snapshot_size
from shoal.drawing.legend import legend_height
from shoal.drawing.snapshot import draw_snapshot
from shoal.drawing.style import GRAY, Width, lettered, new_figure, style, width_of
from shoal.drawing.titles import entitle
from shoal.drawing.words import interval_text, metric_phrases, provenance_phrases, setup_phrases
from shoal.record.record import Record

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_LINE, _TITLE_LINE = 0.155, 0.2  # [inch] of small text, of the name
_MARGIN = 0.12  # [inch] from the page's edge to text
_LETTER, _TITLE_LETTER = 0.0585, 0.105  # [inch] width of theirs


def summary_figure(record: Record, width: Width = "double") -> "Figure":
    """Return the page of `shoal run --figure`: the swarm, headings relative to the target, time on target, settings.

    Parameters
    ----------
    width : of one column of a journal, or of two

    Raises
    ------
    UnknownNameError : another width
    MissingExtraError : matplotlib is not installed
    """
    page = width_of(width)
    with style():
        name = textwrap.wrap(" ".join(record.scenario.name.split()), int((page - 2 * _MARGIN) / _TITLE_LETTER))
        setup = _wrap(setup_phrases(record), page)
        footer = _wrap(metric_phrases(record), page) + _wrap([interval_text(record), *provenance_phrases(record)], page)
        run = min(record.trajectories, default=None)
        aspect = arena_aspect(record.scenario.area) if run is not None else None
        legend = legend_height(record, snapshot_size(aspect, page)[0]) if aspect else 0.0
        header = 0.2 + _TITLE_LINE * len(name) + _LINE * len(setup)
        boxes = lay_out(aspect, header, 0.16 + _LINE * len(footer), legend, page)
        figure = new_figure(boxes.width, boxes.height)
        _write(figure, boxes, name, setup, footer)
        letters = iter(range(3))
        if run is not None and boxes.snapshot:
            axes = figure.add_axes(boxes.fraction(boxes.snapshot))
            draw_snapshot(axes, record, run, letter=f"{lettered(next(letters))} ")
        for box, draw in ((boxes.histogram, draw_phi_histogram), (boxes.curves, draw_batches)):
            axes = figure.add_axes(boxes.fraction(box))
            draw(axes, record)
            entitle(axes, lettered(next(letters), axes.get_title(loc="left")))
    return figure


def _wrap(phrases: list[str], page: float) -> list[str]:
    """Phrases set apart by dots, in lines that fit the page; a phrase is broken only if it must be."""
    letters = int((page - 2 * _MARGIN) / _LETTER)
    lines = [""]
    for phrase in phrases:
        longer = f"{lines[-1]}  \u00b7  {phrase}" if lines[-1] else phrase
        if len(longer) <= letters:
            lines[-1] = longer
        else:
            lines.extend(textwrap.wrap(phrase, letters))
    return [line for line in lines if line]


def _write(figure: "Figure", boxes: Boxes, name: list[str], setup: list[str], footer: list[str]) -> None:
    """Title and setup at the top, metrics and provenance at the bottom."""
    left = _MARGIN / boxes.width

    def line(text: str, height: float, **look: Any) -> None:
        figure.text(left, height / boxes.height, text, ha="left", va="baseline", **look)

    height = boxes.height - 0.04
    for text in name:
        height -= _TITLE_LINE
        line(text, height, fontsize=11, fontweight="bold")
    height -= 0.02
    for text in setup:
        height -= _LINE
        line(text, height)
    for number, text in enumerate(reversed(footer)):
        line(text, 0.08 + _LINE * number, color=GRAY)
