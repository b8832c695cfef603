"""How hypothesis searches, and who compiles."""

import os
import signal
from contextlib import suppress

from hypothesis import HealthCheck, settings

# derandomize: the same examples on every machine, so that a red build is red for its change. Search anew with
# `pytest --hypothesis-profile=search`. No deadline: the first example compiles.
settings.register_profile(
    "repeatable",
    deadline=None,
    derandomize=True,
    database=None,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.register_profile("search", settings.get_profile("repeatable"), derandomize=False)
settings.load_profile("repeatable")

# As the command line does: before numpy is imported, here and in every child. Threads of several workers that all wait
# for each other made the smallest matrix forty times slower on a busy machine.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def pytest_configure(config):
    """Let children hear Ctrl-C, and fill the engine's cache before xdist starts its workers.

    A shell that starts the tests in the background has them, and all their children, ignore SIGINT. Workers that find
    no cache would each compile the same, half as fast.
    """
    with suppress(ValueError):  # not the main thread
        if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
            signal.signal(signal.SIGINT, signal.default_int_handler)
    if config.getoption("numprocesses", None) and not hasattr(config, "workerinput"):
        with suppress(Exception):  # what is wrong with the engine, the tests will tell
            from shoal.run.simulation import Simulation
            from shoal.scenario.load import load

            Simulation(load("oceans2020")).advance(0)
