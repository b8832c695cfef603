"""A cold start on all cores: other processes compile parts of the engine into the same cache.

This process begins with what it alone can compile, the strategy's part, and they with the parts that know none; whoever
is free takes the longest part that nobody has taken yet, by a file of its name that only one can make. What others have
taken is waited for as long as they live. A file of the cache is whole or not there (compiler/cache.py).
"""

import atexit
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, Protocol

from shoal.compiler.kernel import cache_folder, why_uncached
from shoal.compiler.late import compiles

_BUSY = "compiling-"  # folders of the cache in which parts are taken
LONGEST = 900.0  # [s] that a cold start may take; older folders are of one that was killed
PATIENCE = 300.0  # [s] that a part of another process is waited for
FEW = 3  # parts that this process compiles alone; every three more are worth a process
MOST = 7  # such processes
_LONG = (
    "move_agents",
    "sense_all",
    "set_out",
    "move_targets",
    "link",
    "link_single",
    "measure",
    "look_at_links",
)  # the longest first
_CODE = "from shoal.engine.ahead import help_compiling; help_compiling({folder!r}, {names!r}, {count})"


class Part(Protocol):
    """What is compiled by itself: a phase, or a kernel that Python calls with the same kinds of arguments always."""

    name: str

    def is_kept(self) -> bool:
        """Whether its machine code is in the cache."""

    def address(self) -> Any:
        """Compile it, or load it from the cache."""


class _Helpers:
    """The processes that this one has started, and the folder in which all take their parts."""

    def __init__(self, names: Sequence[str], count: int) -> None:
        self.folder = tempfile.mkdtemp(prefix=_BUSY, dir=cache_folder())
        atexit.register(shutil.rmtree, self.folder, ignore_errors=True)  # whoever finds it gone stops
        code = _CODE.format(folder=self.folder, names=list(names), count=count)
        quiet = subprocess.DEVNULL
        self.processes = [
            subprocess.Popen([sys.executable, "-P", "-c", code], stdin=quiet, stdout=quiet, stderr=quiet)
            for _ in range(count)
        ]
        atexit.register(self._part)

    def are_there(self) -> bool:
        """Whether one of them still runs."""
        return any(each.poll() is None for each in self.processes)

    def _part(self) -> None:
        for each in self.processes:
            each.returncode = each.poll() or 0  # nobody waits for them, and they may outlive us


_started: list[_Helpers] = []
_under_way: list[Part] = []


def compile_ahead(parts: Sequence[Part], soon: Sequence[Part] = ()) -> None:
    """Start processes that compile these parts into the cache, if many of them are not in it.

    Parameters
    ----------
    parts : what is needed
    soon : what else is likely to be asked for, and not waited for
    """
    if not compiles():
        return
    missing = [*_missing(parts), *_missing(soon)]
    if len(missing) <= FEW:
        return
    _under_way[:] = missing
    count = min(cores() - 1, len(missing) // FEW, MOST)
    if count > 0 and not why_uncached() and not _others_are_at_it():
        with suppress(OSError):  # then it takes longer
            _started.append(_Helpers([each.name for each in missing], count))


def compile_all(parts: Sequence[Part]) -> None:
    """Compile what nobody has taken, and wait for the rest. Whatever is not there afterwards, the caller compiles.

    Parameters
    ----------
    parts : what is needed
    """
    helpers = next((each for each in _started[-1:] if each.are_there()), None)
    missing = _missing(parts) if helpers or _under_way else []
    for each in missing:
        if not each.is_kept() and (helpers is None or _take(helpers.folder, each.name)):
            each.address()
    until = time.monotonic() + PATIENCE
    for each in missing:
        while helpers and not each.is_kept() and helpers.are_there() and time.monotonic() < until:
            time.sleep(0.02)
    _under_way.clear()


def how_far() -> tuple[int, int] | None:
    """Of a cold start under way: how many parts are compiled, and how many there are."""
    parts = list(_under_way)
    return (sum(each.is_kept() for each in parts), len(parts)) if parts else None


def cores() -> int:
    """How many this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _missing(parts: Sequence[Part]) -> list[Part]:
    """Those that are not in the cache, the longest first."""
    ranks = {name: rank for rank, name in enumerate(_LONG)}
    return sorted((each for each in parts if not each.is_kept()), key=lambda each: ranks.get(each.name, len(ranks)))


def help_compiling(folder: str, names: Sequence[str], count: int) -> None:
    """Compile parts of these names that nobody has taken, as one of `count` processes that were started for it."""
    from shoal.engine import links, many, nature, phases
    from shoal.engine.rollout import SET_OUT

    parent = os.getppid()
    try:
        for name in names:
            if os.getppid() != parent or not os.path.isdir(folder):
                return  # nobody is waiting any more
            rooms = [each for each in (phases, links, nature, many) if hasattr(each, name)]
            part: Part = SET_OUT if name == SET_OUT.name else getattr(rooms[0], name)
            if not part.is_kept() and _take(folder, name):
                part.address()
    finally:
        _take(folder, f"ended-{os.getpid()}")
        if len(list(Path(folder).glob("ended-*"))) == count:
            shutil.rmtree(folder, ignore_errors=True)


def _take(folder: str, name: str) -> bool:
    """Whether nobody else has taken a part."""
    try:
        os.close(os.open(os.path.join(folder, name), os.O_CREAT | os.O_EXCL, 0o600))
    except OSError:
        return False
    return True


def _others_are_at_it() -> bool:
    """Whether processes compile already, whoever asked: as many more would only be in their way."""
    for each in Path(cache_folder()).glob(f"{_BUSY}*"):
        try:
            age = time.time() - each.stat().st_mtime
        except OSError:
            continue
        if age < LONGEST:
            return True
        shutil.rmtree(each, ignore_errors=True)
    return False
