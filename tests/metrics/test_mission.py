"""Airtime, cost, found: what a mission costs and whether it succeeds."""

import math
from dataclasses import replace

import numpy as np
import pytest

from coasting import coasting
from scenarios import scenario
from shoal.core.errors import RecordError
from shoal.metrics.contract import Facts
from shoal.metrics.cost import cost
from shoal.metrics.found import times_to_find
from shoal.metrics.summary import METRICS, evaluate
from shoal.metrics.tally import new_tally
from shoal.run.facts import facts_of
from shoal.run.simulate import simulate

FACTS = Facts(("boats", "buoys"), (3, 10), (2.0, 1.0), unit=1.0, time_step=0.5)


class TestCost:
    def test_is_that_of_all_agents(self):
        assert cost(FACTS._replace(costs=(100.0, 8.5))) == 385.0

    def test_where_a_fleet_says_nothing_nobody_knows(self):
        assert math.isnan(cost(FACTS))
        half_known = scenario("oceans2020", {"fleets.0.cost": 3.0})
        assert facts_of(half_known).costs == ()

    def test_of_nothing_is_known(self):
        free = scenario("oceans2020", {"fleets.0.cost": 0, "fleets.1.cost": 0.0})
        assert cost(facts_of(free)) == 0.0


class TestAirtime:
    def tally(self):
        tally = new_tally(steps=10, batches=1, fleets=2, agents=13, targets=1)
        tally.steps[:], tally.agent_steps[:] = 10, [[30, 50]]
        return tally

    def test_is_of_an_agent_and_the_channel_takes_those_of_all_present(self):
        facts = FACTS._replace(airtime=0.1, interval=4.0)
        assert evaluate("airtime", self.tally(), facts)[0] == pytest.approx(0.025)
        assert evaluate("channel_load", self.tally(), facts)[0] == pytest.approx(8 * 0.025)

    def test_without_an_interval_every_step_has_a_report(self):
        assert evaluate("airtime", self.tally(), FACTS._replace(airtime=0.1))[0] == pytest.approx(0.2)

    def test_without_a_radio_nobody_knows(self):
        assert math.isnan(evaluate("airtime", self.tally(), FACTS)[0])


class TestFound:
    """Three targets: found at once, never, and never there."""

    def test_by_hand(self):
        tally = new_tally(steps=20, batches=2, fleets=1, agents=2, targets=4)
        tally.target_steps[:] = [[10, 10, 0, 10], [10, 10, 0, 10]]
        tally.undetected[:] = [[0, 10, 0, 10], [0, 10, 0, 9]]
        assert times_to_find(tally, FACTS).tolist() == [0.0, np.inf, np.inf, 9.5]
        assert evaluate("found", tally, FACTS)[0] == 0.5

    def test_in_a_run(self):
        simulation = coasting([(-5.05, 0.0), (9.0, 9.0)], [(1.0, 0.0), (0.0, 0.0)], targets=[(-3.0, 0.0), (0.0, -8.0)])
        simulation.advance(20)
        facts = facts_of(simulation.scenario)
        assert times_to_find(simulation.tally, facts).tolist() == [pytest.approx(1.1), np.inf]


@pytest.fixture(scope="module")
def record():
    return simulate("oceans2020", runs=3, steps=60)


class TestRecord:
    def test_lists_only_what_was_asked_for(self, record):
        asked = {name for name, each in METRICS.items() if each.asked or each.several_targets}
        assert set(record.listed()) == METRICS.keys() - asked
        facts = record.facts._replace(costs=(2.0, 1.0))
        assert "cost" in replace(record, facts=facts).listed()

    def test_found_by_the_end_is_the_metric(self, record):
        found = record.found_by([0, 6])
        assert found.share[1] == record.estimate("found").mean
        assert (found.low <= found.share).all()
        assert record.time_to_find().not_found == 3 - round(3 * found.share[1])

    @pytest.mark.parametrize("target", [-1, 1, 0.5])
    def test_of_no_such_target_is_refused(self, record, target):
        with pytest.raises(RecordError, match="name one from 0 to 0"):
            record.found_by([1.0], target=target)
