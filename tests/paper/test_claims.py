"""Each verdict follows from numbers whose truth is known: made true a claim holds, reversed it does not."""

import pytest

from paper_rows import KS, SHARES, hill, made
from shoal.paper import claims
from shoal.paper.clusters import Episode

GRID = [(fast, k, speed) for fast in SHARES for k in (10, 20, 30, 40) for speed in (3.0, 5.0)]
CURVES = [(fast, k, speed) for fast in (15, 0) for k in KS for speed in (3.0, 5.0)]


def rows(metric, truth, points=None, **options):
    return made({"xi_raw": truth, metric: truth}, points=points or CURVES, **options)


def flat(fast, k, speed):
    return 0.5


class TestTimeOnTarget:
    def test_c1_holds_where_it_rises_with_the_share(self):
        assert claims.c1(rows("time_on_target", lambda fast, k, speed: 0.5 + 0.004 * fast, GRID)).verdict == "holds"

    def test_c1_fails_where_it_falls(self):
        claim = claims.c1(rows("time_on_target", lambda fast, k, speed: 0.5 - 0.004 * fast, GRID))
        assert claim.verdict == "does not hold"
        assert claim.high < 0

    def test_c1_holds_partly_where_it_rises_and_falls_again(self):
        claim = claims.c1(rows("time_on_target", lambda fast, k, speed: 0.5 - 0.001 * (fast - 25) ** 2, GRID))
        assert claim.verdict == "holds partly"

    def test_c2_holds_where_the_gain_shrinks_with_k_and_fails_where_it_grows(self):
        shrinks = rows("time_on_target", lambda fast, k, speed: 0.5 + 0.005 * fast * (50 - k) / 50)
        grows = rows("time_on_target", lambda fast, k, speed: 0.5 + 0.005 * fast * k / 50)
        assert claims.c2(shrinks).verdict == "holds"
        assert claims.c2(grows).verdict == "does not hold"

    def test_c2_measures_the_loss_in_percentage_points(self):
        step = rows("time_on_target", lambda fast, k, speed: 0.5 + (0.1 if fast and k < 30 else 0.0), noise=0.0)
        assert claims.c2(step).value == pytest.approx(10.0)

    @pytest.mark.parametrize(("change", "verdict"), [(0.0, "holds"), (0.1, "does not hold")])
    def test_c11_holds_where_another_start_changes_nothing(self, change, verdict):
        at, moved = [(15, 20, 3.0)], lambda fast, k, speed: 0.5 + change
        corner = rows("time_on_target", moved, at, **{"fleets.BoB-1.start": "corner"})
        center = rows("time_on_target", moved, at, **{"fleets.BoB-1.start": "center"})
        assert claims.c11(rows("time_on_target", flat), corner + center).verdict == verdict


class TestPeaks:
    def peaks(self, mixed, slow, metric="time_on_target"):
        return rows(metric, lambda fast, k, speed: hill(mixed if fast else slow)(k))

    def test_c3_holds_for_a_peak_at_18_and_its_interval_contains_it(self):
        claim = claims.c3(self.peaks(18, 23))
        assert claim.verdict == "holds"
        assert claim.low <= 18 <= claim.high

    def test_c3_fails_for_a_peak_at_25(self):
        assert claims.c3(self.peaks(25, 25)).verdict == "does not hold"

    def test_c3_is_undecided_for_a_flat_curve(self):
        assert claims.c3(rows("time_on_target", flat)).verdict == "undecided"

    @pytest.mark.parametrize(("mixed", "slow", "verdict"), [(18, 23, "holds"), (23, 18, "does not hold")])
    def test_c4_compares_the_swarms(self, mixed, slow, verdict):
        assert claims.c4(self.peaks(mixed, slow)).verdict == verdict

    def test_c4_is_undecided_for_flat_curves(self):
        assert claims.c4(rows("time_on_target", flat)).verdict == "undecided"

    @pytest.mark.parametrize(
        ("mixed", "slow", "verdict"), [(25, 30, "holds"), (25, 25, "holds partly"), (18, 18, "does not hold")]
    )
    def test_c5_compares_with_the_papers_peaks(self, mixed, slow, verdict):
        assert claims.c5(self.peaks(mixed, slow, "xi")).verdict == verdict

    @pytest.mark.parametrize(("xi", "verdict"), [(25, "holds"), (14, "does not hold")])
    def test_c6_compares_the_metrics(self, xi, verdict):
        both = {"time_on_target": lambda fast, k, speed: hill(20)(k), "xi": lambda fast, k, speed: hill(xi)(k)}
        assert claims.c6(made(both)).verdict == verdict

    def test_one_target_speed_is_enough(self):
        one = [row for row in self.peaks(18, 23) if row["target_speed"] == 3.0]
        assert claims.c3(one).verdict == claims.c4(one).verdict == "holds"


