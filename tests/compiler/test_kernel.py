"""Kernels run compiled or, for debuggers and coverage, as plain Python."""

import os
import subprocess
import sys
import threading

from numba.core import config

from shoal.compiler.kernel import cache_folder, kernel_cache

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


class TestThreads:
    """Numba's setting is the process's: of two threads that decorate at once, one waits."""

    def test_no_thread_takes_the_folder_away_from_another(self):
        entered, leave, seen = threading.Event(), threading.Event(), []

        def decorate():
            with kernel_cache():
                entered.set()
                leave.wait(10.0)

        first = threading.Thread(target=decorate)
        first.start()
        entered.wait(10.0)

        def decorate_too():
            with kernel_cache():
                seen.append(config.CACHE_DIR)

        second = threading.Thread(target=decorate_too)
        second.start()
        second.join(0.2)
        assert seen == []
        leave.set()
        first.join()
        second.join()
        assert seen == [str(cache_folder())]
        assert seen[0] != config.CACHE_DIR


class TestPlainPython:
    """NUMBA_DISABLE_JIT=1."""

    def test_gives_the_same_bits(self):
        assert printed(NUMBA_DISABLE_JIT="1") == printed()
