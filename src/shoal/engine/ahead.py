"""A cold start on two cores: another process compiles part of the engine into the same cache.

It begins with `set_out` and goes on with the phases from the last to the first, while this process goes from the first
to the last; what one finds in the cache it does not compile. At most the one that they meet at is compiled twice.
"""

import os
import subprocess
import sys
import time
from collections.abc import Sequence
from typing import Any

from shoal.compiler.kernel import cache_folder, why_uncached
from shoal.compiler.late import compiles
from shoal.compiler.phase import Phase

_BUSY = "compiling-ahead"  # in the cache, while such a process runs
LONGEST = 900.0  # [s] that such a process may take
FEW = 3  # phases that this process compiles alone
_CODE = "from shoal.engine.ahead import compile_names; compile_names({names!r})"


def compile_ahead(phases: Sequence[Phase]) -> None:
    """Start a process that compiles these phases into the cache, from the last on, if most of them are not in it.

    Parameters
    ----------
    phases : in the order in which this process takes them
    """
    if not compiles() or why_uncached() or (os.cpu_count() or 1) < 2:
        return
    kept = {file.name.split("-")[0] for file in cache_folder().glob("*/*.nbi")}
    missing = [each.function.__name__ for each in phases if f"{_home(each)}.{each.function.__name__}" not in kept]
    if len(missing) <= FEW:
        return
    busy = cache_folder() / _BUSY
    try:
        if busy.exists() and time.time() - busy.stat().st_mtime > LONGEST:
            busy.unlink(missing_ok=True)  # of one that was killed
        busy.touch(exist_ok=False)  # one such process is enough, whoever asks
    except OSError:
        return
    code = _CODE.format(names=missing[::-1])
    quiet = subprocess.DEVNULL
    started = subprocess.Popen([sys.executable, "-c", code], stdin=quiet, stdout=quiet, stderr=quiet)
    started.returncode = 0  # nobody waits for it, and it may outlive us


def _home(phase: Phase) -> str:
    return phase.function.__module__.rsplit(".", 1)[-1]


def compile_names(names: Sequence[str]) -> None:
    """Compile `set_out` and phases of these names, as the process that was started."""
    from numba import types

    from shoal.engine import many, nature, phases, rollout

    parent = os.getppid()
    try:
        set_out: Any = rollout.set_out
        set_out.compile((types.int64, types.int64[::1], types.float64[::1], types.int64[:, ::1]))
        for name in names:
            if os.getppid() != parent:
                return  # nobody is waiting any more
            phase: Phase = next(getattr(each, name) for each in (phases, nature, many) if hasattr(each, name))
            phase.address()
    finally:
        (cache_folder() / _BUSY).unlink(missing_ok=True)
