"""Call what may bring the whole process down in another one: C libraries crash on some damaged files."""

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

_CALL = """
import pickle, sys
from shoal.core.crash import outcome
answer = outcome(*pickle.load(sys.stdin.buffer))
sys.stdout.buffer.write(pickle.dumps(answer))
"""


class Crashed(Exception):  # noqa: N818  what happened elsewhere, not here
    """The other process crashed, or did not end."""


def is_safe(function: Callable[..., Any], *arguments: Any) -> bool:
    """Return whether a call neither crashes nor hangs, by trying it in a process of its own. It may raise.

    Parameters
    ----------
    function, arguments : as `elsewhere`; what it returns need not be pickled
    """
    try:
        elsewhere(_try, function, *arguments)
    except Crashed:
        return False
    return True


def elsewhere(function: Callable[..., Any], *arguments: Any, longest: float | None = None) -> Any:
    """Return what a call returns, or raise what it raises, made in a process of its own; here, if none can be had.

    A fork costs milliseconds; where there is none, or another thread might hold a lock that the fork would wait for,
    a new interpreter costs the import of what `function` needs.

    Parameters
    ----------
    function : of a module, for a new interpreter to import; arguments : can be pickled, as its result
    longest : [s] after which it hangs; default LONGEST

    Raises
    ------
    Crashed : it does, or hangs
    """
    longest = LONGEST if longest is None else longest
    returned, value = _forked(function, arguments, longest) or _interpreted(function, arguments, longest)
    if not returned:
        raise value
    return value


def outcome(function: Callable[..., Any], arguments: tuple[Any, ...]) -> tuple[bool, Any]:
    """Return whether a call returned, and what it returned or raised."""
    faulthandler.disable()
    try:
        return True, function(*arguments)
    except Exception as error:
        return False, error


def _try(function: Callable[..., Any], *arguments: Any) -> None:
    with suppress(Exception):
        function(*arguments)


def _forked(function: Callable[..., Any], arguments: tuple[Any, ...], longest: float) -> tuple[bool, Any] | None:
    """The outcome in a fork; None if there is none to be had."""
    if "fork" not in multiprocessing.get_all_start_methods() or threading.active_count() > 1:
        return None
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)
    child = context.Process(target=_answer, args=(there, function, arguments), daemon=True)
    with here, there:
        try:
            child.start()
        except (OSError, AssertionError):  # no more processes; or this is a daemon, which may have no children
            return None
        there.close()
        try:
            if not here.poll(longest):
                raise Crashed
            answer: tuple[bool, Any] = pickle.loads(here.recv_bytes())
        except (EOFError, OSError) as error:  # it ended without an answer
            raise Crashed from error
        finally:
            if child.is_alive():
                child.join(1.0)
            child.kill()
            child.join()
    return answer


def _answer(connection: Any, function: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
    connection.send_bytes(pickle.dumps(outcome(function, arguments)))


def _interpreted(function: Callable[..., Any], arguments: tuple[Any, ...], longest: float) -> tuple[bool, Any]:
    """The outcome in a new interpreter."""
    try:
        ended = subprocess.run(
            [sys.executable, "-c", _CALL],
            input=pickle.dumps((function, arguments)),
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            timeout=longest,
            check=False,
        )
    except subprocess.TimeoutExpired as error:
        raise Crashed from error
    except OSError:  # no more processes: it cannot be tried
        return outcome(function, arguments)
    if ended.returncode:
        raise Crashed
    answer: tuple[bool, Any] = pickle.loads(ended.stdout)
    return answer
