"""Comparisons as figures: what charts are given."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.drawing.comparison import Bar, Panel, bars_figure, curves_figure
from shoal.drawing.curves import Curve
from shoal.drawing.style import Width
from shoal.drawing.words import field_words
from shoal.experiments.comparison import Comparison, Condition
from shoal.experiments.contenders import LATTICE
from shoal.experiments.leaderboard import Leaderboard
from shoal.experiments.paired import SIGNIFICANT
from shoal.record.names import label_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def comparison_figure(comparison: Comparison, metric: str, width: Width = "double") -> "Figure":
    """Curves if one number varies, else bars: a panel per condition; one or two columns of a journal wide."""
    label = label_of(metric)
    points = [each.point for each in comparison.conditions]
    if len(points) > 1 and all(len(point) == 1 and _is_number(*point.values()) for point in points):
        field = next(iter(points[0]))
        labels = field_words(field), label
        runs = _runs(comparison.conditions)
        return curves_figure(_curves(comparison, field), labels, runs, LATTICE, _informed(comparison), width)
    note = _note(comparison.conditions, comparison.baseline)
    return bars_figure(_panels(comparison.conditions, _order(comparison.conditions)), label, note, LATTICE, width)


def leaderboard_figure(board: Leaderboard, width: Width = "double") -> "Figure":
    """The score, then the share under each condition, all in the order of the score."""
    order = [each.strategy for each in board.overall.standings]
    conditions = [board.overall, *board.shares.conditions]
    return bars_figure(_panels(conditions, order), "share", _note(conditions, LATTICE), LATTICE, width)


def _runs(conditions: Sequence[Condition]) -> str:
    """20 runs of each."""
    counts = sorted({len(each.value.runs) for condition in conditions for each in condition.standings})
    many = f"{counts[0]} to {counts[-1]}" if len(counts) > 1 else str(counts[0])
    return f"{many} run{'s' * (counts[-1] != 1)} of each"


def _note(conditions: Sequence[Condition], baseline: str) -> str:
    """Of how many runs bars are, and what their signs are."""
    shown = any(_SIGNS.get(each.verdict) for condition in conditions for each in condition.standings)
    signs = f". +, −: better, worse than {baseline}, paired, adjusted p (Holm) < {SIGNIFICANT:g}" if shown else ""
    return _runs(conditions) + signs


_SIGNS = {"better": "+", "worse": "\u2212"}


def _panels(conditions: Sequence[Condition], order: Sequence[str]) -> list[Panel]:
    return [Panel(each.name, [_bar(each, strategy) for strategy in order]) for each in conditions]


def _bar(condition: Condition, strategy: str) -> Bar:
    each = condition.of(strategy)
    low, high = each.value.ci95 or (None, None)
    return Bar(strategy, each.value.mean, low, high, each.informed, _SIGNS.get(each.verdict, ""))


def _order(conditions: Sequence[Condition]) -> list[str]:
    """By mean place over all conditions, which is the ranking if there is one."""
    places: dict[str, list[int]] = {}
    for condition in conditions:
        for place, each in enumerate(condition.standings):
            places.setdefault(each.strategy, []).append(place)
    return sorted(places, key=lambda strategy: float(np.mean(places[strategy])))


def _curves(comparison: Comparison, field: str) -> list[Curve]:
    conditions = sorted(comparison.conditions, key=lambda each: float(each.point[field]))
    curves = []
    for first in comparison.conditions[0].standings:
        curve = Curve(first.strategy)
        for condition in conditions:
            value = condition.of(first.strategy).value
            low, high = value.ci95 or (None, None)
            curve.add(condition.point[field], value.mean, low, high)
        curves.append(curve)
    return curves


def _informed(comparison: Comparison) -> list[str]:
    return [each.strategy for each in comparison.conditions[0].standings if each.informed]


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
