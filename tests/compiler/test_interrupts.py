"""Signals wait while numba compiles, and are heard right after."""

import os
import signal

import pytest

from shoal.compiler import interrupts
from shoal.compiler.late import load


@pytest.fixture
def deferring():
    """A deferral of its own."""
    return interrupts.Deferral()


def test_ctrl_c_waits_until_all_is_compiled(deferring):
    deferring.begin()
    deferring.begin()  # a function that a function needs
    os.kill(os.getpid(), signal.SIGINT)
    deferring.end()
    with pytest.raises(KeyboardInterrupt):
        deferring.end()
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_nothing_waits_without_a_signal(deferring):
    before = signal.getsignal(signal.SIGTERM)
    deferring.begin()
    deferring.end()
    assert signal.getsignal(signal.SIGTERM) is before
    with pytest.raises(KeyboardInterrupt):
        os.kill(os.getpid(), signal.SIGINT)


def test_it_is_registered():
    """A kernel that is compiled while Ctrl-C is pressed is compiled to its end."""
    import numba

    load()  # whoever does lets signals wait
    heard = []

    @numba.extending.overload(len)
    def _length(of):
        if of is numba.types.boolean:
            os.kill(os.getpid(), signal.SIGINT)  # while types are worked out
            heard.append(True)
            return lambda of: 1
        return None

    @numba.njit
    def compiled(flag):
        return len(flag)

    with pytest.raises(KeyboardInterrupt):
        compiled(True)
    assert heard
    assert compiled(True) == 1
