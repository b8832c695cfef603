"""What a change of the swarm does to time on target."""

import numpy as np
import pytest

from shoal.metrics.robustness import DURING, robustness
from shoal.metrics.tally import new_tally
from shoal.metrics.time_on_target import WINDOWS


def tally_of(on_target, present=1.0):
    """A run whose every part of the timeline is on target in such a share of its steps; 100 steps a part."""
    parts = np.asarray(on_target, float)
    tally = new_tally(steps=100 * parts.size, batches=parts.size // WINDOWS, fleets=1, agents=2, targets=1)
    tally.timeline_present[:] = 100.0 * present
    tally.timeline_on_target[:] = 100.0 * present * parts.reshape(-1, WINDOWS)
    return tally


def steps(shares):
    """(share, parts) pairs as one timeline."""
    return np.concatenate([np.full(parts, share) for share, parts in shares])


class TestRobustness:
    """Before, during the 1,000 steps after, and from then on."""

    def test_shares_are_those_of_their_steps(self):
        (change,) = robustness(tally_of(steps([(0.8, 40), (0.2, 10), (0.5, 50)])), [4000], 0.1)
        assert change[:3] == pytest.approx((0.8, 0.2, 0.5))

    def test_a_change_that_costs_nothing_is_recovered_from_at_once(self):
        (change,) = robustness(tally_of(np.full(100, 0.7)), [3000], 0.1)
        assert change.recovery == 0.0

    def test_recovery_begins_with_the_first_thousand_steps_as_good_as_before(self):
        (change,) = robustness(tally_of(steps([(0.8, 40), (0.0, 17), (0.8, 43)])), [4000], 0.1)
        assert change.recovery == pytest.approx(0.1 * 1700)

    def test_ninety_five_percent_is_as_good(self):
        good, bad = (robustness(tally_of(steps([(0.8, 40), (0.8 * s, 60)])), [4000], 0.1)[0] for s in (0.951, 0.949))
        assert good.recovery == 0.0
        assert np.isnan(bad.recovery)

    def test_what_follows_the_next_change_belongs_to_that(self):
        first, second = robustness(tally_of(steps([(0.8, 30), (0.4, 30), (0.6, 40)])), [3000, 6000], 0.1)
        assert (first.before, first.during, first.after) == pytest.approx((0.8, 0.4, 0.4))
        assert (second.before, second.during, second.after) == pytest.approx((0.4, 0.6, 0.6))
        assert np.isnan(first.recovery)
        assert second.recovery == 0.0

    def test_the_part_in_which_a_change_falls_belongs_to_neither_side(self):
        (change,) = robustness(tally_of(steps([(1.0, 40), (0.5, 1), (0.0, 59)])), [4050], 0.1)
        assert change[:3] == (1.0, 0.0, 0.0)

    def test_steps_without_a_target_do_not_count(self):
        present = np.ones((2, WINDOWS))
        present[0, :20] = 0.0
        (change,) = robustness(tally_of(np.full(100, 0.6), present), [3000], 0.1)
        assert change.before == pytest.approx(0.6)

    def test_with_no_target_before_nothing_can_be_told(self):
        present = np.ones((2, WINDOWS))
        present[0, :30] = 0.0
        (change,) = robustness(tally_of(np.full(100, 0.6), present), [3000], 0.1)
        assert np.isnan(change.before)
        assert np.isnan(change.recovery)

    @pytest.mark.parametrize("length", [20, 30, 999, 1001])
    def test_short_runs_have_parts_of_a_step(self, length):
        tally = new_tally(steps=length, batches=20, fleets=1, agents=2, targets=1)
        for step in range(length):
            batch = step * 20 // length
            part = int(tally.steps[batch] * WINDOWS / tally.batch_steps[batch])
            tally.timeline_present[batch, part] += 1.0
            tally.timeline_on_target[batch, part] += 1.0 if step < 10 else 0.0
            tally.steps[batch] += 1.0
        (change,) = robustness(tally, [10], 0.1)
        assert (change.before, change.during) == (1.0, 0.0)

    def test_a_run_too_short_to_recover_in_does_not(self):
        (change,) = robustness(tally_of(np.full(WINDOWS, 0.5)), [100 * WINDOWS - DURING + 100], 0.1)
        assert np.isnan(change.recovery)
