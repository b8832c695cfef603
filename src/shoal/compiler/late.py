"""numba when it is needed, and not before: whoever prints a help, lists, checks or reads need not wait for it.

A kernel is a stand-in until it is compiled into another or called; what overloads say of functions waits, too. Code
that names numba itself, as that of phases and stages, calls `load` first.
"""

import importlib.util
import os
import sys
import threading
import warnings
from collections.abc import Callable
from functools import cache, update_wrapper
from typing import Any

from shoal.compiler.interrupts import interrupts_wait, wait_for_the_compiler

ONE_AT_A_TIME = threading.RLock()

_waiting: list[Callable[[Any], object]] = []  # what is said to numba once it is there
_loaded: list[Any] = []


class Kernel:
    """A function that numba compiles when it is called, or what calls it is compiled.

    Attributes
    ----------
    py_func : the function as it is written
    dispatcher : numba's, made when it is asked for; what numba knows of a kernel is asked of it
    """

    def __init__(self, function: Callable[..., Any], make: Callable[[Callable[..., Any]], Any]) -> None:
        update_wrapper(self, function)
        self.py_func = function
        self._make = make

    def __call__(self, *arguments: Any) -> Any:
        """Run it, compiled."""
        return self.dispatcher(*arguments)

    def __getattr__(self, name: str) -> Any:
        if name == "dispatcher":  # no lock: whoever compiles holds others; of two that are made at once, one stays
            load()
            return self.__dict__.setdefault(name, self._make(self.py_func))
        if name == "_numba_type_" or not name.startswith("_"):  # by the first, numba knows what kernels mean it
            return getattr(self.dispatcher, name)
        raise AttributeError(name)

    def __reduce__(self) -> Any:
        return self.dispatcher.__reduce__()


def load() -> Any:
    """Import numba, the first time, and tell it what was said of functions; return the module."""
    if not _loaded:
        with ONE_AT_A_TIME, interrupts_wait():
            if not _loaded:
                _load()
    return _loaded[0]


def when_loaded(say: Callable[[Any], object]) -> None:
    """Say something to numba: at once if it is there, else when it comes."""
    with ONE_AT_A_TIME:
        if _loaded:
            say(_loaded[0])
        else:
            _waiting.append(say)


def _load() -> None:
    import numba.core.ccallback  # else it is imported with the first phase
    import numba.extending
    from numba.core.errors import NumbaExperimentalFeatureWarning

    # Fleets with strategies of their own share memory records, which numba passes by their first fields and warns of.
    warnings.filterwarnings("ignore", message="Record", category=NumbaExperimentalFeatureWarning)
    wait_for_the_compiler()
    for say in _waiting:
        say(numba)
    _waiting.clear()
    _loaded.append(numba)


def compiles() -> bool:
    """Whether kernels are compiled: not without numba, and not under NUMBA_DISABLE_JIT=1."""
    if settings := sys.modules.get("numba.core.config"):
        return is_installed() and not settings.DISABLE_JIT
    return is_installed() and os.environ.get("NUMBA_DISABLE_JIT", "") in ("", "0")


@cache
def is_installed() -> bool:
    """Whether there is numba: not on the small computer of a buoy."""
    try:
        return importlib.util.find_spec("numba") is not None
    except (ImportError, ValueError):
        return False


def compiler_errors() -> tuple[type[Exception], ...]:
    """What the compiler raises; nothing as long as it is not there."""
    return (_loaded[0].core.errors.NumbaError,) if _loaded else ()
