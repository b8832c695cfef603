"""The published numbers of the predecessor beside ours.

Kwa, Leong Kit, Bouffanais, "Optimal Swarm Strategy for Dynamic Target Search and Tracking", AAMAS 2020: 50 equal
buoys, adaptive repulsion, target at 2 m/s, 100,000 steps. The figures are those of its public results repository
(AirKeen/kNNTargetSearch). Of constant repulsion there are none here: only our curve is shown.
"""

import math
from collections.abc import Sequence

import numpy as np

from shoal.experiments.rows import Row
from shoal.paper.cases import Case, case_text, count, verdict_of
from shoal.paper.curves import Floats, Interval, curve, intervals
from shoal.paper.results import Claim
from shoal.record.statistics import t_quantile

PRESET = "aamas2020"
NEIGHBORS = tuple(range(10, 50, 3))
PUBLISHED = {
    "time_on_target": (
        0.73255, 0.79037, 0.81704, 0.82288, 0.80348, 0.78510, 0.75998,
        0.73836, 0.71843, 0.70023, 0.68245, 0.66815, 0.64997, 0.63337,
    ),
    "response": (
        2.068, 2.669, 3.150, 3.508, 3.732, 3.864, 3.903, 3.899, 3.858, 3.789, 3.705, 3.599, 3.485, 3.276,
    ),
}  # fmt: skip
BARS = {"time_on_target": (0.015, 0.0), "response": (0.0, 0.03)}  # absolute, relative
_NAMES = {
    "time_on_target": ("A1", "time on target", "1", "within 0.015"),
    "response": ("A2", "response", "unit/step", "within 3 %"),
}


def residual_table(rows: Sequence[Row]) -> list[Row]:
    """One row per metric and k: ours with its 95 % interval, the published number, the residual, and what is tolerated.

    Tolerated is the bar (0.015, or 3 %), or where that is wider the spread of runs: the 95 % prediction interval of one
    more run, its standard deviation pooled over k. `verdict` is "holds" or "does not hold".
    """
    table = []
    for metric, numbers in PUBLISHED.items():
        absolute, relative = BARS[metric]
        ours = curve(rows, metric, preset=PRESET)
        spread = _spread(ours.runs) if ours.x.size else math.nan
        found = dict(zip(ours.x, intervals(list(ours.runs.T), ours.bounds), strict=True))
        for k, published in zip(NEIGHBORS, numbers, strict=True):
            if k not in found:
                continue
            measured = found[k]
            residual = measured.value - published
            tolerance = float(np.fmax(absolute + relative * published, spread))
            table.append(
                {
                    "metric": metric,
                    "neighbors": k,
                    "measured": measured.value,
                    "low": measured.low,
                    "high": measured.high,
                    "published": published,
                    "residual": residual,
                    "tolerance": tolerance,
                    "verdict": "holds" if abs(residual) <= tolerance else "does not hold",
                }
            )
    return table


def published_claims(table: Sequence[Row]) -> list[Claim]:
    """A1 and A2: every published time on target, and every published response, is met. Cases: the cells."""
    claims = []
    for metric, (id_, name, unit, bar) in _NAMES.items():
        cases = [
            Case(
                f"k = {row['neighbors']}",
                Interval(row["residual"], row["low"] - row["published"], row["high"] - row["published"]),
                row["verdict"] == "holds",
            )
            for row in table
            if row["metric"] == metric
        ]
        if cases:
            largest = max(cases, key=lambda case: abs(case.number.value))
            claims.append(
                Claim(
                    id_,
                    f"The published {name} over k is met {bar}, or within the spread of runs.",
                    f"the largest residual is {case_text(largest)}; {count(cases)}",
                    *largest.number,
                    unit,
                    verdict_of(cases),
                    "published",
                    *count(cases),
                )
            )
    return claims


def _spread(runs: Floats) -> float:
    """Half of the 95 % prediction interval of one more run, from runs (R, K) about their means."""
    seeds, places = runs.shape
    if seeds < 2:
        return math.nan
    deviation = math.sqrt(float(runs.var(axis=0, ddof=1).mean()))
    return t_quantile(places * (seeds - 1)) * deviation * math.sqrt(1 + 1 / seeds)
