"""Machine code on disk: a file for each function and kinds of arguments, which is whole or as good as not there.

numba's own cache keeps an index beside numbered files. Of two processes that compile one function for two strategies,
each may take the other's number, and code of the wrong strategy would run; and before it looks, it makes all ready to
compile, which takes longer than to load what is there. Who may write into the folder is kernel.py's business.
"""

import hashlib
import os
import pickle
import platform
import tempfile
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

import llvmlite.binding as llvmlite
import numpy as np
from numba.core.caching import _Cache
from numba.core.compiler import compile_result
from numba.core.runtime import _nrt_python  # type: ignore[attr-defined]
from numba.core.serialize import dumps
from numba.core.sigutils import normalize_signature

_CACHE: Any = _Cache  # numba has no types that mypy sees
_dumps: Any = dumps
_normalize: Any = normalize_signature
_helpers: Any = _nrt_python.c_helpers
_result: Any = compile_result
_DIGEST = 32  # bytes that a file begins with: the hash of the others
_ENDING = ".kernel"
_OWN, MOST_OWN = "own-", 100  # files of users' strategies: every version of one is another; the oldest go


class Cache(_CACHE):  # type: ignore[misc]
    """What numba asks for the machine code of a function before it compiles it, and tells when it has.

    Parameters
    ----------
    function : as it is written
    folder : of the files
    made_of : a hash of whatever goes into its code beside the sources that the folder is named by
    """

    def __init__(self, function: Callable[..., Any], folder: Path, made_of: str = "") -> None:
        self.name = f"{function.__module__.rpartition('.')[2]}.{function.__qualname__}"
        self.folder = folder
        self.made_of = made_of

    @property
    def cache_path(self) -> str:
        """The folder."""
        return str(self.folder)

    def file(self, signature: Any, target: Any) -> Path:
        """Where the code for a signature is, of this processor and these versions."""
        kinds = ", ".join(str(each) for each in _normalize(signature)[0])
        key = hashlib.sha256("\n".join([self.name, kinds, self.made_of, _versions(target.codegen())]).encode())
        return self.folder / f"{_OWN if self.made_of else ''}{self.name}-{key.hexdigest()[:24]}{_ENDING}"

    def load_overload(self, signature: Any, target: Any) -> Any:
        """What numba takes for just compiled; None if it is not there."""
        try:
            content = self.file(signature, target).read_bytes()
        except OSError:
            return None
        if hashlib.sha256(content[_DIGEST:]).digest() != content[:_DIGEST]:
            return None  # the power went as it was written
        _add_runtime_symbols()
        try:
            code, rest = pickle.loads(content[_DIGEST:])
        except ImportError:
            return None  # it names a module that this process cannot import
        kinds = tuple(_normalize(signature)[0])
        return _rebuilt(target, code, *rest) if kinds == tuple(rest[2].args) else None  # else of the same name only

    def save_overload(self, signature: Any, compiled: Any) -> None:
        """Keep it; where that cannot be done, the next process compiles again."""
        library = compiled.library
        if library.has_dynamic_globals:
            return  # addresses of this process are in it
        (name, _, (code, _)), *rest = compiled._reduce()
        module = library._final_module
        symbols = {each.name for each in (*module.functions, *module.global_variables) if not each.is_declaration}
        content = _dumps(((name, code, symbols), rest))
        with suppress(OSError):
            write_whole(self.file(signature, compiled.target_context), hashlib.sha256(content).digest() + content)
            by_age = sorted(self.folder.glob(f"{_OWN}*{_ENDING}"), key=lambda each: -each.stat().st_mtime)
            for each in by_age[MOST_OWN:]:
                each.unlink()

    def enable(self) -> None:
        """It is."""

    def disable(self) -> None:
        """It stays: whoever wants none gives none."""

    def flush(self) -> None:
        """Nothing is kept in memory."""


@cache
def _versions(codegen: Any) -> str:
    """What code runs on: the versions that it was compiled with, and the processor."""
    return " ".join(map(str, (platform.python_version(), np.__version__, *codegen.magic_tuple())))


@cache
def _add_runtime_symbols() -> None:
    """Say where what compiled code calls is, as numba does before it compiles."""
    for name, address in _helpers.items():
        llvmlite.add_symbol(name if name.startswith("_") else f"NRT_{name}", address)


def write_whole(file: Path, content: bytes) -> None:
    """Write a file that other processes find whole or not at all.

    Raises
    ------
    OSError : it cannot be written; nothing is left of it
    """
    number, unfinished = tempfile.mkstemp(dir=file.parent, prefix="unfinished-")
    try:
        with os.fdopen(number, "wb") as out:
            out.write(content)
        os.replace(unfinished, file)
    except BaseException:
        with suppress(OSError):
            os.unlink(unfinished)
        raise


def _rebuilt(target: Any, code: Any, *rest: Any) -> Any:
    """As CompileResult._rebuild does, without the code's text in LLVM's language: nobody compiles it into another."""
    description, environment, signature, object_mode, lifted, annotation, reload_init, environments = rest
    for each in reload_init:
        each()
    name, machine_code, symbols = code
    codegen = target.codegen()
    library = codegen.create_library(name)
    library.enable_object_caching()
    library._set_compiled_object(machine_code)
    library._finalize_final_module()
    codegen._engine._defined_symbols |= symbols
    entry = target.get_executable(library, description, environment)
    for each in environments:
        codegen.set_env(each.env_name, each)
    return _result(
        typing_context=target.typing_context,
        target_context=target,
        entry_point=entry,
        type_annotation=annotation,
        signature=signature,
        objectmode=object_mode,
        lifted=lifted,
        fndesc=description,
        library=library,
        environment=environment,
        reload_init=reload_init,
        referenced_envs=environments,
    )
