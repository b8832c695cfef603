"""Waiting for other threads, such that Ctrl-C is heard: the system may give a signal to one that cannot act on it.

Python acts on signals in its main thread alone, and a signal that another thread took does not wake it up.
"""

import threading
from collections.abc import Iterable
from concurrent.futures import FIRST_COMPLETED, Future, wait
from typing import TypeVar

Result = TypeVar("Result")

_HEARING = 0.5  # [s] the longest that a signal waits


def wait_for(event: threading.Event) -> None:
    """Wait until it is set."""
    while not event.wait(_HEARING):
        pass


def first_done(futures: Iterable[Future[Result]]) -> set[Future[Result]]:
    """Wait until one is done, at least; return those that are. There must be one."""
    waiting = set(futures)
    while not (done := wait(waiting, timeout=_HEARING, return_when=FIRST_COMPLETED).done):
        pass
    return done
