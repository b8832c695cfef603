"""The readings of the paper, best first: the verdict on every statement under each, and where its curves peak."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from shoal.paper.plan import MIXED
from shoal.paper.results import Figure, Row
from shoal.viz.style import FLEET_COLORS, GRAY, INK, new_figure, style

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
_LINE = 0.2  # [inch] height of a reading
_SPEEDS = ((3.0, FLEET_COLORS[0], "o", 0.16), (5.0, "#D55E00", "s", -0.16))


def readings_figure(scores: Sequence[Row], peaks: Sequence[Row]) -> Figure | None:
    """Draw one line per reading and stage: a square per statement, how many hold and the score, and three peaks.

    Parameters
    ----------
    scores : rows of the score table
    peaks : one row per reading, stage, swarm and target speed, with k_star and xi_peak_k and their intervals
    """
    if not scores:
        return None
    ids = [name for name in scores[0] if name[0] == "C" and name[1:].isdigit()]
    names = [_name(row) for row in scores]
    data: list[Row] = []
    with style():
        height = 1.15 + _LINE * len(scores)
        figure = new_figure(12.0, height)
        wide = (0.285, 0.285)
        top, tall = 1.0 - 0.62 / height, _LINE * len(scores) / height
        axes = figure.add_axes((wide[0], top - tall, wide[1], tall))
        _draw_verdicts(axes, scores, ids)
        axes.set_yticks(range(len(names)), names, fontsize=7.2)
        for line, row in enumerate(scores):
            if row["chosen"]:
                axes.get_yticklabels()[line].set_fontweight("bold")
        for panel, (title, fast, column, aim) in enumerate(_PEAKS):
            beside = figure.add_axes((0.665 + 0.113 * panel, top - tall, 0.1, tall))
            data += _draw_peaks(beside, scores, peaks, title, fast, column, aim)
        finals = sum(row["stage"] == "final" for row in scores)
        for beside in figure.axes:
            beside.axhline(finals - 0.5, color=INK, linewidth=1.0)
            beside.set_ylim(len(scores) - 0.5, -0.5)
        figure.legend(handles=_handles(), loc="lower left", bbox_to_anchor=(0.28, 0.0), ncols=6, borderaxespad=0.2)
    data = [{"reading": row["reading"], "stage": row["stage"], **{id_: row[id_] for id_ in ids}, "hold": row["hold"],
             "score": row["score"]} for row in scores] + data  # fmt: skip
    screened = sum(row["stage"] == "screen" for row in scores)
    caption = (
        f"{screened} readings of the paper, listed before any was run. Above the line the finalists "
        f"({_length(scores, 'final')}), below it the screen of all ({_length(scores, 'screen')}), best first; in bold "
        "the chosen one. Squares: the verdict on each statement of the paper, then how many hold, and the score (1 for "
        "one that holds, 1/2 for one that holds partly). Right: where the curves over k peak, with 95 % intervals, and "
        "in gray what the paper says, 2.5 to either side."
    )
    return Figure("readings", "Which reading of the paper?", caption, figure, data)


def _draw_verdicts(axes: "Axes", scores: Sequence[Row], ids: Sequence[str]) -> None:
    from matplotlib.patches import Rectangle

    for line, row in enumerate(scores):
        for place, id_ in enumerate(ids):
            color, sign = _SIGNS[row[id_]]
            axes.add_patch(Rectangle((place - 0.46, line - 0.44), 0.92, 0.88, facecolor=color, linewidth=0))
            ink = INK if row[id_] in ("holds partly", "undecided") else "white"
            axes.text(place, line, sign, ha="center", va="center", color=ink, fontsize=7.5)
        axes.text(len(ids) + 0.1, line, f"{row['hold']}", ha="center", va="center", fontsize=7.5)
        axes.text(len(ids) + 1.3, line, f"{row['score']:g}", ha="center", va="center", fontsize=7.5, color=GRAY)
    axes.set_xlim(-0.6, len(ids) + 1.9)
    axes.set_xticks([*range(len(ids)), len(ids) + 0.1, len(ids) + 1.3], [*ids, "hold", "score"], fontsize=7.0)
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
    known = {(row["reading"], row["stage"], row["target_speed"]): row for row in peaks if row["fast"] == fast}
    for line, row in enumerate(scores):
        for speed, color, marker, shift in _SPEEDS:
            found = known.get((row["reading"], row["stage"], speed))
            if found is None:
                continue
            at, low, high = (found[f"{column}{end}"] for end in ("", "_low", "_high"))
            axes.plot([low, high], [line - shift] * 2, color=color, linewidth=1.1, solid_capstyle="butt")
            axes.plot([at], [line - shift], marker, color=color, markersize=3.0)
            data.append({"reading": row["reading"], "stage": row["stage"], "quantity": title, "target_speed": speed,
                         "value": at, "low": low, "high": high})  # fmt: skip
    axes.set_title(title, fontsize=8.0, pad=14)
    axes.set_xlim(*_LIMITS)
    axes.set_xticks([10, 20, 30, 40])
    axes.xaxis.tick_top()
    axes.tick_params(axis="x", length=0, labelsize=7.0, pad=1)
    axes.set_yticks([])
    axes.grid(axis="x")
    for spine in axes.spines.values():
        spine.set_visible(False)
    return data


def _name(row: Row) -> str:
    return f"{row['reading']}{' (printed)' if row.get('printed') else ''}"


def _length(scores: Sequence[Row], stage: str) -> str:
    lengths = [row for row in scores if row["stage"] == stage]
    return f"{max(row['steps'] for row in lengths):,} steps, {lengths[0]['seeds']} seeds" if lengths else "none"


def _handles() -> list[Any]:
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    squares = [Patch(facecolor=color, label=f"{sign} {verdict}") for verdict, (color, sign) in _SIGNS.items()]
    dots = [
        Line2D([], [], color=color, marker=marker, markersize=3.5, linewidth=1.1, label=f"target {speed:g} m/s")
        for speed, color, marker, _ in _SPEEDS
    ]
    return [*squares, *dots]
