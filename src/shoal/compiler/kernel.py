"""@kernel: our only spelling of numba.njit; the flags and the cache are chosen here, once.

Numba's cache does not notice an edited function in another file and would return old numbers silently, so the
cache lives in a folder named by a hash of all our kernel sources (docs/decisions/0002-kernel-cache.md).

A trap: in a kernel that calls an overload with inline="always" (`part`, `enter`, all of strategies/contract.py),
numba removes writes into arrays that it does not see to be an argument's. It sees one dot, `swarm.x[i] = 1.0`, but
neither two, `parts.swarm.x[i] = 1.0`, nor what `part` returned: such a kernel hands the swarm to one that writes.
"""

import hashlib
import os
import tempfile
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
from numba.core import config as numba_config
from numba.core.errors import NumbaExperimentalFeatureWarning
from numba.core.registry import CPUDispatcher

# Fleets with strategies of their own share memory records, which numba passes by their first fields and warns of.
warnings.filterwarnings("ignore", message="Record", category=NumbaExperimentalFeatureWarning)

Function = TypeVar("Function", bound=Callable[..., Any])

_config: Any = numba_config  # its settings come from the environment at run time
_COMPILED_FOLDERS = ("compiler", "core", "world", "strategies", "metrics", "engine")


def kernel(function: Function) -> Function:
    """Compile a function that other kernels call; it is compiled into them and not cached by itself."""
    if hasattr(function, "py_func") or not compiles():
        return function  # compiled already, or never
    return cast(Function, _Inner(function, targetoptions={"nopython": True, **_INNER_FLAGS}))


def entry_kernel(function: Function) -> Function:
    """Compile a function that Python calls, and keep the machine code on disk for the next process."""
    with kernel_cache():
        return cast(Function, numba.njit(function, cache=True, **FLAGS))


@contextmanager
def kernel_cache() -> Iterator[None]:
    """Let numba keep what is decorated inside in our cache folder."""
    outside = _config.CACHE_DIR
    _config.CACHE_DIR = str(cache_folder())
    try:
        yield
    finally:
        _config.CACHE_DIR = outside


def compiles() -> bool:
    """Whether kernels are compiled: not under NUMBA_DISABLE_JIT=1."""
    return not _config.DISABLE_JIT


def uncached(entry: Function) -> Function:
    """Return a twin of an entry kernel that never touches the cache: for strategies whose source we do not hash."""
    if not compiles():
        return entry
    return cast(Function, numba.njit(entry.py_func, **FLAGS))  # type: ignore[attr-defined]


# error_model="numpy": the check for division by zero would stop vectorization (2-3x slower). No fastmath: results
# would depend on the processor. nogil: one thread per run scales to all cores.
FLAGS: dict[str, Any] = {"error_model": "numpy", "nogil": True}


# forceinline: 12 % faster than LLVM's own choice. No wrappers: only Python needs them, and they are a third of all
# compile time, because every wrapper optimizes its kernel once more.
_INNER_FLAGS = {**FLAGS, "forceinline": True, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}


class _Inner(CPUDispatcher):
    """A kernel without wrappers; called from Python, it compiles a twin that has them."""

    def __call__(self, *arguments: Any) -> Any:
        if not hasattr(self, "twin"):
            self.twin = numba.njit(self.py_func, **FLAGS)
        return self.twin(*arguments)


@cache
def cache_folder() -> Path:
    """Folder of the compiled kernels of exactly these sources; $SHOAL_CACHE_DIR moves it."""
    base = os.environ.get("SHOAL_CACHE_DIR") or os.path.join(
        os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache"), "shoal"
    )
    folder = Path(base) / f"kernels-{sources_hash()}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError:  # a read-only home: compile once per process group instead of failing
        return Path(tempfile.gettempdir()) / f"shoal-{os.getuid() if hasattr(os, 'getuid') else 0}" / folder.name


@cache
def sources_hash() -> str:
    """First 16 hex digits of a hash over every kernel source and the compiler's version."""
    digest = hashlib.sha256(numba.__version__.encode())
    root = Path(__file__).parent.parent
    for name in _COMPILED_FOLDERS:
        for source in sorted((root / name).rglob("*.py")):
            digest.update(source.read_bytes())
    return digest.hexdigest()[:16]
