"""Publication-ready figures of records and sweeps: SVG, PNG or PDF, one look, safe for color-blind readers.

Each function takes the data and returns a matplotlib Figure that no window knows; with `axes` it draws there instead,
in our look, without a title of ours, and returns the figure of those (extra: plots; films: video).

>>> import shoal
>>> record = shoal.open_record("DIR")
>>> shoal.plot.save(shoal.plot.snapshot(record, links=True), "snapshot.svg")
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.core.errors import RecordError, ScenarioError, did_you_mean, no_attribute
from shoal.core.text import plain
from shoal.drawing.arena_drawing import Parts
from shoal.drawing.curves import Curve, draw_batches
from shoal.drawing.files import save_figure
from shoal.drawing.film import Film, FilmLook, write_film
from shoal.drawing.footage import current_record
from shoal.drawing.histogram import draw_phi_histogram
from shoal.drawing.legend import legend_height, map_legend_height, name_lines
from shoal.drawing.snapshot import draw_snapshot, frames_of
from shoal.drawing.stretch import frame_of
from shoal.drawing.style import Width, lettered, new_figure, style, width_of
from shoal.drawing.summary import summary_figure
from shoal.drawing.sweep import draw_sweep, sweep_page
from shoal.drawing.titles import entitle
from shoal.drawing.trajectory_map import draw_trajectory_map
from shoal.drawing.words import field_value, field_words
from shoal.experiments.results import aggregate, default_x, varied_rows
from shoal.experiments.rows import Row
from shoal.metrics.summary import METRICS
from shoal.record.files import open_record
from shoal.record.names import label_of
from shoal.record.record import Record
from shoal.run.simulation import Simulation
from shoal.study.pages import BELOW_PHI, LEFT, NARROWEST, RIGHT, TALL, TOP, arena_page, chart_page, drawn

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = [
    "Film",
    "FilmLook",
    "Parts",
    "curves",
    "phi_histogram",
    "save",
    "snapshot",
    "summary",
    "time_on_target",
    "trajectory_map",
    "write_film",
]


def __dir__() -> list[str]:
    return __all__


if not TYPE_CHECKING:  # hidden from type checkers, which know the names

    def __getattr__(name: str) -> Any:
        raise no_attribute("shoal.plot", name, __all__)


AnyRecord = Record | str | Path


def snapshot(
    what: AnyRecord | Simulation,
    *,
    run: int | None = None,
    step: int | None = None,
    links: bool = False,
    trail: int | None = None,
    halos: bool = False,
    sensors: bool = False,
    axes: "Axes | None" = None,
) -> "Figure":
    """The swarm at one step, seen from above: `plot.snapshot(record, step=4990, links=True)`.

    Parameters
    ----------
    what : a record or its folder, or a simulation, as it is now
    run : number of a run that kept a trajectory; default the first of those
    step : one that was kept; default the last
    links : draw a line between buoys of which one heard the other in this step
    trail : steps of the targets' trails (the buoys' are a third of it), 0 for none
    halos, sensors : draw discs of radius a_R, circles as wide as sensors reach
    axes : matplotlib axes to draw into, in our look; default: a new figure

    Raises
    ------
    RecordError : no such run or step was kept, or there are no links, a_R or sensor to show
    """
    record = current_record(what) if isinstance(what, Simulation) else _record(what)
    run = _run(record, run)
    frame = -1 if step is None else frame_of(np.asarray(frames_of(record, run).step), step)
    parts = Parts(links, halos=halos, sensors=sensors)
    size = arena_page(record, lambda width: legend_height(record, width, halos=halos, sensors=sensors))
    return drawn(axes, size, lambda into: draw_snapshot(into, record, run, frame, trail, parts))


def trajectory_map(
    record: AnyRecord,
    *,
    run: int | None = None,
    start: int | None = None,
    steps: int | None = None,
    every: int | None = None,
    axes: "Axes | None" = None,
) -> "Figure":
    """The paths of buoys and targets over a stretch of steps, fading into the past: `plot.trajectory_map(record)`.

    Parameters
    ----------
    record : a record or its folder
    run : number of a run that kept a trajectory; default the first of those
    start, steps, every : the steps shown; default the last in which the fastest buoy can cross the
        arena once
    axes : matplotlib axes to draw into, in our look; default: a new figure

    Raises
    ------
    RecordError : no such run or steps were kept
    """
    record = _record(record)
    run = _run(record, run)
    size = arena_page(record, lambda width: map_legend_height(record, width))
    return drawn(axes, size, lambda into: draw_trajectory_map(into, record, run, start, steps, every))


def phi_histogram(
    records: AnyRecord | Sequence[AnyRecord] | Mapping[str, AnyRecord],
    *,
    axes: "Axes | None" = None,
    width: Width | None = None,
) -> "Figure":
    """Headings relative to the target, Eq. 8: `plot.phi_histogram({"k = 10": low, "k = 40": high})`.

    Parameters
    ----------
    records : a record or its folder; or several, side by side on one scale, named by the keys or by their scenarios
    axes : of one record only
    width : of one column of a journal (single), or of two (double); default single of one record, double of several
    """
    if isinstance(records, (Record, str, Path)):
        record = _record(records)
        return drawn(axes, chart_page(width or "single", BELOW_PHI), lambda into: draw_phi_histogram(into, record))
    named = records.items() if isinstance(records, Mapping) else [(None, each) for each in records]
    panels = [(name, _record(each)) for name, each in named]
    if axes is not None or not panels:
        raise RecordError("records", f"are {len(panels)}", "give one record to draw into axes, and one or more without")
    with style():
        across = width_of(width or "double")
        columns = max(1, min(len(panels), int((across - RIGHT) / NARROWEST)))
        wide, rows = (across - RIGHT) / columns - LEFT, -(-len(panels) // columns)
        tall = BELOW_PHI + TALL + TOP
        figure = new_figure(across, rows * tall)
        for number, (name, record) in enumerate(panels):
            row, column = divmod(number, columns)
            at, bottom = column * (LEFT + wide) + LEFT, (rows - row - 1) * tall + BELOW_PHI
            panel = figure.add_axes((at / across, bottom / (rows * tall), wide / across, TALL / (rows * tall)))
            draw_phi_histogram(panel, record)
            entitle(panel, f"{lettered(number)} {name_lines(name or record.scenario.name, 60)}")
        scaled = [panel for panel in figure.axes if len(panel.get_yticks())]  # the others had no target
        tallest = max(scaled or figure.axes, key=lambda panel: panel.get_ylim()[1])
        for panel in scaled:
            panel.set_yticks(tallest.get_yticks())
            panel.set_ylim(tallest.get_ylim())
    return figure


def time_on_target(record: AnyRecord, *, axes: "Axes | None" = None, width: Width = "single") -> "Figure":
    """Time on target over the course of each run, its mean and interval: `plot.time_on_target(record)`.

    Parameters
    ----------
    record : a record or its folder
    axes : matplotlib axes to draw into, in our look; default: a new figure
    width : of that figure: one column of a journal (single), or two (double)
    """
    record = _record(record)
    return drawn(axes, chart_page(width), lambda into: draw_batches(into, record))


def curves(
    results: str | Path | Sequence[Row] | Any,
    *,
    x: str | None = None,
    y: str = "time_on_target",
    hue: str | None = None,
    axes: "Axes | None" = None,
    width: Width = "single",
) -> "Figure":
    """A metric of a sweep against a field, with bands of the 95 % interval: `plot.curves("k-sweep", x="neighbors")`.

    Parameters
    ----------
    results : a sweep's folder, its rows, or what `shoal.load_results` returns
    x : field on the horizontal axis; default the numeric one with most values
    y : metric on the vertical axis
    hue : field that makes one curve per value; default the next field that varies
    axes : matplotlib axes to draw into, in our look; default: a new figure
    width : of that figure: one column of a journal (single), or two (double)

    Raises
    ------
    ScenarioError : no such field or metric, or no run that ended well
    """
    fields, rows = varied_rows(results)
    if y not in METRICS:
        raise ScenarioError(f"y {y}", "is not a metric", f"{did_you_mean(y, METRICS)}there are: {', '.join(METRICS)}")
    x = x or default_x(fields, rows)
    hue = hue or next((name for name in fields if name != x), None)
    names = [name for name in (hue, x) if name]
    unknown = [name for name in names if rows and name not in rows[0]]
    if unknown:
        hint = did_you_mean(unknown[0], fields)
        raise ScenarioError(
            f"field {unknown[0]}", "is not a field of this sweep", f"{hint}there are: {', '.join(fields)}"
        )
    made: dict[Any, Curve] = {}
    for group in aggregate(rows, names, [y]):
        label = plain(field_value(hue, group[hue])) if hue else ""
        curve = made.setdefault(label, Curve(label))
        curve.add(group[x], group[y], group[f"{y}_low"], group[f"{y}_high"])
    if not made:
        raise ScenarioError(
            "results", "hold no run that ended well", "see the column error, fix the cause and run them again"
        )
    labels = field_words(x), label_of(y)
    if axes is None:
        return sweep_page(list(made.values()), *labels, width)
    return drawn(axes, chart_page(width), lambda into: draw_sweep(into, list(made.values()), *labels, inside=True))


def summary(record: AnyRecord, *, width: Width = "double") -> "Figure":
    """A record on one page, as `shoal run --figure` draws it: `plot.summary(record)`.

    Parameters
    ----------
    record : a record or its folder
    width : of one column of a journal (single), or of two (double)
    """
    return summary_figure(_record(record), width)


def save(figure: "Figure", path: str | Path) -> None:
    """Write a figure; the same figure gives the same bytes: `plot.save(figure, "fig.svg")`.

    Parameters
    ----------
    figure : what a function of this module returned, or any matplotlib Figure
    path : a file .png, .svg or .pdf

    Raises
    ------
    ShoalError : another suffix
    RecordError : the file cannot be written; what was there before is untouched
    """
    save_figure(figure, path)


def _record(what: AnyRecord) -> Record:
    if isinstance(what, (str, Path)):
        return open_record(what)
    if not isinstance(what, Record):
        raise RecordError(
            type(what).__name__, "is not a record", "give what shoal.simulate returns, or a record's folder"
        )
    return what


def _run(record: Record, run: int | None) -> int:
    """The run asked for, or the first that kept a trajectory."""
    return min(record.trajectories, default=0) if run is None else run
