"""What Kwa, Philippot and Bouffanais, Swarm Intelligence 2023, say of the density of a swarm.

D1 to D5 are statements of the abstract, which gives them no number: the docstrings do, and were written before the
runs. Where a case is about the best of several, seeds are judged that did not choose it (leave_out.py). Exploitation
is the share of agents on target, exploration the area that agents newly pass through.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from shoal.experiments.rows import Row
from shoal.paper.cases import case_text, count, rising, verdict_of, worst
from shoal.paper.curves import Floats, Measured, RunCurve, curve, slopes, values_of
from shoal.paper.later_plan import AT_SIDES, NUMBERS
from shoal.paper.leave_out import best_gain, best_place
from shoal.paper.results import Claim

STATEMENTS = {
    "D1": "Tracking against density shows phases: where density matters most, it does more than at either end.",
    "D2": "Between them lies a transition with the largest collective response.",
    "D3": "There, exploration and exploitation trade off: more neighbors give more of one and less of the other.",
    "D4": "At any density the balance can be set, by k, so that tracking is better.",
    "D5": "At a fixed density the number of agents changes exploitation most in the transition.",
}


def density_claims(rows: Mapping[str, Sequence[Row]]) -> list[Claim]:
    """Return all five; `rows` by group of later_plan.density_groups."""
    side = rows["side"]
    return [d1(side), d2(side), d3(side), d4(side), d5({side: rows[f"number/{side:g}"] for side in AT_SIDES})]


def d1(rows: Sequence[Row]) -> Claim:
    """Cases: what halving the density costs where it costs most less what it costs first, and last, at every k."""
    gains = {}
    for k, over in _over_side(rows, "time_on_target").items():
        costs = -np.diff(over.runs, axis=1) / (2 * np.diff(np.log2(over.x)))  # per halving
        if costs.shape[1] > 2:
            gains[f"over the densest, k = {k:g}"] = best_gain(costs[:, 1:-1], costs[:, 0])
            gains[f"over the sparsest, k = {k:g}"] = best_gain(costs[:, 1:-1], costs[:, -1])
    return _claim("D1", gains, "halving the density costs more there by {}", 100.0, "% points")


def d2(rows: Sequence[Row]) -> Claim:
    """Cases: Xi at the density where it is highest less that at the highest, and at the lowest density, at every k."""
    gains = {}
    for k, over in _over_side(rows, "xi").items():
        if over.x.size > 2:
            gains[f"over the densest, k = {k:g}"] = best_gain(over.runs[:, 1:-1], over.runs[:, 0])
            gains[f"over the sparsest, k = {k:g}"] = best_gain(over.runs[:, 1:-1], over.runs[:, -1])
    return _claim("D2", gains, "Xi is higher there by {}", 1.0, "")


def d3(rows: Sequence[Row]) -> Claim:
    """Cases: the slope over k of the agents on target, and the negative one of the coverage, at the side at which Xi is
    highest, relative to their means.
    """
    side = _transition(rows)
    gains = {}
    for name, metric, sign in (("on target", "engaged", 1.0), ("coverage", "coverage", -1.0)):
        over_k = _over_k(rows, metric, side)
        if over_k.x.size > 2:
            gains[f"{name}, side {side:g} m"] = sign * 10 * slopes(over_k) / over_k.runs.mean()
    return _claim("D3", gains, "ten neighbors more give {}", 100.0, "%")


def d4(rows: Sequence[Row]) -> Claim:
    """Cases: time on target at the best k less the mean over all k, at every side."""
    gains = {}
    for side in values_of(rows, "area.width"):
        over_k = _over_k(rows, "time_on_target", side)
        if over_k.x.size > 1:
            gains[f"side {side:g} m"] = best_gain(over_k.runs, over_k.runs.mean(axis=1))
    return _claim("D4", gains, "the best k gains {}", 100.0, "% points")


def d5(rows: Mapping[float, Sequence[Row]]) -> Claim:
    """Cases: how much the share of agents on target changes from the fewest to the most agents, in the middle of three
    densities less that in each of the others, relative to the fewest.
    """
    changes = {}
    for side, mine in rows.items():
        share = curve(mine, _share_on_target, "agents")
        if share.x.size == len(NUMBERS):
            changes[side] = np.abs(share.runs[:, -1] / share.runs[:, 0] - 1.0)
    gains = {}
    if len(changes) == len(AT_SIDES):
        dense, middle, sparse = AT_SIDES
        gains = {f"over side {other:g} m": changes[middle] - changes[other] for other in (dense, sparse)}
    return _claim("D5", gains, "the change is larger there by {}", 100.0, "%")


def _share_on_target(row: Row) -> float:
    return float(row["engaged"]) / float(row["agents"])


def _over_side(rows: Sequence[Row], metric: Measured) -> dict[float, RunCurve]:
    """A metric over the side of the area at every k."""
    return {k: curve(rows, metric, "area.width", neighbors=k) for k in values_of(rows, "neighbors")}


def _over_k(rows: Sequence[Row], metric: Measured, side: float) -> RunCurve:
    """A metric over k in an area of this side."""
    where: dict[str, Any] = {"area.width": side}
    return curve(rows, metric, **where)


def _transition(rows: Sequence[Row]) -> float:
    """The side at which Xi, the mean over k, is highest."""
    sides = values_of(rows, "area.width")
    means = [_over_k(rows, "xi", side).runs.mean() for side in sides]
    return sides[best_place(np.array([means]))]


def _claim(id_: str, gains: Mapping[str, Floats], text: str, factor: float, unit: str) -> Claim:
    cases = [case._replace(number=case.number.times(factor)) for case in rising(gains)]
    least = worst(cases)
    measured = f"{text.format(case_text(least, f' {unit}' if unit else ''))}; {count(cases)}"
    return Claim(id_, STATEMENTS[id_], measured, *least.number, unit, verdict_of(cases), "density", *count(cases))
