"""Try what may bring the whole process down: C libraries crash on some damaged files."""

import faulthandler
import multiprocessing
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import suppress
from typing import Any

LONGEST = 60.0  # [s]

_CALL = "import pickle, sys; function, arguments = pickle.load(sys.stdin.buffer); function(*arguments)"


def is_safe(function: Callable[..., Any], *arguments: Any) -> bool:
    """Return whether a call neither crashes nor hangs, by trying it in a process of its own. It may raise.

    A fork costs milliseconds; where there is none, or another thread might hold a lock that the fork would wait for,
    a new interpreter costs the import of what `function` needs.

    Parameters
    ----------
    function : of a module, for a new interpreter to import; arguments : can be pickled
    """
    if "fork" in multiprocessing.get_all_start_methods() and threading.active_count() == 1:
        child = multiprocessing.get_context("fork").Process(target=_try, args=(function, *arguments), daemon=True)
        try:
            child.start()
        except (OSError, AssertionError):  # no more processes; or this is a daemon, which may have no children
            pass
        else:
            return _ends(child)
    return _ends_elsewhere(function, arguments)


def _try(function: Callable[..., Any], *arguments: Any) -> None:
    faulthandler.disable()
    with suppress(Exception):
        function(*arguments)


def _ends(child: Any) -> bool:
    child.join(LONGEST)
    hangs = child.is_alive()
    if hangs:
        child.kill()
        child.join()
    return not hangs and child.exitcode == 0


def _ends_elsewhere(function: Callable[..., Any], arguments: tuple[Any, ...]) -> bool:
    try:
        ended = subprocess.run(
            [sys.executable, "-c", _CALL],
            input=pickle.dumps((function, arguments)),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            timeout=LONGEST,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return False
    except OSError:  # no more processes: it cannot be tried
        return True
    return ended.returncode in (0, 1)  # 1: it raised