class TestFluctuationAndHeading:
    def test_c7_judges_the_normalized_xi_and_tells_the_other(self):
        truth = {"xi": lambda fast, k, speed: 0.8 - 0.002 * fast, "xi_raw": lambda fast, k, speed: 0.8 + 0.02 * fast}
        claim = claims.c7(made(truth, points=GRID))
        assert claim.verdict == "does not hold"
        assert "not normalized [m/s], 6 true, 0 open, 0 false" in claim.measured

    def test_c8_holds_where_more_agents_head_for_the_target(self):
        assert claims.c8(made({})).verdict == "holds"  # 0.3 k of them, by construction
        assert claims.c8(made({})).value == pytest.approx(0.3 * 9)

    def test_c9_holds_where_the_faster_target_stops_more(self):
        more = rows("stationary", lambda fast, k, speed: 0.1 * speed)
        fewer = rows("stationary", lambda fast, k, speed: 1 - 0.1 * speed)
        assert claims.c9(more).verdict == "holds"
        assert claims.c9(more).value == pytest.approx(50 * 0.2, abs=0.2)
        assert claims.c9(fewer).verdict == "does not hold"

    def test_c9_is_undecided_with_one_speed(self):
        assert claims.c9(rows("stationary", flat, [(0, 20, 3.0), (15, 20, 3.0)])).verdict == "undecided"

    def test_c10_holds_where_the_mixed_swarm_stops_more(self):
        assert claims.c10(rows("stationary", lambda fast, k, speed: 0.01 + 0.01 * fast)).verdict == "holds"
        assert claims.c10(rows("stationary", lambda fast, k, speed: 0.01 - 0.01 * fast)).verdict == "does not hold"


class TestClusters:
    def ended(self, steps=40):
        return Episode(0, 0, steps, dispersed=True)

    def test_c12_holds_where_all_disperse(self):
        claim = claims.c12([self.ended(20), self.ended(40), self.ended(60)])
        assert claim.verdict == "holds"
        assert claim.value == 40

    def test_c12_is_undecided_without_clusters(self):
        assert claims.c12([]).verdict == "undecided"

    def test_c12_fails_where_they_stay(self):
        assert claims.c12([self.ended(), *[Episode(0, 0, 5000, dispersed=False)] * 4]).verdict == "does not hold"

    def test_c12_lets_a_cluster_off_that_the_end_of_the_run_cut_short(self):
        claim = claims.c12([*[self.ended()] * 3, Episode(0, 0, 40, dispersed=False)])
        assert (claim.verdict, claim.cases) == ("holds", "3 true, 1 open, 0 false")


class TestSpread:
    def spread(self, noise, steps=100_000):
        both = {"time_on_target": lambda *_: 0.5, "xi": lambda *_: 0.5}
        return claims.c13(made(both, noise=noise), steps)

    def test_c13_holds_where_runs_agree_and_fails_where_they_do_not(self):
        assert self.spread(0.0002).verdict == "holds"
        assert self.spread(0.01).verdict == "does not hold"

    def test_c13_tells_the_standard_deviation_over_the_mean(self):
        assert self.spread(0.0005).value == pytest.approx(0.1, rel=0.1)

    def test_c13_is_told_by_standard_deviation_and_by_standard_error(self):
        claim = self.spread(0.0025)  # 0.5 %, and 0.22 % by the error of five
        assert (claim.verdict, claim.cases) == ("holds partly", "2 true, 0 open, 2 false")
        assert "time on target, deviation" in claim.measured
        assert "time on target, error" in claim.measured

    def test_c13_is_compared_as_finely_as_the_paper_tells_it(self):
        assert self.spread(0.00155).verdict == "holds"  # 0.31 % is told as 0.3 %

    def test_c13_tells_the_spread_of_headings_without_judging_it(self):
        assert "agents with phi > 0.7" in self.spread(0.0002).measured

    def test_c13_says_nothing_of_shorter_runs(self):
        assert self.spread(0.0002, steps=20_000).verdict == "undecided"


def test_all_thirteen_are_judged_in_order():
    metrics = ("time_on_target", "xi", "xi_raw", "stationary")
    main = made(dict.fromkeys(metrics, flat), points=[*CURVES, *(set(GRID) - set(CURVES))])
    found = claims.oceans_claims(main, [], [], 100_000)
    assert [claim.id for claim in found] == [f"C{number}" for number in range(1, 14)] == list(claims.STATEMENTS)


def test_of_runs_that_all_failed_nothing_is_decided():
    failed = [{**row, "status": "failed"} for row in rows("time_on_target", flat)]
    assert {claim.verdict for claim in claims.oceans_claims(failed, [], [], 100_000)} == {"undecided"}
