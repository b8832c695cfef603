"""Specification of trying what may bring the process down."""

import faulthandler
import math
import multiprocessing
import subprocess
import sys
import threading
import time

import pytest

from shoal.core import crash
from shoal.core.crash import Crashed, elsewhere, is_safe


@pytest.fixture(params=["fork", "other threads", "no fork"])
def situation(request, monkeypatch):
    """In each of which a call is tried."""
    done = threading.Event()
    if request.param == "other threads":  # as zarr's, or a notebook's
        threading.Thread(target=done.wait, daemon=True).start()
    elif request.param == "no fork":
        monkeypatch.setattr(multiprocessing, "get_all_start_methods", lambda: ["spawn"])
    elif threading.active_count() > 1 or "fork" not in multiprocessing.get_all_start_methods():
        pytest.skip("this process cannot fork: another thread runs in it")
    yield
    done.set()


@pytest.mark.usefixtures("situation")
class TestIsSafe:
    def test_what_returns_or_raises_is_safe(self):
        assert is_safe(math.sqrt, 1.0)
        assert is_safe(math.sqrt, -1.0)

    def test_what_crashes_is_not_and_leaves_this_process_alone(self):
        assert not is_safe(faulthandler._sigsegv)

    def test_what_hangs_is_not(self, monkeypatch):
        monkeypatch.setattr(crash, "LONGEST", 0.5)
        assert not is_safe(time.sleep, 60)


@pytest.mark.usefixtures("situation")
class TestElsewhere:
    def test_what_is_returned_comes_back(self):
        assert elsewhere(math.sqrt, 4.0) == 2.0
        assert len(elsewhere(bytes, 10_000_000)) == 10_000_000

    def test_what_is_raised_is_raised(self):
        with pytest.raises(ValueError, match=r"domain|nonnegative"):
            elsewhere(math.sqrt, -1.0)

    def test_a_crash_and_a_hang_are_told(self):
        with pytest.raises(Crashed):
            elsewhere(faulthandler._sigsegv)
        with pytest.raises(Crashed):
            elsewhere(time.sleep, 60, longest=0.5)


def test_where_no_process_can_be_had_nothing_is_tried(monkeypatch):
    def no_more(*_, **__):
        raise OSError(11, "Resource temporarily unavailable")

    monkeypatch.setattr(crash.subprocess, "run", no_more)
    monkeypatch.setattr(multiprocessing, "get_all_start_methods", lambda: ["spawn"])
    assert is_safe(math.sqrt, 1.0)


def test_all_of_it_where_the_process_can_fork():
    """Threads that other tests left behind in this one make it skip those that fork."""
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:xdist",
        "-p",
        "no:cacheprovider",
        __file__,
        "-k",
        "[fork]",
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
    assert "6 passed" in done.stdout
