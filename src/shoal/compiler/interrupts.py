"""Ctrl-C and the like wait until numba is imported, or a function compiled: an exception amid that may be lost, turned
into another, or end Python.

They wait some seconds at most, for the one function, and are heard then.
"""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from shoal.compiler.garbage import look_as_before, look_rarely

_HEARD = ("SIGINT", "SIGTERM", "SIGHUP")


class Deferral:
    """Holds signals back between `begin` and `end`, which may be nested."""

    def __init__(self) -> None:
        self.depth = 0
        self.waiting: int | None = None
        self.handlers: dict[int, Callable[..., Any]] = {}

    def begin(self) -> None:
        """Take note of signals from now on."""
        if threading.current_thread() is not threading.main_thread():
            return  # only the main thread hears signals, and is not compiling
        self.depth += 1
        if self.depth > 1:
            return
        for name in _HEARD:
            number = getattr(signal, name, None)  # Windows has no SIGHUP
            handler = signal.getsignal(number) if number is not None else None
            if number is not None and callable(handler):
                self.handlers[number] = handler
                signal.signal(number, self._note)

    def end(self) -> None:
        """Let whoever is waiting be heard."""
        if threading.current_thread() is not threading.main_thread():
            return
        self.depth -= 1
        if self.depth > 0:
            return
        handlers, self.handlers = self.handlers, {}
        for number, handler in handlers.items():
            signal.signal(number, handler)
        waiting, self.waiting = self.waiting, None
        if waiting is not None:
            handlers[waiting](waiting, None)

    def _note(self, number: int, _: Any) -> None:
        self.waiting = number


_DEFERRAL = Deferral()


@contextmanager
def interrupts_wait() -> Iterator[None]:
    """Let signals wait until the end of the block."""
    _DEFERRAL.begin()
    try:
        yield
    finally:
        _DEFERRAL.end()


def wait_for_the_compiler() -> None:
    """Let signals, and the search for garbage, wait while numba compiles, from now on."""
    from numba.core import event

    listener: Any = event.Listener  # numba has no types that mypy sees
    register: Any = event.register

    class Compiling(listener):  # type: ignore[misc]
        """Listens when numba takes and releases the lock under which it compiles."""

        def on_start(self, event: Any) -> None:
            _DEFERRAL.begin()
            look_rarely()

        def on_end(self, event: Any) -> None:
            look_as_before()
            _DEFERRAL.end()

    register("numba:compiler_lock", Compiling())
