"""How long a search takes, over runs of which some found nothing."""

import numpy as np
import pytest

from shoal.record.search import found_by, time_to_find

INF = np.inf


class TestFoundBy:
    """The share of runs, with Wilson's interval."""

    def test_counts_runs(self):
        found = found_by([0.0, 5.0, 10.0, INF], [0, 4.9, 5, 10, 20], end=20.0)
        assert found.share.tolist() == [0.25, 0.25, 0.5, 0.75, 0.75]
        assert found.runs == 4

    def test_interval_is_wilsons(self):
        """10 of 20, and none of 10: Brown, Cai, DasGupta, Statistical Science 16, 2001, Eq. 4."""
        half = found_by([1.0] * 10 + [INF] * 10, [2.0], end=9.0)
        assert (half.low[0], half.high[0]) == (pytest.approx(0.2993, abs=1e-4), pytest.approx(0.7007, abs=1e-4))
        none = found_by([INF] * 10, [2.0], end=9.0)
        assert (none.low[0], none.high[0]) == (0.0, pytest.approx(0.2775, abs=1e-4))

    def test_after_the_end_nobody_knows(self):
        found = found_by([1.0, 2.0], [10.0, 10.1], end=10.0)
        assert np.isnan(found.share).tolist() == [False, True]
        assert np.isnan(found.high).tolist() == [False, True]

    def test_holds_the_truth_in_95_of_100_cases(self):
        rng = np.random.default_rng(1)
        times = np.where(rng.random((4000, 30)) < 0.2, 1.0, INF)
        held = [found.low[0] <= 0.2 <= found.high[0] for found in (found_by(each, [2.0], 9.0) for each in times)]
        assert 0.93 < np.mean(held) < 0.98


class TestTimeToFind:
    """The median counts runs that found nothing as longer than all others."""

    @pytest.mark.parametrize(
        ("times", "median"),
        [([3.0], 3.0), ([1.0, 2.0], 1.5), ([1.0, 2.0, INF], 2.0), ([1.0, INF], INF), ([INF, INF], INF)],
    )
    def test_median(self, times, median):
        assert time_to_find(times).median == median

    def test_tells_how_many_found_nothing(self):
        found = time_to_find([1.0, INF, 2.0, INF])
        assert (found.not_found, found.runs) == (2, 4)

    def test_five_runs_are_too_few_for_an_interval(self):
        assert time_to_find(range(5)).ci95 is None
        assert time_to_find(range(6)).ci95 == (0.0, 5.0)  # 2 / 2^6 = 3.1 %

    def test_interval_of_20_is_from_the_6th_to_the_15th(self):
        """Standard tables of order statistics."""
        assert time_to_find(range(1, 21)).ci95 == (6.0, 15.0)

    def test_many_runs_are_no_trouble(self):
        low, high = time_to_find(np.arange(10_001)).ci95
        assert low + high == 10_000
        assert high - low == pytest.approx(2 * 1.96 * 50, rel=0.02)
