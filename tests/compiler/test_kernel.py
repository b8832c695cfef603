"""Kernels run compiled or, for debuggers and coverage, as plain Python."""

import os
import subprocess
import sys

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


class TestPlainPython:
    """NUMBA_DISABLE_JIT=1."""

    def test_gives_the_same_bits(self):
        assert printed(NUMBA_DISABLE_JIT="1") == printed()
