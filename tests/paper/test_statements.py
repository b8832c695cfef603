"""Statements at each target speed, and the score: what holds at one speed only, and what an "about" value is worth."""

import numpy as np
import pytest

from paper_rows import KS, SHARES, hill, made
from shoal.paper.clusters import Episode
from shoal.paper.statements import BOTH, at_full_length, holding, judge_statements, score, statements_of, verdict_on

POINTS = [(fast, k, speed) for fast in (15, 0) for k in KS for speed in (3.0, 5.0)]
POINTS += [(fast, k, speed) for fast in SHARES for k in (10, 20, 30, 40) for speed in (3.0, 5.0)]


def rows(k_star=lambda fast, speed: 18 if fast else 23, xi=lambda fast, speed: 25 if fast else 30, **more):
    metrics = {
        "time_on_target": lambda fast, k, speed: hill(k_star(fast, speed))(k) + 1e-3 * fast,
        "xi": lambda fast, k, speed: hill(xi(fast, speed))(k),
        "xi_raw": lambda fast, k, speed: hill(25)(k) * (1 + fast / 50),
        "stationary": lambda fast, k, speed: 0.01 * speed + 0.001 * fast,
    }
    return made(metrics, points=list(dict.fromkeys(POINTS)), noise=2e-4, **more)


def judged(main, steps=100_000):
    placement = [
        {**row, "fleets.BoB-1.start": start}
        for row in main
        for start in ("corner", "center")
        if (row["fast"], row["neighbors"]) == (15, 20)
    ]
    episodes = {3.0: [Episode(0, 0, 100, True)] * 3, 5.0: [Episode(0, 0, 100, True)] * 2}
    return judge_statements(main, placement, episodes, steps)


@pytest.fixture(scope="module")
def found():
    return judged(rows())


def test_every_statement_is_judged_at_each_speed_and_at_both(found):
    assert statements_of(found) == [f"C{number}" for number in range(1, 14)]
    for id_ in statements_of(found):
        speeds = {at for statement, at in found if statement == id_}
        assert speeds == ({BOTH} if id_ == "C9" else {"3", "5", BOTH})


def test_one_speed_sees_its_own_cases_alone(found):
    assert "5 m/s" not in found["C3", "3"].measured
    assert "3 m/s" not in found["C3", "5"].measured
    assert (found["C12", "3"].true, found["C12", BOTH].true) == (3, 5)


def test_an_about_value_that_is_met_at_one_speed_counts_as_met():
    found = judged(rows(k_star=lambda fast, speed: (18 if speed == 3.0 else 30) + (0 if fast else 5)))
    assert [found["C3", at].verdict for at in ("3", "5", BOTH)] == ["holds", "does not hold", "holds partly"]
    assert verdict_on("C3", found).verdict == "holds"


def test_any_other_statement_counts_at_both_speeds():
    found = judged(rows(k_star=lambda fast, speed: 18 if fast else (23 if speed == 3.0 else 14)))
    assert [found["C4", at].verdict for at in ("3", "5")] == ["holds", "does not hold"]
    assert verdict_on("C4", found) == found["C4", BOTH]


def test_the_score_is_the_sum_of_ones_and_halves(found):
    verdicts = [verdict_on(id_, found).verdict for id_ in statements_of(found)]
    assert holding(found) == verdicts.count("holds") > 6
    assert score(found) == verdicts.count("holds") + verdicts.count("holds partly") / 2


def test_the_spread_of_short_runs_is_told_for_long_ones():
    main = made({"time_on_target": lambda *_: 0.8, "xi": lambda *_: 0.8}, noise=0.01)
    long = at_full_length(main, 25_000)
    for metric in ("time_on_target", "xi"):
        short_spread, long_spread = (
            np.mean([np.std([row[metric] for row in rows[at : at + 5]]) for at in range(0, len(rows), 5)])
            for rows in (main, long)
        )
        assert long_spread == pytest.approx(short_spread / 2)
        assert np.mean([row[metric] for row in long]) == pytest.approx(np.mean([row[metric] for row in main]))
    assert judged(rows(), 25_000)["C13", BOTH].verdict != "undecided"
