"""What the paper says beside its figures, C14 to C28: each with a number that decides, and its verdict.

The paper gives most of these sentences no number, so the docstrings do: they were written before the runs. (C25 and C26
look at every run, rather than at an interval of the mean, since then: there runs agree to the last digit.)
"""

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np

from shoal.experiments.rows import Row
from shoal.paper.cases import (
    Case,
    case_text,
    count,
    judge,
    judged,
    percent,
    positive,
    rising,
    told_number,
    verdict_of,
    within,
    worst,
)
from shoal.paper.claims import SWARMS
from shoal.paper.curves import (
    Floats,
    Interval,
    Measured,
    RunCurve,
    bootstrap,
    cells,
    curve,
    heading_there,
    peak,
    peak_difference,
    values_of,
)
from shoal.paper.plan import MIXED
from shoal.paper.results import Claim
from shoal.paper.side_plan import (
    BASE,
    CONSTANT,
    EXPONENTS,
    FEW,
    HALF,
    MANY,
    MEMORY,
    MOVEMENTS,
    STARTS,
    SWEEPS,
    TENTH,
    UNREPELLED,
    constant_name,
    exponent_name,
)
from shoal.paper.side_watch import Watched

MODERATE = 0.05  # a change of a metric by d, relative
BALANCE = 2.5  # agents: a twentieth of the swarm
FILLED = 0.95  # share of 25 fields with a buoy in it; 50 buoys at random places leave 13 % empty
HULL = 0.2  # [m] side of a cube of water as heavy as a BoB-0, 7.4 kg: nearer than this, two of them touch
LOW_SPREAD = 0.01
_FEW_CASES = 4
STATEMENTS = {
    "C14": "Adaptive repulsion beats constant repulsion, in time on target and responsiveness.",
    "C15": "Memory of the agents is counter-effective.",
    "C16": "The exponent d has very moderate effects.",
    "C17": "The optimal k depends on the speed of the target: the faster it is, the lower k*.",
    "C18": "Systematic sweeps are inadequate for targets faster than the agents.",
    "C19": "Sweeps are not scalable and cannot cope with failures; the swarm can.",
    "C20": "Robustness: the swarm tolerates the failure of agents.",
    "C21": "Scalability: the swarm carries out its mission with differing numbers of agents.",
    "C22": "Flexibility: the swarm performs in a changing environment.",
    "C23": "From any start, the mixed swarm beats the all-slow one.",
    "C24": "Buoys pass each other because their repulsion differs at any time.",
    "C25": "At the largest repulsion the swarm covers the entire area when there is no target.",
    "C26": "Repulsion keeps buoys from colliding.",
    "C27": "Fast buoys do not affect the balance of exploration and exploitation, at any k.",
    "C28": "The heading-bearing histogram varies little between runs.",
}

Sides = Mapping[str, Sequence[Row]]  # rows of every setting of side_plan


def side_claims(main: Sequence[Row], sides: Sequence[Row], watched: Watched) -> list[Claim]:
    """Return all fifteen; `main` are the rows of the curves, `sides` those of the settings, labeled by `side`."""
    of: dict[str, list[Row]] = {}
    for row in sides:
        of.setdefault(row["side"], []).append(row)
    by_side = (c14, c15, c16, c18, c19, c20, c21, c22, c23, c26)
    claims = [claim(of) for claim in by_side] + [c17(main), c24(watched), c25(watched), c27(main), c28(main)]
    return sorted(claims, key=lambda claim: int(claim.id[1:]))


def c14(sides: Sides) -> Claim:
    """Cases: relative gain of the adaptive over each of four constant a_R in time on target and Xi, at each speed."""
    gains = {
        f"{name}, a_R {strength:.3g}, {place}": base / other - 1.0
        for metric, name in (("time_on_target", "time on target"), ("xi", "Xi"))
        for strength in CONSTANT
        for place, (base, other) in _pairs(sides, BASE, constant_name(strength), metric).items()
    }
    return _claim("C14", percent(rising(gains)), "the least gain is {}", "sides", "%")


def c15(sides: Sides) -> Claim:
    """Cases: time on target without less with the memory of memory-pso, at four k and each speed."""
    losses = {place: base - other for place, (base, other) in _pairs(sides, BASE, MEMORY).items()}
    return _claim("C15", percent(rising(losses)), "the least that memory costs is {}", "sides", "% points")


def c16(sides: Sides) -> Claim:
    """Cases: relative change of time on target and Xi with d = 4 and 8 instead of 6, at each speed, in +- 5 %."""
    changes = {
        f"{name}, d {exponent:g}, {place}": other / base - 1.0
        for metric, name in (("time_on_target", "time on target"), ("xi", "Xi"))
        for exponent in EXPONENTS
        for place, (base, other) in _pairs(sides, BASE, exponent_name(exponent), metric).items()
    }
    cases = judge(changes, partial(within, low=-MODERATE, high=MODERATE))
    return _claim("C16", percent(cases), "the largest change is {}", "sides", "%", aim=0.0)


