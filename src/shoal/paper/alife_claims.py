"""What Kwa, Babineau, Philippot and Bouffanais, Artificial Life 2023, say of mixed fleets after a target that flees.

E1 to E4 are statements of the abstract, which gives them no number: the docstrings do, and were written before the
runs. The best of several choices is judged by seeds that did not choose it (leave_out.py).
"""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from shoal.experiments.rows import Row
from shoal.paper.cases import case_text, count, percent, rising, verdict_of, worst
from shoal.paper.curves import Floats, RunCurve, curve
from shoal.paper.later_plan import AGENTS, FAST_OF_FEWER, FEWER, FLEES_AT, LOW_K, SHARES, SPEED, UNEQUAL_AT
from shoal.paper.leave_out import best_gain
from shoal.paper.results import Claim

STATEMENTS = {
    "E1": "For a target that flees, too, there is an optimal balance of exploration and exploitation, set by k.",
    "E2": "Fast buoys in place of slow ones improve tracking, with nothing else changed.",
    "E3": "A lower k of the fast buoys, or of all, improves it further.",
    "E4": "Fast buoys make up for fewer buoys.",
}
BASE_FAST = 15


def alife_claims(rows: Mapping[str, Sequence[Row]]) -> list[Claim]:
    """Return all four; `rows` by group of later_plan.evasive_groups."""
    return [e1(rows["main"]), e2(rows["main"]), e3(rows["main"], rows["unequal"]), e4(rows["main"], rows["fewer"])]


def e1(main: Sequence[Row]) -> Claim:
    """Cases: time on target at the best k between the ends less that at the lowest, and at the highest k, of every
    fleet at each speed.
    """
    gains = {}
    for place, over_k in _curves(main).items():
        if over_k.x.size > 2:
            inside = over_k.runs[:, 1:-1]
            gains[f"over k = {over_k.x[0]:g}, {place}"] = best_gain(inside, over_k.runs[:, 0])
            gains[f"over k = {over_k.x[-1]:g}, {place}"] = best_gain(inside, over_k.runs[:, -1])
    return _claim("E1", gains, "the best k gains {}", "alife_k")


def e2(main: Sequence[Row]) -> Claim:
    """Cases: time on target with more fast buoys less that with fewer, of neighboring shares, at every k and speed."""
    gains: dict[str, Floats] = {}
    for speed in FLEES_AT:
        for fewer, more in pairwise(SHARES):
            gain = _curve(main, more, speed).minus(_curve(main, fewer, speed))
            gains |= {
                f"{more} fast less {fewer}, k = {k:g}, {speed:g} m/s": values
                for k, values in zip(gain.x, gain.runs.T, strict=True)
            }
    return _claim("E2", gains, "the least gain is {}", "alife_k")


def e3(main: Sequence[Row], unequal: Sequence[Row]) -> Claim:
    """Cases: the best of three lower k of the fast buoys less the same k for all, and the best lower k of all less that
    k, for two k, two shares and each speed.
    """
    gains = {}
    for speed in FLEES_AT:
        for fast in SHARES[1:]:
            all_alike = _curve(main, fast, speed)
            for k in UNEQUAL_AT:
                mine = [row for row in unequal if row["neighbors"] == k]
                lower = curve(mine, "time_on_target", "fleets.BoB-1.neighbors", fast=fast, **{SPEED: speed})
                place = f"{fast} fast, k = {k}, {speed:g} m/s"
                if k in all_alike.x and lower.x.size == len(LOW_K):
                    gains[f"lower for the fast, {place}"] = best_gain(lower.runs, all_alike.at(k))
                    gains[f"lower for all, {place}"] = best_gain(all_alike.between(0, k - 1).runs, all_alike.at(k))
    return _claim("E3", gains, "the best lower k gains {}", "alife_lower")


def e4(main: Sequence[Row], fewer: Sequence[Row]) -> Claim:
    """Cases: time on target of 30 and of 40 buoys with the best number of fast ones less that of 50 with 15."""
    gains = {}
    for speed in FLEES_AT:
        base = _curve(main, BASE_FAST, speed)
        for agents in FEWER:
            mixes = curve(fewer, "time_on_target", "fast", agents=agents, **{SPEED: speed})
            if UNEQUAL_AT[0] in base.x and mixes.x.size == len(FAST_OF_FEWER):
                gains[f"{agents} buoys, {speed:g} m/s"] = best_gain(mixes.runs, base.at(UNEQUAL_AT[0]))
    return _claim("E4", gains, f"over {AGENTS} buoys with {BASE_FAST} fast ones, fewer gain {{}}", "alife_fewer")


def _curve(rows: Sequence[Row], fast: int, speed: float) -> RunCurve:
    where: dict[str, Any] = {"fast": fast, SPEED: speed}
    return curve(rows, "time_on_target", **where)


def _curves(rows: Sequence[Row]) -> dict[str, RunCurve]:
    """Time on target over k of every fleet at each speed."""
    return {f"{fast} fast, {speed:g} m/s": _curve(rows, fast, speed) for speed in FLEES_AT for fast in SHARES}


def _claim(id_: str, gains: Mapping[str, Floats], text: str, figure: str) -> Claim:
    cases = percent(rising(gains))
    least = worst(cases)
    measured = f"{text.format(case_text(least, ' % points'))}; {count(cases)}"
    return Claim(id_, STATEMENTS[id_], measured, *least.number, "% points", verdict_of(cases), figure, *count(cases))
