"""The claims C1-C13 of the OCEANS 2020 paper: what it says, what our runs give, and the verdict.

Each function's docstring says its cases; how they add up is in cases.py. Key number: the case that speaks most against
the claim. A k that the paper reads off a plot ("about 18") is 2.5 to either side, and half a k for its last digit.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import pairwise

import numpy as np

from shoal.experiments.rows import Row
from shoal.paper.cases import (
    Case,
    Truth,
    about,
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
from shoal.paper.clusters import Episode
from shoal.paper.curves import (
    Floats,
    Interval,
    Measured,
    Peak,
    RunCurve,
    bootstrap,
    cells,
    curve,
    heading_nowhere,
    heading_there,
    peak,
    peak_difference,
    slopes,
    values_of,
)
from shoal.paper.plan import AGENTS, FULL_STEPS, MIXED, SHARE_NEIGHBORS, START_PLACES
from shoal.paper.results import Claim

SAME = 0.01  # a difference in time on target that does not matter
SPREAD, SPREAD_DIGIT = 0.003, 0.0005  # C13: 0.3 %, and half of its last digit
FEW_CASES = 4  # are listed one by one
SEEDS = 5  # of the paper
SWARMS = {MIXED: "mixed", 0: "all slow"}
STATEMENTS = {
    "C1": "Time on target rises with the share of fast buoys, at every k and both target speeds.",
    "C2": "The gain from fast buoys shrinks at high k.",
    "C3": "With 15 fast buoys of 50, time on target peaks at k* of about 18.",
    "C4": "k* is lower for the mixed than for the all-slow swarm.",
    "C5": "Xi peaks at a k of about 25 (mixed) and about 30 (all slow).",
    "C6": "The k at which Xi peaks exceeds k*.",
    "C7": "Xi rises with the share of fast buoys from low to intermediate k.",
    "C8": "Higher k moves the heading-bearing histogram toward +1.",
    "C9": "A faster target gives more stationary agents.",
    "C10": "At k = 20 the all-slow swarm has fewer stationary agents than the mixed one.",
    "C11": "Where the fast buoys start does not matter.",
    "C12": "Fast buoys that cluster disperse again.",
    "C13": "Five runs of 100,000 steps vary by less than 0.3 % in time on target and Xi.",
}


def oceans_claims(
    main: Sequence[Row], placement: Sequence[Row], episodes: Sequence[Episode], steps: int
) -> list[Claim]:
    """Return all thirteen, with their verdicts."""
    of_main: tuple[Callable[[Sequence[Row]], Claim], ...] = (c1, c2, c3, c4, c5, c6, c7, c8, c9, c10)
    return [*(claim(main) for claim in of_main), c11(main, placement), c12(episodes), c13(main, steps)]


def c1(rows: Sequence[Row]) -> Claim:
    """Cases: 15 fast less none at every k and speed; the rise over either half of the shares where many were run."""
    rises = {
        f"15 fast less none, {_place(k, speed)}": gain.at(k)
        for speed in values_of(rows, "target_speed")
        for gain in [_gain(rows, speed)]
        for k in gain.x
    }
    for place, shares in _shares(rows, "time_on_target").items():
        halves = {"first": shares.between(0, 25), "second": shares.between(25, AGENTS)}
        rises |= {f"{each} half of the shares, {place}": 25 * slopes(half) for each, half in halves.items()}
    return _claim("C1", percent(rising(rises)), "the least rise is {}", "tot_share", "% points")


def c2(rows: Sequence[Row]) -> Claim:
    """Cases at each speed: the gain of 15 fast buoys over none, mean over k 10-20 less mean over k >= 40; the gain of
    50 over none at k = 20 less at k = 40.
    """
    losses = {}
    for speed in values_of(rows, "target_speed"):
        gain = _gain(rows, speed)
        low, high = gain.between(10, 20), gain.between(40, AGENTS)
        if low.x.size and high.x.size:
            losses[f"15 fast, {speed:g} m/s"] = low.runs.mean(axis=1) - high.runs.mean(axis=1)
        all_fast = _gain(rows, speed, fast=AGENTS)
        if {20, 40} <= set(all_fast.x):
            losses[f"50 fast, {speed:g} m/s"] = all_fast.at(20) - all_fast.at(40)
    return _claim("C2", percent(rising(losses)), "from k <= 20 to k >= 40 it shrinks by {}", "tot_k", "% points")


def c3(rows: Sequence[Row]) -> Claim:
    """Cases: k* of the mixed swarm at each speed, about 18."""
    return _about("C3", rows, "time_on_target", {MIXED: 18.0}, "k* is {}", "tot_k")


def c4(rows: Sequence[Row]) -> Claim:
    """Cases: k* of the all-slow less that of the mixed swarm, at each speed."""
    differences = {
        f"{speed:g} m/s": peak_difference(*(_peak(rows, "time_on_target", fast, speed) for fast in (0, MIXED)))
        for speed in values_of(rows, "target_speed")
    }
    return _higher("C4", differences, "it is lower by {}", "tot_k")


def c5(rows: Sequence[Row]) -> Claim:
    """Cases: k of the peak of Xi at each speed, about 25 (mixed) and about 30 (all slow)."""
    return _about("C5", rows, "xi", {MIXED: 25.0, 0: 30.0}, "it peaks at k = {}", "xi_k")


def c6(rows: Sequence[Row]) -> Claim:
    """Cases: k of the peak of Xi less k*, of both swarms at each speed."""
    differences = {
        f"{swarm}, {speed:g} m/s": peak_difference(
            *(_peak(rows, metric, fast, speed) for metric in ("xi", "time_on_target"))
        )
        for speed in values_of(rows, "target_speed")
        for fast, swarm in SWARMS.items()
    }
    return _higher("C6", differences, "it exceeds k* by {}", "xi_k")


def c7(rows: Sequence[Row]) -> Claim:
    """Cases: rise of the normalized Xi from no to all fast buoys (least squares), at each k up to 30 and speed."""

    def cases_of(metric: Measured) -> list[Case]:
        shares = _shares([row for row in rows if row["neighbors"] <= 30], metric)
        return rising({place: AGENTS * slopes(each) for place, each in shares.items()})

    note = f"; not normalized [m/s], {count(cases_of('xi_raw'))}"
    return _claim("C7", cases_of("xi"), "the least rise is {}", "xi_share", "1", note=note)


def c8(rows: Sequence[Row]) -> Claim:
    """Cases: agents with phi of 0.7 and more (the last two bins), from each k of 10, 20, 30, 40, 49 to the next, of
    both swarms at each speed.
    """
    rises = {}
    for speed in values_of(rows, "target_speed"):
        for fast, swarm in SWARMS.items():
            heading = curve(rows, heading_there, fast=fast, target_speed=speed)
            known = [k for k in (*SHARE_NEIGHBORS, AGENTS - 1) if k in heading.x]
            for k, more in pairwise(known):
                rises[f"k {k} to {more}, {swarm}, {speed:g} m/s"] = heading.at(more) - heading.at(k)
    text = "agents that head for the target change at least by {}"
    return _claim("C8", rising(rises), text, "phi_histograms", "agents")


def c9(rows: Sequence[Row]) -> Claim:
    """Cases: stationary agents with the fast less with the slow target, at k = 10, 20, 30, 40, of both swarms."""

    speeds = values_of(rows, "target_speed")

    def cases_of(metric: Measured, factor: float) -> list[Case]:
        more: dict[str, Floats] = {}
        for fast, swarm in SWARMS.items():
            slow, quick = (curve(rows, metric, fast=fast, target_speed=speed) for speed in (speeds[0], speeds[-1]))
            change = quick.minus(slow)
            more |= {f"k = {k}, {swarm}": factor * change.at(k) for k in SHARE_NEIGHBORS if k in change.x}
        return rising(more)

    note = f"; by the whole bin at phi = 0, {count(cases_of(heading_nowhere, 1.0))}"
    text = "the least difference is {}"
    return _claim("C9", cases_of("stationary", AGENTS), text, "phi_histograms", "agents", note=note)


def c10(rows: Sequence[Row]) -> Claim:
    """Cases: stationary agents of the mixed less of the all-slow swarm at k = 20, at each speed."""

    def cases_of(metric: Measured, factor: float) -> list[Case]:
        gains = {speed: _gain(rows, speed, metric) for speed in values_of(rows, "target_speed")}
        return rising({f"{speed:g} m/s": factor * gain.at(20) for speed, gain in gains.items() if 20 in gain.x})

    note = f"; by the whole bin at phi = 0, {count(cases_of(heading_nowhere, 1.0))}"
    text = "the mixed swarm has {} more"
    return _claim("C10", cases_of("stationary", AGENTS), text, "phi_histograms", "agents", note=note)


def c11(rows: Sequence[Row], placement: Sequence[Row]) -> Claim:
    """Cases: time on target with the fast fleet starting in a corner or at the center less uniform, in +- 0.01."""
    changes: dict[str, Floats] = {}
    for speed in values_of(placement, "target_speed"):
        uniform = curve(rows, "time_on_target", fast=MIXED, target_speed=speed)
        for start in START_PLACES:
            moved = curve(placement, "time_on_target", target_speed=speed, **{"fleets.BoB-1.start": start})
            change = moved.minus(uniform)
            changes |= {f"{start}, {_place(k, speed)}": change.at(k) for k in change.x}
    cases = judge(changes, lambda number: within(number, -SAME, SAME))
    return _claim("C11", percent(cases), "the largest change is {}", "tot_k", "% points", aim=0.0)


def c12(episodes: Sequence[Episode]) -> Claim:
    """Cases: every cluster seen; true if it dispersed, false if it did not in five times the longest that did, open if
    the run ended before. With fewer than three clusters, undecided.
    """
    lasted = [each.steps for each in episodes if each.dispersed]
    longest = max(lasted, default=0)
    number = bootstrap(lasted, np.median)
    cases = [
        Case("", number, True if each.dispersed else (False if each.steps > 5 * longest else None)) for each in episodes
    ]
    verdict = verdict_of(cases) if len(cases) >= 3 else "undecided"
    measured = (
        f"{len(lasted)} of {len(episodes)} clusters dispersed within the run; they lasted "
        f"{told_number(number)} steps (median), at most {longest}"
    )
    return Claim("C12", STATEMENTS["C12"], measured, *number, "steps", verdict, "clustering", *count(cases))


def c13(rows: Sequence[Row], steps: int) -> Claim:
    """Cases: the spread over runs / mean, in the median cell, of time on target and of Xi, at most 0.3 % to one
    digit. The paper does not say which spread, so both of: standard deviation, and standard error of five runs.
    Undecided for runs shorter than the claim's.
    """
    cases, notes = [], []
    told_by: dict[str, Measured] = {
        "time on target": "time_on_target",
        "Xi": "xi",
        "agents with phi > 0.7": heading_there,
    }
    for name, metric in told_by.items():
        found = cells(rows, metric)
        deviations = np.array([values.std(ddof=1) / values.mean() / _median_spread(values.size) for values in found])
        deviation = bootstrap(deviations, np.median)
        if name not in ("time on target", "Xi"):
            notes.append(f"{name} {told_number(deviation.times(100))} % (deviation; not in the claim)")
            continue
        for kind, number in (("deviation", deviation), ("error", deviation.times(SEEDS**-0.5))):
            case = judged(f"{name}, {kind}", number, _spread if steps >= FULL_STEPS else _untold)
            cases += percent([case])
    listed = "; ".join(case_text(case, " %") for case in cases)
    measured = (
        f"spread over runs of {steps:,} steps / mean, in the median cell, as standard deviation and as standard error "
        f"of {SEEDS} runs: {listed}; {'; '.join(notes)}"
    )
    highest = max(cases, key=lambda case: case.number.value)
    return Claim("C13", STATEMENTS["C13"], measured, *highest.number, "%", verdict_of(cases), "tot_k", *count(cases))


def _spread(number: Interval) -> Truth:
    return within(number, 0.0, SPREAD, SPREAD_DIGIT)


def _untold(number: Interval) -> Truth:
    return None


def _median_spread(runs: int) -> float:
    """Median standard deviation of so many normal values of deviation 1: the root of chi-square's median per degree.

    Wilson and Hilferty, PNAS 17, 1931.
    """
    return float((1 - 2 / (9 * (runs - 1))) ** 1.5)


def _about(id_: str, rows: Sequence[Row], metric: str, aims: Mapping[int, float], text: str, figure: str) -> Claim:
    """A claim that peaks lie at about some k, by the number of fast buoys."""
    peaks = {
        (fast, speed): _peak(rows, metric, fast, speed) for fast in aims for speed in values_of(rows, "target_speed")
    }
    cases = [
        judged(f"{SWARMS[fast]}, {speed:g} m/s", each.place, partial(about, k=aims[fast]))
        for (fast, speed), each in peaks.items()
    ]
    return _claim(id_, cases, text, figure, "k", aim=list(aims.values())[-1])


def _higher(id_: str, differences: Mapping[str, Interval], text: str, figure: str) -> Claim:
    """A claim that one k lies above another."""
    cases = [judged(name, number, positive) for name, number in differences.items()]
    return _claim(id_, cases, text, figure, "k")


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
    """A claim from its cases; `text` has a place for the worst of them, or for all where they are few."""
    key = worst(cases, aim)
    shown = cases if 0 < len(cases) <= FEW_CASES else [key]
    listed = "; ".join(case_text(case) for case in shown)
    rest = "" if len(shown) == len(cases) else f"; {count(cases)}"
    measured = f"{text.format(listed)}{rest}{note}"
    return Claim(id_, STATEMENTS[id_], measured, *key.number, unit, verdict_of(cases), figure, *count(cases))


def _peak(rows: Sequence[Row], metric: Measured, fast: int, speed: float) -> Peak:
    return peak(curve(rows, metric, fast=fast, target_speed=speed))


def _gain(rows: Sequence[Row], speed: float, metric: Measured = "time_on_target", fast: int = MIXED) -> RunCurve:
    """What fast buoys change over k, seed by seed."""
    mixed, slow = (curve(rows, metric, fast=count, target_speed=speed) for count in (fast, 0))
    return mixed.minus(slow)


def _shares(rows: Sequence[Row], metric: Measured) -> dict[str, RunCurve]:
    """The curves over the number of fast buoys, where two or more were run in either half."""
    curves = {
        _place(k, speed): curve(rows, metric, "fast", neighbors=k, target_speed=speed)
        for speed in values_of(rows, "target_speed")
        for k in values_of(rows, "neighbors")
    }
    return {place: each for place, each in curves.items() if min((each.x <= 25).sum(), (each.x >= 25).sum()) > 1}


def _place(k: float, speed: float) -> str:
    return f"k = {k:g}, {speed:g} m/s"