def c17(main: Sequence[Row]) -> Claim:
    """Cases: k* with the slow target less that with the fast one, of both swarms."""
    speeds = values_of(main, "target_speed")
    cases = []
    for fast, swarm in SWARMS.items() if speeds else ():
        ends = (curve(main, "time_on_target", fast=fast, target_speed=speed) for speed in (speeds[0], speeds[-1]))
        cases.append(judged(swarm, peak_difference(*map(peak, ends)), positive))
    return _claim("C17", cases, "k* is lower with the faster target by {}", "tot_k", "k")


def c18(sides: Sides) -> Claim:
    """Cases: time on target of the swarm less that of each of three sweeps, at each speed (both beat every buoy)."""
    gains = {
        f"{sweep}, {place}": base - other
        for sweep in SWEEPS
        for place, (base, other) in _pairs(sides, BASE, sweep).items()
    }
    return _claim("C18", percent(rising(gains)), "the swarm is better by {} at least", "sides", "% points")


def c19(sides: Sides) -> Claim:
    """Cases: share of its time on target that the swarm keeps with half of the buoys lost (failure), or with 25 instead
    of 50 (scale), less the share that each of three sweeps keeps, at each speed.
    """
    more: dict[str, Floats] = {}
    for what, changed in (("lost", HALF), ("fewer", FEW)):
        swarm = _kept(sides, BASE, changed)
        for sweep in SWEEPS:
            its = _kept(sides, sweep, f"{sweep}, {changed}")
            more |= {f"half {what}, {sweep}, {place}": swarm[place] - its[place] for place in swarm if place in its}
    return _claim("C19", percent(rising(more)), "the swarm keeps {} more at least", "sides", "% points")


def c20(sides: Sides) -> Claim:
    """Robustness is the share of time on target kept when agents are lost at once. Cases: at least 90 % with a tenth of
    them lost, at least half with half of them lost, at each speed.
    """
    spare = {f"a tenth lost, {place}": kept - 0.9 for place, kept in _kept(sides, BASE, TENTH).items()}
    spare |= {f"half lost, {place}": kept - 0.5 for place, kept in _kept(sides, BASE, HALF).items()}
    return _claim("C20", percent(rising(spare)), "above the bar by {} (shares kept)", "sides", "% points")


def c21(sides: Sides) -> Claim:
    """Scalability is the time on target with another number of agents / that with 50. Cases: more than half with 25,
    more than all with 100, at each speed.
    """
    spare = {f"25 buoys, {place}": kept - 0.5 for place, kept in _kept(sides, BASE, FEW).items()}
    spare |= {f"100 buoys, {place}": kept - 1.0 for place, kept in _kept(sides, BASE, MANY).items()}
    return _claim("C21", percent(rising(spare)), "above the bar by {}", "sides", "% points")


def c22(sides: Sides) -> Claim:
    """Flexibility is the time on target with a target that moves otherwise / that with the paper's. Cases: more than
    half on straight lines, a persistent walk and a Levy walk, at each speed.
    """
    spare = {
        f"{kind}, {place}": kept - 0.5
        for kind in MOVEMENTS
        for place, kept in _kept(sides, BASE, f"target: {kind}").items()
    }
    return _claim("C22", percent(rising(spare)), "above the bar by {} at least", "sides", "% points")


def c23(sides: Sides) -> Claim:
    """Cases: time on target of the mixed less that of the all-slow swarm when all start everywhere, in a corner or at
    the center, at each speed. Told besides: in how many single runs.
    """
    gains: dict[str, Floats] = {}
    for name in (BASE, *(f"start: {start}" for start in STARTS)):
        rows = [row for row in sides.get(name, ()) if row["neighbors"] == 20]
        for speed in values_of(rows, "target_speed"):
            mixed, slow = (curve(rows, "time_on_target", fast=fast, target_speed=speed) for fast in (MIXED, 0))
            where = "start: anywhere" if name == BASE else name
            gains[f"{where}, {speed:g} m/s"] = mixed.minus(slow).at(20)
    runs = np.concatenate(list(gains.values())) if gains else np.array([])
    note = f"; above zero in {int((runs > 0).sum())} of {runs.size} single runs"
    return _claim("C23", percent(rising(gains)), "the least gain is {}", "sides", "% points", note=note)


def c24(watched: Watched) -> Claim:
    """Cases: share of a buoy's six nearest that others replace within 10 s, with adaptive a_R less with an equal
    constant one (four of them), at each speed.
    """
    more = {
        f"a_R {strength:.3g}, {speed:g} m/s": watched.turnover[None, speed] - values
        for (strength, speed), values in watched.turnover.items()
        if strength is not None
    }
    adaptive = "; ".join(
        f"{told_number(bootstrap(100 * values, np.mean))} % at {speed:g} m/s"
        for (strength, speed), values in watched.turnover.items()
        if strength is None
    )
    note = f"; adaptive: {adaptive}"
    return _claim(
        "C24", percent(rising(more)), "more neighbors change by {} at least", "clustering", "% points", note=note
    )


