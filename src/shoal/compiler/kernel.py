"""@kernel: our only spelling of numba.njit; the flags and the cache are chosen here, once.

Without numba, on the small computer of a buoy, kernels are the plain functions that they are written as.

A cache of compiled code does not notice an edited function in another file, and would return old numbers silently, so
ours (cache.py) lives in a folder named by a hash of all our kernel sources (docs/decisions/0002-kernel-cache.md).

A trap: in a kernel that calls an overload with inline="always" (`part`, `enter`, all of strategies/asking.py),
numba removes writes into arrays that it does not see to be an argument's. It sees one dot, `swarm.x[i] = 1.0`, but
neither two, `parts.swarm.x[i] = 1.0`, nor what `part` returned: such a kernel hands the swarm to one that writes.
"""

import atexit
import hashlib
import os
import shutil
import tempfile
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import Any, TypeVar, cast

from shoal.compiler.installed import offered_sources
from shoal.compiler.late import Kernel, compiles, is_installed, load, when_loaded
from shoal.compiler.private import make_private

Function = TypeVar("Function", bound=Callable[..., Any])

COMPILED_FOLDERS = ("compiler", "core", "world", "strategies", "metrics", "engine")


def kernel(function: Function) -> Function:
    """Compile a function that other kernels call; it is compiled into them and not cached by itself."""
    if hasattr(function, "py_func") or not compiles():
        return function  # compiled already, or never
    return cast(Function, Kernel(function, _inner))


def entry_kernel(function: Function) -> Function:
    """Compile a function that Python calls, and keep the machine code on disk for the next process."""
    return cast(Function, Kernel(function, _entry)) if is_installed() else function


def _inner(function: Callable[..., Any]) -> Any:
    from shoal.compiler.inlined import InlinedCompiler
    from shoal.compiler.inner import INNER_FLAGS, Inner

    return Inner(function, targetoptions={"nopython": True, **INNER_FLAGS}, pipeline_class=InlinedCompiler)


def _entry(function: Callable[..., Any], made_of: str = "") -> Any:
    return keep(_own(function), function, made_of)


def keep(compiles_it: Any, function: Callable[..., Any], made_of: str = "") -> Any:
    """Let what compiles a function, numba's dispatcher or callback, keep machine code in our folder; return it."""
    from shoal.compiler.cache import Cache

    compiles_it._cache = Cache(function, cache_folder(), made_of)
    return compiles_it


def plain(function: Function) -> Function:
    """The function that a kernel is written as."""
    return cast(Function, getattr(function, "py_func", function))


def overload(function: Callable[..., Any], **options: Any) -> Callable[[Function], Function]:
    """Say what a function is in kernels: numba's decorator of the same name, if there is a compiler."""

    def say(implementation: Function) -> Function:
        if is_installed():
            when_loaded(lambda numba: numba.extending.overload(function, **options)(implementation))
        return implementation

    return say


def twin(entry: Function, made_of: str | None) -> Function:
    """Return an entry kernel of its own, for strategies whose source the folder's hash does not cover.

    Parameters
    ----------
    entry : the kernel
    made_of : a hash of what they are compiled from; None: nobody knows, so that the machine code is not kept
    """
    if not compiles():
        return entry
    make = _own if made_of is None else partial(_entry, made_of=made_of)
    return cast(Function, Kernel(plain(entry), make))


def compile_for(entry: Any, *arguments: Any) -> None:
    """Compile an entry kernel for such arguments, or load it from the cache, without running it."""
    if compiles():
        entry.compile(tuple(load().typeof(each) for each in arguments))


def can_compile(function: Any, *kinds: Any) -> bool:
    """Whether numba can compile a kernel for arguments of such types; for overloads."""
    try:
        function.dispatcher.get_call_template(kinds, {})
    except load().core.errors.NumbaError:
        return False
    return True


class Entry:
    """An entry kernel that is always called with arguments of the same kinds, as a part that is compiled by itself.

    Attributes
    ----------
    name : of the kernel
    """

    def __init__(self, entry: Any, *arguments: Any) -> None:
        self.name: str = entry.__name__
        self._entry = entry
        self._arguments = arguments  # examples

    def is_kept(self) -> bool:
        """Whether its machine code is in the cache."""
        kinds = tuple(load().typeof(each) for each in self._arguments)
        return bool(self._entry.dispatcher._cache.file(kinds, self._entry.targetctx).exists())

    def address(self) -> None:
        """Compile it, or load it."""
        compile_for(self._entry, *self._arguments)


def _own(function: Callable[..., Any]) -> Any:
    from shoal.compiler.inner import FLAGS

    return load().njit(function, **FLAGS)


@cache
def cache_folder() -> Path:
    """Folder of the compiled kernels of exactly these sources; $SHOAL_CACHE_DIR moves it.

    One that somebody else could have written is never read: what is in it would run. This process then has a folder
    of its own, and `why_uncached` says why.
    """
    folder = _shared_folder()
    try:
        make_private(folder)
        with tempfile.TemporaryFile(dir=folder):
            return folder
    except OSError as error:
        _refused.append(f"{folder} cannot be used: {error.strerror}" if error.strerror else str(error))
    own = Path(tempfile.mkdtemp(prefix="shoal-kernels-"))  # 0700
    atexit.register(shutil.rmtree, own, ignore_errors=True)
    return own


def why_uncached() -> str | None:
    """Say why compiled kernels are not kept for the next process; None if they are."""
    cache_folder()
    return _refused[0] if _refused else None


_refused: list[str] = []


def _shared_folder() -> Path:
    base = os.environ.get("SHOAL_CACHE_DIR") or os.path.join(
        os.environ.get("XDG_CACHE_HOME") or os.path.join(os.path.expanduser("~"), ".cache"), "shoal"
    )
    return Path(base).absolute() / f"kernels-{sources_hash()}"


@cache
def sources_hash() -> str:
    """First 16 hex digits of a hash over every kernel source, installed packages' too, and the compiler's version."""
    digest = hashlib.sha256(load().__version__.encode())
    root = Path(__file__).parent.parent
    for name in COMPILED_FOLDERS:
        for source in sorted((root / name).rglob("*.py")):
            digest.update(source.read_bytes())
    for text in offered_sources():
        digest.update(text)
    return digest.hexdigest()[:16]
