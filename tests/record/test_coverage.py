"""Intervals of the paper's run hold what they promise. Full length: benchmarks/bench_coverage.py."""

import pytest
from bench_coverage import coverage, runs_of


@pytest.fixture(scope="module")
def runs():
    return runs_of("oceans2020", 2000, 240)


@pytest.mark.slow
class TestCoverage:
    """Of 240 runs of 2,000 steps; by chance alone 95 % are 92 to 98."""

    @pytest.mark.parametrize(
        "metric", ["time_on_target", "xi", "engaged", "stationary", "losses", "reacquisition", "speed", "power"]
    )
    def test_of_one_run_and_of_several(self, runs, metric):
        found = coverage(metric, runs)
        assert found.told > 0.95
        assert 0.91 <= found.own <= 0.99
        assert found.width < 1.5  # times what 95 % need
        assert all(0.92 <= share <= 0.98 for share in found.replicates)

    def test_of_what_is_skewed_or_near_a_bound(self, runs):
        assert all(0.91 <= share <= 0.99 for share in coverage("first_detection", runs).replicates)
        assert all(0.91 <= share <= 0.99 for share in coverage("coverage", runs).replicates)

    def test_two_windows_of_coverage_tell_no_interval(self, runs):
        assert coverage("coverage", runs).told == 0.0
