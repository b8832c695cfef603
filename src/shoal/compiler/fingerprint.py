"""A hash of all that the machine code of a user's functions is made of, so that it can be kept for the next process.

Two nets, one behind the other: the text of the file that defines a function, of every file that it imports, and so on;
and what the compiler will see, found as it finds it: the code of a function and the value of every name in it, which
may come from a data file or the environment and is frozen into machine code. Python's own library, numpy, numba and
Shoal go by their versions, which name the cache. Where something is neither, there is no hash.
"""

import ast
import enum
import hashlib
import sys
import sysconfig
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

from shoal.compiler.kernel import COMPILED_FOLDERS

MOST = 300  # files: who imports more, such as a plotting library, is compiled in every process
_NAMED = (FunctionType, BuiltinFunctionType, type)  # of the library: their names say all
_VERSIONED = ("numpy", "numba", "llvmlite")
_EXTENDS = ("overload", "intrinsic", "numba.core", "numba.extending")  # words of files that change the compiler itself
_STDLIB = tuple(Path(sysconfig.get_path(name)).resolve() for name in ("stdlib", "platstdlib"))
_INSTALLED = tuple(Path(sysconfig.get_path(name)).resolve() for name in ("purelib", "platlib"))


class _UnknownError(Exception):
    """Nobody can say what this is made of."""


def fingerprint(functions: Iterable[Any], *facts: object) -> str | None:
    """The hash over functions and facts; None if something in them has no value that can be hashed.

    Parameters
    ----------
    functions : plain ones or kernels
    facts : what else is compiled in, as text
    """
    digest = hashlib.sha256(repr(facts).encode())
    seen: dict[int, Any] = {}
    files: dict[str, bytes] = {}
    try:
        for each in functions:
            for piece in _value(each, seen):
                digest.update(piece + b"\0")
        for each in list(seen.values()):
            if isinstance(each, FunctionType):
                home = _home(each)
                if home is None:
                    raise _UnknownError(each)  # of a text given to `exec`: another process has no module to look it up
                if not _is_trusted(home):
                    _read(each.__globals__["__name__"], files)
    except (_UnknownError, RecursionError):
        return None
    for name in sorted(files):
        digest.update(name.encode() + b"\0" + files[name] + b"\0")
    return digest.hexdigest()[:24]


def _value(value: Any, seen: dict[int, Any]) -> Iterator[bytes]:
    """What there is to hash of a value, in the order in which it is met; each object once."""
    value = getattr(value, "py_func", value)  # of a kernel
    if value is None or isinstance(value, (bool, int, float, complex, str, bytes, np.generic)):
        yield f"{type(value).__module__}.{type(value).__name__} {value!r}".encode()
    elif isinstance(value, enum.Enum):
        yield f"{type(value).__qualname__}.{value.name}".encode()
        yield from _value(value.value, seen)
    elif id(value) in seen:
        yield f"again {list(seen).index(id(value))}".encode()
    else:
        seen[id(value)] = value
        yield from _object(value, seen)


def _object(value: Any, seen: dict[int, Any]) -> Iterator[bytes]:
    kind = type(value)
    if isinstance(value, tuple):
        yield f"{kind.__qualname__} of {len(value)} {getattr(kind, '_fields', '')}".encode()
        for each in value:
            yield from _value(each, seen)
    elif isinstance(value, np.ndarray) and not value.dtype.hasobject:
        yield f"{value.dtype.descr} {value.shape} {value.flags.c_contiguous}".encode()
        yield value.tobytes()
    elif isinstance(value, np.dtype):
        yield repr(value.descr).encode()
    elif isinstance(value, ModuleType):
        yield f"module {value.__name__}".encode()  # what is used of it is met by its names, see _names
    elif isinstance(value, np.ufunc) or (isinstance(value, _NAMED) and _is_trusted(_home(value))):
        yield f"{getattr(value, '__module__', '')}.{getattr(value, '__qualname__', value.__name__)}".encode()
    elif isinstance(value, FunctionType):
        yield from _function(value, seen)
    elif isinstance(value, type) and issubclass(value, tuple) and hasattr(value, "_fields"):
        yield f"{value.__module__}.{value.__qualname__} {value._fields}".encode()
    elif isinstance(value, type) and issubclass(value, enum.Enum):
        for each in value:
            yield from _value(each, seen)
    else:
        raise _UnknownError(value)


