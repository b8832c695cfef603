"""What depends on what the paper does not say: peaks and verdicts with each open choice made the other way."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from shoal.experiments.rows import Row
from shoal.paper.claims import SWARMS, c1, c2, c3, c4, c5, c6, c7, c8, c9, c10, c11, c12, c13
from shoal.paper.clusters import Episode
from shoal.paper.curves import Interval, curve, peak, values_of
from shoal.paper.plan import FULL_STEPS, MIXED
from shoal.paper.statements import at_full_length

CONCLUSIONS = (c1, c2, c3, c4, c5, c6, c7, c8, c9, c10)  # from the curves alone


class Extra(NamedTuple):
    """What C11 to C13 need of a variant: other starts of the fast fleet, clusters, the length of its runs [steps]."""

    placement: Sequence[Row]
    episodes: Sequence[Episode]
    steps: int


def peak_table(rows: Sequence[Row]) -> list[Row]:
    """One row per swarm, target speed and variant (if the rows have any): k*, time on target there, k and height of the
    peak of Xi, each with its 95 % interval; `at_edge` where a peak lies at the first or last k that was run.
    """
    return [
        {**({"variant": name} if name else {}), "fast": fast, "target_speed": speed, **_peaks(of_swarm)}
        for name in _variants(rows) or [""]
        for speed in values_of(rows, "target_speed")
        for fast in SWARMS
        if (of_swarm := _where(rows, name, fast, speed))
    ]


def conclusion_table(rows: Sequence[Row], extras: Mapping[str, Extra] | None = None) -> list[Row]:
    """One row per variant: the verdicts on C1 to C13 at both target speeds, which of them the first variant decides
    otherwise, and the best time on target of the mixed swarm with the slow target: where it is near zero, peaks are
    peaks of nothing. C11 to C13 are judged of the variants that have an extra; C13 is extrapolated from shorter runs.
    """
    table: list[Row] = []
    for name in _variants(rows):
        mine = [row for row in rows if row["variant"] == name]
        claims = [conclude(mine) for conclude in CONCLUSIONS]
        if extra := (extras or {}).get(name):
            spread = at_full_length(mine, extra.steps)
            claims += [c11(mine, extra.placement), c12(extra.episodes), c13(spread, FULL_STEPS)]
        verdicts = {claim.id: claim.verdict for claim in claims}
        printed = table[0] if table else verdicts
        decided = [id_ for id_ in verdicts if "undecided" not in (verdicts[id_], printed[id_])]
        changed = [id_ for id_ in decided if verdicts[id_] != printed[id_]]
        slow = [
            row for row in mine if row["fast"] == MIXED and row["target_speed"] == min(values_of(mine, "target_speed"))
        ]
        best = curve(slow, "time_on_target").mean.max(initial=0.0)
        table.append({"variant": name, **verdicts, "changed": " ".join(changed), "time_on_target": float(best)})
    return table


def _variants(rows: Sequence[Row]) -> list[str]:
    """In the order of the plan."""
    return list(dict.fromkeys(row["variant"] for row in rows if "variant" in row))


def _where(rows: Sequence[Row], variant: str, fast: int, speed: float) -> list[Row]:
    return [
        row
        for row in rows
        if row["fast"] == fast and row["target_speed"] == speed and row.get("variant", "") == variant
    ]


def _peaks(rows: Sequence[Row]) -> Row:
    best, xi = (peak(curve(rows, metric)) for metric in ("time_on_target", "xi"))
    return {
        **_columns("k_star", best.place),
        **_columns("time_on_target", best.height),
        **_columns("xi_peak_k", xi.place),
        **_columns("xi", xi.height),
        "at_edge": best.at_edge or xi.at_edge,
    }


def _columns(name: str, number: Interval) -> Row:
    return {name: number.value, f"{name}_low": number.low, f"{name}_high": number.high}
