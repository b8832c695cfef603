"""Ctrl-C is heard although the system gave it to another thread."""

import signal
import subprocess
import sys
from concurrent.futures import Future

import pytest

from shoal.core.waiting import first_done

SCRIPT = """
import os, signal, threading, time
from concurrent.futures import ThreadPoolExecutor
from shoal.core.waiting import first_done, wait_for

def other():
    time.sleep(0.3)  # the main thread waits by now
    signal.pthread_kill(threading.get_ident(), signal.SIGINT)
    time.sleep(30)
    os._exit(1)

threading.Thread(target=other, daemon=True).start()
try:
    {wait}
except KeyboardInterrupt:
    os._exit(0)
os._exit(2)
"""


@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="no signals to threads here")
@pytest.mark.parametrize(
    "wait", ["wait_for(threading.Event())", "first_done([ThreadPoolExecutor(1).submit(time.sleep, 60)])"]
)
def test_a_signal_that_another_thread_took(wait):
    assert subprocess.run([sys.executable, "-c", SCRIPT.format(wait=wait)], timeout=60, check=False).returncode == 0


def test_what_is_done():
    done, waiting = Future(), Future()
    done.set_result(1)
    assert first_done([done, waiting]) == {done}
