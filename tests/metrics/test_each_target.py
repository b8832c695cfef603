"""Every target by itself."""

import numpy as np
import pytest

from scenarios import scenario
from shoal.metrics.contract import Facts
from shoal.metrics.each_target import each_target, loss_lengths
from shoal.metrics.summary import METRICS
from shoal.metrics.tally import new_tally
from shoal.run.simulate import simulate

FACTS = Facts(fleets=("one",), counts=(4,), max_speeds=(1.0,), unit=1.0, time_step=0.5)


@pytest.fixture
def tally():
    """Two batches; the first target is always there, the second half of the time, the third never."""
    tally = new_tally(steps=200, batches=2, fleets=1, agents=4, targets=3)
    tally.target_steps[:] = [[100, 50, 0], [100, 50, 0]]
    tally.watched[:] = [[80, 10, 0], [60, 20, 0]]
    tally.undetected[:] = [[6, 50, 0], [0, 4, 0]]
    tally.losses[:] = [[2, 0, 0], [3, 1, 0]]
    tally.ended[:] = [[2, 0, 0], [2, 0, 0]]
    tally.ended_steps[:] = [[20, 0, 0], [4, 0, 0]]
    return tally


class TestEachTarget:
    """Over the steps at which it is there."""

    def test_numbers_by_hand(self, tally):
        found = each_target(tally, FACTS)
        assert found["time_on_target"] == pytest.approx([0.7, 0.3, np.nan], nan_ok=True)
        assert found["first_detection"] == pytest.approx([3.0, 27.0, 0.0])
        assert found["losses"] == pytest.approx([5 / 100 * 3600, 1 / 50 * 3600, np.nan], nan_ok=True)
        assert found["reacquisition"] == pytest.approx([24 / 4 * 0.5, np.nan, np.nan], nan_ok=True)

    def test_of_one_target_is_the_swarms(self):
        record = simulate(scenario("oceans2020", {"steps": 900}), runs=2)
        (target,) = record.target_estimates()
        for name, value in target.items():
            assert value.runs == pytest.approx(record.estimate(name).runs), name
            assert name in METRICS

    def test_of_twins_are_the_same(self):
        still = {"kind": "still", "radius": 1.0, "x": 1.0, "y": 2.0}
        record = simulate(scenario("oceans2020", {"steps": 300, "targets": [still, still]}))
        one, other = record.target_estimates()
        assert repr(one) == repr(other)
        assert one["time_on_target"].mean == pytest.approx(record.estimate("time_on_target").mean)


class TestLossLengths:
    """In bins that double."""

    def test_by_hand(self, tally):
        tally.loss_lengths[0, :3] = 5, 0, 2
        tally.loss_lengths[1, :2] = 1, 4
        edges, counts = loss_lengths(tally, FACTS)
        assert edges.tolist() == [0.5, 1.0, 2.0, 4.0]
        assert counts.tolist() == [6, 4, 2]

    def test_of_no_loss_are_none(self, tally):
        edges, counts = loss_lengths(tally, FACTS)
        assert (edges.tolist(), counts.tolist()) == ([0.5], [])

    def test_of_several_runs_are_added(self):
        record = simulate(scenario("oceans2020", {"steps": 2000}), runs=3)
        _, counts = record.loss_lengths()
        assert counts.sum() == sum(tally.ended.sum() for tally in record.tallies) > 0
