"""The readings of the paper, best first: the verdict on every statement under each, and where its curves peak."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from shoal.drawing.style import GRAY, INK, lettered, line_color, new_figure, style
from shoal.experiments.rows import Row
from shoal.paper.figures_series import DOUBLE
from shoal.paper.plan import MIXED
from shoal.paper.results import Figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_SIGNS = {  # color and sign of each verdict
    "holds": ("#0a6b4b", "✓"),
    "holds partly": ("#e3b04b", "~"),
    "does not hold": ("#a3330b", "×"),
    "undecided": ("#d5dade", "?"),
}
_PEAKS = (
    ("k*, mixed", MIXED, "k_star", 18.0),
    ("k of Ξ peak, mixed", MIXED, "xi_peak_k", 25.0),
    ("k of Ξ peak, all slow", 0, "xi_peak_k", 30.0),
)
_LIMITS = (8.0, 49.0)
_LINE = 0.19  # [inch] height of a reading
_SPEEDS = ((3.0, line_color(0), "o", 0.16), (5.0, line_color(2), "s", -0.16))


def readings_figure(scores: Sequence[Row]) -> Figure | None:
    """Draw one line per reading and stage: a square per statement, how many hold, and the score.

    scores : rows of the score table
    """
    if not scores:
        return None
    ids = [name for name in scores[0] if name[0] == "C" and name[1:].isdigit()]
    with style():
        figure = new_figure(DOUBLE, 1.0 + _LINE * len(scores))
        figure.set_layout_engine("constrained", h_pad=0.05, w_pad=0.05)
        axes = figure.subplots()
        _draw_verdicts(axes, scores, ids)
        _label_lines(axes, scores)
        squares = _squares()
        figure.legend(handles=squares, loc="outside lower left", ncols=len(squares), borderaxespad=0.2)
    data = [
        {"reading": row["reading"], "trial": row["trial"], **{id_: row[id_] for id_ in ids}}
        | {"hold": row["hold"], "score": row["score"]}
        for row in scores
    ]
    screened = sum(row["trial"] == "screen" for row in scores)
    caption = (
        f"{screened} readings of the paper, listed before any was run: the inertia ω, the half sides open to buoys and "
        "to waypoints [m], how the target moves, and what else is read otherwise. Above the line the finalists "
        f"({_length(scores, 'final')}), below it the screen of all ({_length(scores, 'screen')}), best first; in bold "
        "the chosen one. Squares: the verdict on each statement of the paper, then how many hold, and the score (1 for "
        "each that holds, 1/2 for each that holds partly)."
    )
    return Figure("readings", "Which reading of the paper?", caption, figure, data)


def readings_peaks_figure(scores: Sequence[Row], peaks: Sequence[Row]) -> Figure | None:
    """Draw where the curves over k peak under every reading, the paper's values as bands.

    Parameters
    ----------
    scores : rows of the score table, which give the order
    peaks : one row per reading, stage, swarm and target speed, with k_star and xi_peak_k and their intervals
    """
    if not scores or not peaks:
        return None
    data: list[Row] = []
    with style():
        figure = new_figure(DOUBLE, 1.0 + _LINE * len(scores))
        figure.set_layout_engine("constrained", h_pad=0.05, w_pad=0.05)
        panels = figure.subplots(1, len(_PEAKS), sharey=True)
        for axes, (title, fast, column, aim) in zip(panels, _PEAKS, strict=True):
            data += _draw_peaks(axes, scores, peaks, title, fast, column, aim)
        for number, axes in enumerate(panels):
            axes.set_title(lettered(number))
        _label_lines(panels[0], scores)
        for axes in panels[1:]:
            _part(axes, scores)
            axes.tick_params(axis="y", length=0)
        figure.legend(handles=_dots(), loc="outside lower left", ncols=2, borderaxespad=0.2)
    caption = (
        "Where the curves over k peak under every reading, with 95 % intervals; in gray what the paper says, 2.5 to "
        "either side. The order is that of the readings’ verdicts: finalists above the line."
    )
    return Figure("readings_peaks", "Peaks under every reading", caption, figure, data)


def _draw_verdicts(axes: "Axes", scores: Sequence[Row], ids: Sequence[str]) -> None:
    from matplotlib.patches import Rectangle

    for line, row in enumerate(scores):
        for place, id_ in enumerate(ids):
            color, sign = _SIGNS[row[id_]]
            axes.add_patch(Rectangle((place - 0.46, line - 0.44), 0.92, 0.88, facecolor=color, linewidth=0))
            ink = INK if row[id_] in ("holds partly", "undecided") else "white"
            axes.text(place, line, sign, ha="center", va="center", color=ink, fontsize=8.0)
        axes.text(len(ids) + 0.2, line, f"{row['hold']}", ha="center", va="center", fontsize=8.0)
        axes.text(len(ids) + 1.5, line, f"{row['score']:g}", ha="center", va="center", fontsize=8.0, color=GRAY)
    axes.set_xlim(-0.6, len(ids) + 2.1)
    axes.set_xticks([*range(len(ids)), len(ids) + 0.2, len(ids) + 1.5], [*ids, "hold", "score"])
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _draw_peaks(
    axes: "Axes", scores: Sequence[Row], peaks: Sequence[Row], title: str, fast: int, column: str, aim: float
) -> list[Row]:
    """Dots with intervals, at both target speeds."""
    data: list[Row] = []
    axes.axvspan(aim - 2.5, aim + 2.5, color="#e1e5e8", linewidth=0, zorder=0)
    known = {(row["reading"], row["trial"], row["target_speed"]): row for row in peaks if row["fast"] == fast}
    for line, row in enumerate(scores):
        for speed, color, marker, shift in _SPEEDS:
            found = known.get((row["reading"], row["trial"], speed))
            if found is None:
                continue
            at, low, high = (found[f"{column}{end}"] for end in ("", "_low", "_high"))
            axes.plot([low, high], [line - shift] * 2, color=color, linewidth=1.1, solid_capstyle="butt")
            axes.plot([at], [line - shift], marker, color=color, markersize=3.0)
            data.append({"reading": row["reading"], "trial": row["trial"], "quantity": title, "target_speed": speed,
                         "value": at, "low": low, "high": high})  # fmt: skip
    axes.set_xlabel(title)
    axes.set_xlim(*_LIMITS)
    axes.set_xticks([10, 20, 30, 40])
    axes.tick_params(axis="x", length=0)
    axes.grid(axis="x")
    return data


def _label_lines(axes: "Axes", scores: Sequence[Row]) -> None:
    """A name at every line, the chosen one in bold."""
    axes.set_yticks(range(len(scores)), [_name(row) for row in scores])
    axes.tick_params(axis="y", length=0)
    for row, label in zip(scores, axes.get_yticklabels(), strict=True):
        if row["chosen"]:
            label.set_fontweight("bold")
    _part(axes, scores)


def _part(axes: "Axes", scores: Sequence[Row]) -> None:
    """A line under the finalists."""
    axes.axhline(sum(row["trial"] == "final" for row in scores) - 0.5, color=INK, linewidth=1.0)
    axes.set_ylim(len(scores) - 0.5, -0.5)


def _name(row: Row) -> str:
    """Short, for a line."""
    words = {"omega ": "ω ", ", box ": ", ", " of the predecessor": "", "one buoy after the other": "sequential"}
    name = row["reading"]
    for long, short in words.items():
        name = name.replace(long, short)
    return f"{name} (printed)" if row.get("printed") else name


def _length(scores: Sequence[Row], stage: str) -> str:
    lengths = [row for row in scores if row["trial"] == stage]
    return f"{max(row['steps'] for row in lengths):,} steps, {lengths[0]['seeds']} seeds" if lengths else "none"


def _squares() -> list[Any]:
    from matplotlib.patches import Patch

    return [Patch(facecolor=color, label=f"{sign} {verdict}") for verdict, (color, sign) in _SIGNS.items()]


def _dots() -> list[Any]:
    from matplotlib.lines import Line2D

    return [
        Line2D([], [], color=color, marker=marker, markersize=3.5, linewidth=1.1, label=f"target {speed:g} m/s")
        for speed, color, marker, _ in _SPEEDS
    ]
