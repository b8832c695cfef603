"""Try what may bring the whole process down: C libraries crash on some damaged files."""

import faulthandler
import multiprocessing
import threading
from collections.abc import Callable
from contextlib import suppress

LONGEST = 60.0  # [s]


def is_safe(action: Callable[[], object]) -> bool:
    """Return whether `action` neither crashes nor hangs, by trying it in a fork of this process.

    An exception is no crash. Where there is no fork, or other threads run that might hold a lock, nothing is tried.
    """
    if "fork" not in multiprocessing.get_all_start_methods() or threading.active_count() > 1:
        return True
    child = multiprocessing.get_context("fork").Process(target=_try, args=(action,), daemon=True)
    try:
        child.start()
    except (OSError, AssertionError):  # no more processes; or this is a daemon itself, which may have no children
        return True
    child.join(LONGEST)
    hangs = child.is_alive()
    if hangs:
        child.kill()
        child.join()
    return not hangs and child.exitcode == 0


def _try(action: Callable[[], object]) -> None:
    faulthandler.disable()
    with suppress(Exception):
        action()
