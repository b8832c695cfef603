"""What runs leave behind, as numbers and as JSON."""

import json
from dataclasses import replace

import numpy as np
import pytest

from scenarios import scenario
from shoal.metrics.summary import METRICS
from shoal.record.statistics import estimate
from shoal.run.simulate import simulate


@pytest.fixture(scope="module")
def record():
    return simulate(scenario("oceans2020", {"steps": 600}), runs=4)


@pytest.fixture(scope="module")
def one_run():
    return simulate(scenario("oceans2020", {"steps": 600}))


@pytest.fixture(scope="module")
def pair():
    """Two short runs: Student's t of one degree of freedom leaves every bound."""
    return simulate(scenario("oceans2020", {"steps": 300}), runs=2)


class TestEstimates:
    """Over runs where there are several, over batches of one."""

    @pytest.mark.parametrize("metric", METRICS)
    def test_of_several_runs(self, record, metric):
        result = record.estimate(metric)
        assert len(result.runs) == 4
        assert repr(result) == repr(
            estimate(result.runs, bounds=record.bounds(metric))
        )  # a number that does not exist does not equal itself

    def test_of_one_run_have_an_interval_too(self, one_run):
        low, high = one_run.estimate("xi").ci95
        assert low < one_run.estimate("xi").mean < high

    def test_of_one_run_have_none_for_what_happens_once(self, one_run):
        assert one_run.estimate("first_detection").ci95 is None

    @pytest.mark.parametrize("metric", METRICS)
    def test_stay_inside_what_is_possible(self, record, one_run, pair, metric):
        for each in (record, one_run, pair):
            low, high = each.estimate(metric).ci95 or (each.bounds(metric))
            assert each.bounds(metric).low <= low <= high <= each.bounds(metric).high

    def test_no_loss_is_longer_than_the_run_nor_more_frequent_than_every_other_step(self, pair):
        assert pair.bounds("first_detection") == pair.bounds("reacquisition") == (0.0, 30.0)
        assert pair.bounds("losses") == (0.0, 18_000.0)

    def test_a_run_is_too_short_for_what_it_has_few_windows_of(self, one_run):
        assert "coverage_rate" in one_run.too_short()
        assert "time_on_target" not in one_run.too_short()
        assert "messages" not in one_run.too_short()  # never changes

    def test_several_runs_are_never_too_short(self, record):
        assert record.too_short() == []

    def test_of_no_such_metric(self, record):
        with pytest.raises(KeyError):
            record.estimate("happiness")

    def test_of_fleets_weighted_by_counts_make_the_swarm(self, record):
        fast, slow = (record.fleet_estimate("xi")[name].mean for name in ("BoB-1", "BoB-0"))
        assert (15 * fast + 35 * slow) / 50 == pytest.approx(record.estimate("xi").mean)

    def test_of_the_swarm_are_the_means_over_steps(self, one_run):
        """Of the one run, from its frames: a metric is a mean over steps."""
        frames = simulate(scenario("oceans2020", {"steps": 600}), every=1).trajectories[0]
        v = np.stack([frames.vx, frames.vy])
        fluctuation = np.hypot(*(v - v.mean(axis=2, keepdims=True)))
        assert one_run.estimate("xi_raw").mean == pytest.approx(fluctuation.mean(), rel=1e-12)
        assert one_run.estimate("time_on_target").mean == frames.on_target.any(axis=1).mean()
        assert one_run.estimate("engaged").mean == pytest.approx(frames.on_target.sum(axis=1).mean())


class TestRobustness:
    """Before, during and after every change."""

    def test_a_change_is_named_by_its_step_once(self):
        changes = {"losses": [{"step": 100, "count": 9}, {"step": 700, "count": 9}], "steps": 600}
        joins = [{"step": 100, "count": 3, "fleet": "BoB-0"}, {"step": 50, "count": 3, "fleet": "BoB-0"}]
        record = simulate(scenario("oceans2020", {**changes, "joins": joins}))
        assert record.changes() == [50, 100]
        assert [each.keys() for each in record.robustness()] == [{"before", "during", "after", "recovery"}] * 2

    def test_losing_all_ends_time_on_target(self):
        lost = {"losses": [{"step": 300, "count": 50}], "steps": 600}
        (change,) = simulate(scenario("oceans2020", lost), runs=2).robustness()
        assert change["before"].mean > 0.2
        assert change["during"].runs == (0.0, 0.0)

    def test_a_swarm_that_was_never_there_has_no_means(self):
        record = simulate(scenario("oceans2020", {"losses": [{"step": 1, "count": 50}], "steps": 60}))
        summary = record.summary()  # and no warning, though whole batches have nobody
        assert summary["time_on_target"]["mean"] <= 1 / 60
        assert 0.0 <= summary["stationary"]["mean"] <= 1.0

    def test_the_stationary_share_counts_those_who_are_there(self):
        lost = {"losses": [{"step": 300, "count": 25}], "steps": 600, "strategy": "lattice"}
        frames = simulate(scenario("oceans2020", lost), every=1).trajectories[0]
        share = simulate(scenario("oceans2020", lost)).estimate("stationary").mean
        moved = np.hypot(np.diff(frames.x, axis=0), np.diff(frames.y, axis=0)) / 0.1
        slow = moved < 0.1 * np.repeat([2.6, 1.0], [15, 35])
        there = frames.alive[:-1]
        assert share == pytest.approx((slow & there).sum() / there.sum(), abs=0.01)


class TestHistogram:
    """phi, in agents per step."""

    def test_sums_to_all_agents(self, record):
        assert record.phi_histogram().shape == (2, 11)
        assert record.phi_histogram().sum(axis=1) == pytest.approx([15, 35])


class TestSummary:
    """Everything in plain numbers."""

    def test_is_json(self, record):
        summary = record.summary()
        assert json.loads(json.dumps(summary, allow_nan=False)) == summary

    def test_says_what_ran_and_on_what(self, record):
        summary = record.summary()
        assert summary["runs"] == 4
        assert (summary["steps"], summary["seed"]) == (600, 1)
        assert summary["scenario_hash"] == scenario("oceans2020", {"steps": 600}).hash
        assert {"shoal", "numba", "numpy", "python"} <= summary["versions"].keys()
        assert summary["units"].keys() == METRICS.keys()
        assert [summary["fleets"][name]["count"] for name in ("BoB-1", "BoB-0")] == [15, 35]

    def test_of_a_run_without_a_target_has_null_for_what_cannot_be_told(self):
        record = simulate(scenario("oceans2020", {"steps": 50}))
        never = ("present", "on_target", "engaged", "histogram", "stationary")
        tallies = (each._replace(**{name: 0 * getattr(each, name) for name in never}) for each in record.tallies)
        summary = replace(record, tallies=tuple(tallies)).summary()
        assert summary["time_on_target"] == {"mean": None, "ci95": None, "runs": [None]}
        assert summary["xi"]["mean"] > 0
        json.dumps(summary, allow_nan=False)
