"""C14 to C28 on made-up rows: each holds where its number says so, and not where it does not."""

import numpy as np
import pytest

from paper_rows import KS, hill, made
from shoal.paper.plan import SHARE_NEIGHBORS
from shoal.paper.side_claims import (
    STATEMENTS,
    c14,
    c15,
    c16,
    c17,
    c18,
    c19,
    c20,
    c21,
    c22,
    c23,
    c24,
    c25,
    c26,
    c27,
    c28,
    side_claims,
)
from shoal.paper.side_plan import BASE, CONSTANT, HALF, MEMORY, SWEEPS, UNREPELLED, settings
from shoal.paper.side_watch import Watched

SPEEDS = (3.0, 5.0)


def sides(values=None, xi=0.8, closest=0.3):
    """Rows of every setting: time on target 0.8 as it is, 0.6 under any other, unless `values` says otherwise."""
    told = {BASE: 0.8, **(values or {})}
    found = {}
    for name in settings("oceans2020"):
        ks = SHARE_NEIGHBORS if name in (BASE, MEMORY, UNREPELLED) else (20,)
        fasts = (15, 0) if name == BASE or name.startswith("start") else (15,)
        points = [(fast, k, speed) for fast in fasts for k in ks for speed in SPEEDS]
        level = told.get(name, 0.6)
        metrics = {
            "time_on_target": lambda fast, k, speed, level=level: level - (0.0 if fast else 0.1),
            "xi": lambda fast, k, speed, level=level, name=name: xi if name == BASE else 0.75 * xi,
            "closest": lambda fast, k, speed, name=name: closest if name == BASE else 0.01,
        }
        found[name] = [
            {**row, "time_on_target": row["time_on_target"] + 1e-5 * len(name) * row["run"]}
            for row in made(metrics, points=points, noise=1e-4, side=name)
        ]
    return found


def watched(adaptive=0.5, equal=0.2, filled=1.0):
    noise = 0.001 * np.arange(5)
    turnover = {(None, speed): adaptive + 2 * noise for speed in SPEEDS}
    turnover |= {(strength, speed): equal + noise for strength in CONSTANT for speed in SPEEDS}
    full = {(CONSTANT[-1], k): filled - 0.1 * noise for k in SHARE_NEIGHBORS}
    return Watched(turnover, {**full, (CONSTANT[0], 20): 0.8 + noise})


def main(k_star=lambda fast, speed: 20 - speed + (0 if fast else 5)):
    return made({"time_on_target": lambda fast, k, speed: hill(k_star(fast, speed))(k)}, noise=2e-4)


def test_there_are_fifteen_in_order_each_with_its_statement():
    rows = [row for of in sides().values() for row in of]
    claims = side_claims(main(), rows, watched())
    assert [claim.id for claim in claims] == [f"C{number}" for number in range(14, 29)] == list(STATEMENTS)
    assert all(claim.statement == STATEMENTS[claim.id] and claim.measured for claim in claims)
    assert all(claim.true + claim.open + claim.false > 0 for claim in claims)


def test_of_no_runs_all_are_undecided():
    claims = side_claims([], [], Watched({}, {}))
    assert {claim.verdict for claim in claims} == {"undecided"}


@pytest.mark.parametrize(
    ("judge", "worse"),
    [
        (c14, {f"constant a_R {each:.3g}": 0.9 for each in CONSTANT}),
        (c15, {MEMORY: 0.85}),
        (c16, {"d 4": 0.6, "d 8": 0.6}),
        (c18, dict.fromkeys(SWEEPS, 0.9)),
        (c20, {"5 of 50 lost": 0.6, HALF: 0.3}),
        (c21, {"25 buoys": 0.3, "100 buoys": 0.7}),
        (c22, {"target: line": 0.3, "target: walk": 0.3, "target: levy": 0.3}),
    ],
)
def test_what_the_settings_show_decides(judge, worse):
    good = {"d 4": 0.81, "d 8": 0.79, "5 of 50 lost": 0.78, "25 buoys": 0.5, "100 buoys": 0.9}
    better, other = sides(good), sides({**good, **worse})
    if judge is c14:  # both metrics must be worse for more false than true
        other = {name: [{**row, "xi": 0.9 if name != BASE else 0.8} for row in rows] for name, rows in other.items()}
    if judge is c16:
        better = {name: [{**row, "xi": 0.8} for row in rows] for name, rows in better.items()}
    assert judge(better).verdict == "holds"
    assert judge(other).verdict == "does not hold"


def test_sweeps_are_fragile_where_they_keep_less_than_the_swarm():
    parts = {
        name: share for sweep in SWEEPS for name, share in ((f"{sweep}, {HALF}", 0.2), (f"{sweep}, 25 buoys", 0.2))
    }
    whole = dict.fromkeys(SWEEPS, 0.5)
    assert c19(sides({**whole, **parts})).verdict == "holds"
    sturdy = dict.fromkeys(parts, 0.48)
    assert c19(sides({**whole, **sturdy})).verdict == "does not hold"


def test_a_faster_target_lowers_k_star_or_not():
    assert c17(main()).verdict == "holds"
    assert c17(main(lambda fast, speed: 15 + 2 * speed)).verdict == "does not hold"


def test_mixed_beats_all_slow_from_any_start_and_single_runs_are_counted():
    claim = c23(sides())
    assert claim.verdict == "holds"
    assert "above zero in 30 of 30 single runs" in claim.measured


def test_passing_is_more_with_unequal_repulsion_or_not():
    assert c24(watched()).verdict == "holds"
    assert c24(watched(adaptive=0.1)).verdict == "does not hold"


def test_the_area_is_covered_where_nineteen_in_twenty_fields_are():
    assert c25(watched(filled=0.97)).verdict == "holds"
    assert c25(watched(filled=0.9)).verdict == "does not hold"
    assert "at the smallest a_R 80 %" in c25(watched()).measured


def test_hulls_touch_at_a_fifth_of_a_meter():
    assert c26(sides(closest=0.25)).verdict == "holds"
    assert c26(sides(closest=0.15)).verdict == "does not hold"
    assert "without repulsion the smallest is 0.010 m" in c26(sides()).measured


def test_the_balance_is_kept_within_two_and_a_half_agents():
    rows = [
        {**row, "phi_histogram": [*row["phi_histogram"][:-1], 9.0 + 1e-3 * row["run"] * row["fast"]]} for row in main()
    ]
    assert c27(rows).verdict == "holds"
    more = [{**row, "phi_histogram": [*row["phi_histogram"][:-1], 99.0 + row["run"]]} for row in rows if row["fast"]]
    moved = [*more, *(row for row in rows if not row["fast"])]
    assert c27(moved).verdict == "does not hold"


def test_the_spread_of_headings_is_low_below_one_percent():
    rows = [{**row, "phi_histogram": [0.0] * 10 + [10.0 + 0.02 * row["run"]]} for row in main()]
    assert c28(rows).verdict == "holds"
    rows = [{**row, "phi_histogram": [0.0] * 10 + [10.0 + 0.5 * row["run"]]} for row in main()]
    assert c28(rows).verdict == "does not hold"


def test_every_k_of_the_curves_is_a_case_of_the_balance():
    claim = c27(main())
    assert claim.true + claim.open + claim.false == 2 * len(KS)
