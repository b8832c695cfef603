"""Kernels run compiled or, for debuggers and coverage, as plain Python."""

import os
import subprocess
import sys

import pytest

from shoal.compiler.kernel import entry_kernel, twin
from shoal.compiler.late import compiles

PLAIN = """
import warnings
warnings.simplefilter("error")
import shoal
from shoal.scenario.load import read_table, scenario_from
table = read_table("oceans2020")
table["fleets"][0]["count"], table["fleets"][1]["count"], table["network"]["neighbors"] = 3, 4, 2
simulation = shoal.Simulation(scenario_from(table))
simulation.advance(40)
print(simulation.swarm.x[:7].tolist(), simulation.tally.histogram.sum(axis=0).tolist())
"""


def printed(**environment):
    done = subprocess.run(
        [sys.executable, "-c", PLAIN], capture_output=True, text=True, check=False, env=os.environ | environment
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.skipif(not compiles(), reason="without a compiler there is no machine code")
class TestTwins:
    """Entry kernels for a user's strategies: kept under what these are made of, if that is known."""

    def test_one_that_is_made_of_something_known_is_kept(self, tmp_path, monkeypatch):
        monkeypatch.setattr("shoal.compiler.kernel.cache_folder", lambda: tmp_path)

        def half(x):
            return 0.5 * x

        def hits(made_of):
            kept = twin(entry_kernel(half), made_of)
            assert kept(3.0) == 1.5
            return sum(kept.stats.cache_hits.values())

        assert [hits("a"), hits("a"), hits("b"), hits(None), hits(None)] == [0, 1, 0, 0, 0]
        assert len(list(tmp_path.iterdir())) == 2


class TestPlainPython:
    """NUMBA_DISABLE_JIT=1."""

    def test_gives_the_same_bits(self):
        assert printed(NUMBA_DISABLE_JIT="1") == printed()