def _home(value: Any) -> Any:
    """The module that something was defined in: of a function, where its names are looked up, whatever it says."""
    where = value.__globals__.get("__name__") if isinstance(value, FunctionType) else getattr(value, "__module__", None)
    return sys.modules.get(where) if isinstance(where, str) else None


def _function(function: FunctionType, seen: dict[int, Any]) -> Iterator[bytes]:
    """Its code, its defaults, what it closes over, and whatever its names mean."""
    yield f"{function.__module__}.{function.__qualname__}".encode()
    yield from _code(function.__code__)
    for each in (function.__defaults__, tuple(sorted((function.__kwdefaults__ or {}).items()))):
        yield from _value(each, seen)
    for cell in function.__closure__ or ():
        yield from _value(cell.cell_contents, seen)
    names = sorted(_names(function.__code__))
    spaces = [function.__globals__]
    for name in names:
        if name in function.__globals__:
            yield name.encode()
            yield from _value(function.__globals__[name], seen)
            spaces += _spaces(function.__globals__[name], names)
    for space in spaces[1:]:
        for name in names:
            if name in space:
                yield name.encode()
                yield from _value(space[name], seen)


def _spaces(value: Any, names: list[str]) -> Iterator[dict[str, Any]]:
    """The names in a module of the user's, and in those in it that are named, too."""
    if isinstance(value, ModuleType) and not _is_trusted(value):
        yield vars(value)
        for name in names:
            if isinstance(vars(value).get(name), ModuleType):
                yield from _spaces(vars(value)[name], [each for each in names if each != name])


def _code(code: CodeType) -> Iterator[bytes]:
    yield code.co_code
    yield repr((code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars, code.co_argcount)).encode()
    for each in code.co_consts:
        if isinstance(each, CodeType):
            yield from _code(each)
        else:
            yield f"{type(each).__name__} {each!r}".encode()


def _names(code: CodeType) -> set[str]:
    inner = [_names(each) for each in code.co_consts if isinstance(each, CodeType)]
    return set(code.co_names).union(*inner)


def _read(module: str, files: dict[str, bytes]) -> None:
    """Add the file of a module, and of those that it imports, by their names.

    Raises
    ------
    _UnknownError : there are too many, one cannot be read, or changes what the compiler knows
    """
    loaded = sys.modules.get(module)
    if module in files or loaded is None or _is_trusted(loaded) or module.startswith("shoal."):
        return  # one that is not loaded was not imported; of ours, whatever is used is met as a value
    file = getattr(loaded, "__file__", None)
    if file is None or module == "__main__":  # which another process does not find again
        if hasattr(loaded, "__path__"):
            return  # a namespace has no code
        raise _UnknownError(module)
    if len(files) == MOST:
        raise _UnknownError(f"{MOST} files")
    try:
        files[module] = Path(file).read_bytes()
    except OSError as error:
        raise _UnknownError(file) from error
    if Path(file).suffix != ".py":
        return  # compiled already
    text = files[module].decode(errors="replace")
    if any(word in text for word in _EXTENDS):
        raise _UnknownError(module)
    for name in _imported(text, getattr(loaded, "__package__", None) or ""):
        parts = name.split(".")
        for length in range(1, len(parts) + 1):
            _read(".".join(parts[:length]), files)


def _imported(text: str, package: str) -> set[str]:
    """Names of modules that a file imports, and of what may be one."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError) as error:
        raise _UnknownError(text[:80]) from error
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found.update(each.name for each in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) + 1 - node.level] if node.level else []
            home = ".".join([*above, *([node.module] if node.module else [])])
            found.add(home)
            found.update(f"{home}.{each.name}" for each in node.names)
    return found - {""}


def _is_trusted(module: Any) -> bool:
    """Whether a module is Python's own, or of a package whose version or sources name the cache."""
    if not isinstance(module, ModuleType):
        return False
    first, *inner = module.__name__.split(".")
    if first in _VERSIONED or module.__name__ in sys.builtin_module_names:
        return True
    if first == "shoal":
        return not inner or inner[0] in COMPILED_FOLDERS
    file = getattr(module, "__file__", None)
    if file is None:
        return getattr(getattr(module, "__spec__", None), "origin", None) == "frozen"
    path = Path(file).resolve()
    in_library, installed = (any(map(path.is_relative_to, each)) for each in (_STDLIB, _INSTALLED))
    return in_library and not installed