def c25(watched: Watched) -> Claim:
    """Cases: share of 25 equal fields of the buoys' area with a buoy in it, without a target, at the largest a_R and
    four k: at least 95 % in every run (50 buoys at random places: 87 %).
    """
    largest = {f"k = {k}": values for (strength, k), values in watched.filled.items() if strength == CONSTANT[-1]}
    cases = _in_every_run(largest, FILLED)
    least = [values for (strength, _), values in watched.filled.items() if strength == CONSTANT[0]]
    note = f"; at the smallest a_R {100 * float(np.mean(least[0])):.0f} %" if least else ""
    return _claim("C25", percent(cases), "fields with a buoy in it: {} %", "locked", "%", note=note)


def c26(sides: Sides) -> Claim:
    """Cases: smallest distance between two buoys in a run, at four k and each speed: in every run above 0.2 m, at which
    two hulls touch (the side of a cube of water as heavy as a BoB-0). Told besides: the same without repulsion.
    """
    known = _pairs(sides, BASE, UNREPELLED, "closest")
    least = min((float(other.min()) for _, other in known.values()), default=np.nan)
    without = f"; without repulsion the smallest is {least:.3f} m"
    cases = _in_every_run({place: base for place, (base, _) in known.items()}, HULL)
    return _claim("C26", cases, "the smallest distance is {} m", "sides", "m", note=without)


def c27(main: Sequence[Row]) -> Claim:
    """Cases: agents with phi of 0.7 and more in the mixed less in the all-slow swarm, at every k and speed, in +- 2.5
    of 50.
    """
    changes: dict[str, Floats] = {}
    for speed in values_of(main, "target_speed"):
        change = _gain(main, speed, heading_there)
        changes |= {f"k = {k:g}, {speed:g} m/s": change.at(k) for k in change.x}
    cases = judge(changes, partial(within, low=-BALANCE, high=BALANCE))
    return _claim("C27", cases, "the largest change is {}", "phi_histograms", "agents", aim=0.0)


def c28(main: Sequence[Row]) -> Claim:
    """The paper gives no number. Case: standard deviation over runs / mean of the agents with phi of 0.7 and more, in
    the median cell, below 1 %.
    """
    spreads = [values.std(ddof=1) / values.mean() for values in cells(main, heading_there)]
    number = bootstrap(spreads, np.median)
    cases = percent([judged("agents with phi of 0.7 and more", number, partial(within, low=0.0, high=LOW_SPREAD))])
    return _claim("C28", cases, "standard deviation / mean over runs, in the median cell: {} %", "phi_histograms", "%")


def _in_every_run(numbers: Mapping[str, Floats], least: float) -> list[Case]:
    """Cases that are true where no run has less, false where all have; the bounds are the runs' extremes.

    For numbers that runs share to the last digit (all fields are filled, two buoys touch): these have no interval.
    """
    return [
        judged(
            name, Interval(float(values.mean()), float(values.min()), float(values.max())), partial(_above, least=least)
        )
        for name, values in numbers.items()
        if values.size
    ]


def _above(number: Interval, least: float) -> bool | None:
    return True if number.low >= least else False if number.high < least else None


def _pairs(sides: Sides, one: str, other: str, metric: Measured = "time_on_target") -> dict[str, tuple[Floats, Floats]]:
    """The mixed swarm under two settings at every k and speed that both have, seed by seed."""
    found = {}
    for speed in values_of(sides.get(one, ()), "target_speed"):
        curves = [curve(sides.get(name, ()), metric, fast=MIXED, target_speed=speed) for name in (one, other)]
        for k in np.intersect1d(curves[0].x, curves[1].x):
            place = f"k = {k:g}, {speed:g} m/s" if len(curves[1].x) > 1 else f"{speed:g} m/s"
            first, second = (each.at(k) for each in curves)
            seeds = min(first.size, second.size)
            found[place] = (first[:seeds], second[:seeds])
    return found


def _kept(sides: Sides, base: str, part: str) -> dict[str, Floats]:
    """Share of the time on target of one setting that another keeps, by place."""
    return {place: its / basis for place, (basis, its) in _pairs(sides, base, part).items()}


def _gain(rows: Sequence[Row], speed: float, metric: Measured) -> RunCurve:
    mixed, slow = (curve(rows, metric, fast=fast, target_speed=speed) for fast in (MIXED, 0))
    return mixed.minus(slow)


def _claim(
    id_: str,
    cases: Sequence[Case],
    text: str,
    figure: str,
    unit: str,
    *,
    aim: float | None = None,
    note: str = "",
) -> Claim:
    """As the claims of the paper's figures are worded: all cases where they are few, else the worst."""
    key = worst(cases, aim)
    shown = cases if 0 < len(cases) <= _FEW_CASES else [key]
    listed = "; ".join(case_text(case) for case in shown)
    rest = "" if len(shown) == len(cases) else f"; {count(cases)}"
    measured = f"{text.format(listed)}{rest}{note}"
    return Claim(id_, STATEMENTS[id_], measured, *key.number, unit, verdict_of(cases), figure, *count(cases))
