"""From sums to numbers."""

import numpy as np
import pytest

from shoal.metrics.contract import Facts
from shoal.metrics.heading_bearing import fleet_stationary, phi_histogram
from shoal.metrics.shares import mean_max_speed
from shoal.metrics.summary import METRICS, batch_values, bounds_of, evaluate
from shoal.metrics.tally import batch_of, new_tally
from shoal.metrics.velocity_fluctuation import fleet_fluctuation

FACTS = Facts(fleets=("fast", "slow"), counts=(10, 30), max_speeds=(2.0, 1.0), unit=2.0, time_step=0.5)


@pytest.fixture
def tally():
    """Two batches of 100 steps; the target is there in 160 of 200."""
    tally = new_tally(steps=200, batches=2, fleets=2, agents=40, targets=1)
    tally.steps[:] = 100
    tally.agent_steps[:] = 1000, 3000
    tally.present[:] = 100, 60
    tally.on_target[:] = 80, 10
    tally.engaged[:] = 160, 40
    tally.fluctuation[:] = [[500, 1000], [300, 200]]
    tally.histogram[:, 0, 10] = 1000, 600
    tally.histogram[:, 1, 5] = 3000, 1800
    tally.stationary[:] = [[0, 1500], [0, 900]]
    return tally


class TestBatchValues:
    """Values in batches, so weighted that their spread is that of the whole run's value."""

    def values(self, tally, name):
        return batch_values(lambda sums: METRICS[name].formula(sums, FACTS), tally)

    def test_of_batches_of_one_length_are_their_own_values(self, tally):
        assert self.values(tally, "xi_raw") == pytest.approx(evaluate("xi_raw", tally, FACTS)[1])

    def test_of_a_ratio_are_those_of_the_jackknife(self, tally):
        """Twice the whole less the other batch's."""
        assert self.values(tally, "time_on_target") == pytest.approx([2 * 90 / 160 - 1 / 6, 2 * 90 / 160 - 0.8])

    def test_a_batch_that_says_nothing_of_it_has_none(self, tally):
        tally.graphs[1], tally.components[1] = 4, 8
        assert self.values(tally, "components").tolist() == [2.0]
        assert self.values(tally, "clustering").tolist() == [0.0]
        assert self.values(tally, "coverage").size == 0


class TestBounds:
    """What no run can leave."""

    def test_every_metric_has_some_and_they_are_in_order(self):
        assert all(bounds_of(name).low >= 0.0 and bounds_of(name).low < bounds_of(name).high for name in METRICS)

    @pytest.mark.parametrize("name", ["time_on_target", "stationary", "target_present", "fairness", "clustering"])
    def test_a_share_is_at_most_one(self, name):
        assert bounds_of(name) == (0.0, 1.0)

    def test_of_the_swarm_are_its_size_and_where_it_may_go(self):
        assert bounds_of("engaged", agents=40) == (0.0, 40)
        assert bounds_of("coverage", reach=0.75) == (0.0, 0.75)
        assert bounds_of("coverage") == (0.0, 1.0)

    def test_of_times_are_the_length_of_the_run(self):
        assert bounds_of("first_detection", duration=200.0) == bounds_of("reacquisition", duration=200.0) == (0.0, 200)


class TestFormulas:
    """Over all steps, and over each batch of them."""

    @pytest.mark.parametrize(
        ("name", "mean", "batches"),
        [
            ("time_on_target", 90 / 160, (0.8, 1 / 6)),
            ("engaged", 200 / 160, (1.6, 2 / 3)),
            ("xi_raw", 2000 / 200 / 40, (15 / 40, 5 / 40)),
            ("xi", 2000 / 200 / 40 / 1.25, (15 / 50, 5 / 50)),
            ("response", 10 * 0.5 / 2, (15 / 4, 5 / 4)),
            ("stationary", 2400 / 160 / 40, (15 / 40, 15 / 40)),
        ],
    )
    def test_by_hand(self, tally, name, mean, batches):
        whole, parts = evaluate(name, tally, FACTS)
        assert whole == pytest.approx(mean)
        assert parts == pytest.approx(batches)

    def test_what_the_scenario_decides_has_no_batches(self, tally):
        whole, parts = evaluate("target_present", tally, FACTS)
        assert whole == pytest.approx(0.8)
        assert parts.size == 0

    def test_every_metric_has_a_unit_and_a_sentence(self):
        assert all(metric.unit and metric.sentence for metric in METRICS.values())

    def test_a_batch_is_a_tally_of_its_own(self, tally):
        second = batch_of(tally, 1)
        assert second.on_target.tolist() == [10]
        assert second.histogram.shape == (1, 2, 11)


class TestByFleet:
    """What the fleets share and what is their own."""

    def test_the_histogram_is_in_agents_per_step_and_sums_to_all(self, tally):
        histogram = phi_histogram(tally)
        assert histogram.shape == (2, 11)
        assert (histogram[0, 10], histogram[1, 5]) == (10.0, 30.0)
        assert histogram.sum() == pytest.approx(FACTS.agents)

    def test_stationary_shares(self, tally):
        assert fleet_stationary(tally, FACTS).tolist() == [0.0, 0.5]

    def test_fluctuations(self, tally):
        assert fleet_fluctuation(tally, FACTS) == pytest.approx([800 / 200 / 10, 1200 / 200 / 30])

    def test_fleets_weighted_by_their_counts_make_the_swarm(self, tally):
        assert fleet_fluctuation(tally, FACTS) @ FACTS.counts / 40 == pytest.approx(evaluate("xi_raw", tally, FACTS)[0])
        assert fleet_stationary(tally, FACTS) @ FACTS.counts / 40 == pytest.approx(
            evaluate("stationary", tally, FACTS)[0]
        )

    def test_without_a_target_there_is_no_histogram(self, tally):
        tally.present[:] = 0
        assert np.isnan(phi_histogram(tally)).all()

    def test_without_a_target_there_is_no_stationary_share(self, tally):
        tally.present[:] = tally.histogram[:] = tally.stationary[:] = 0
        assert np.isnan(fleet_stationary(tally, FACTS)).all()
        assert not np.isnan(fleet_fluctuation(tally, FACTS)).any()


class TestFacts:
    """Scales."""

    def test_the_mean_top_speed_is_of_agents_not_of_fleets(self, tally):
        assert mean_max_speed(tally, FACTS) == pytest.approx((10 * 2.0 + 30 * 1.0) / 40)
        assert FACTS.agents == 40
