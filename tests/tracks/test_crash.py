"""Specification of trying what may bring the process down."""

import multiprocessing
import os
import signal
import time

import pytest

from shoal.tracks import crash
from shoal.tracks.crash import is_safe

pytestmark = pytest.mark.skipif(
    "fork" not in multiprocessing.get_all_start_methods(), reason="this system cannot fork a process"
)


class TestIsSafe:
    def test_what_returns_or_raises_is_safe(self):
        assert is_safe(lambda: 1)
        assert is_safe(lambda: 1 / 0)

    def test_what_crashes_is_not_and_leaves_this_process_alone(self):
        assert not is_safe(lambda: os.kill(os.getpid(), signal.SIGSEGV))

    def test_what_hangs_is_not(self, monkeypatch):
        monkeypatch.setattr(crash, "LONGEST", 0.1)
        assert not is_safe(lambda: time.sleep(60))
