"""A user's strategy: a Python file that uses @shoal.strategy, loaded by path, or one of an installed package."""

import hashlib
import importlib.util
import linecache
import sys
from collections.abc import Iterable
from pathlib import Path
from types import TracebackType
from typing import Any

from shoal.core.errors import StrategyError, did_you_mean
from shoal.strategies import CATALOGUE, TEMPLATES, Strategy
from shoal.strategies.installed import load_installed


def load_strategies(choice: Any) -> Any:
    """Load the file or package that a [strategy] table, or a name, needs; return it, of a file with name and source.

    Raises
    ------
    StrategyError : the file or package cannot be loaded, or is not the one that the table was made with
    """
    if not isinstance(choice, (dict, str)):
        return choice  # loaded already, or wrong
    if isinstance(choice, dict) and isinstance(choice.get("file"), str):
        return _load_file(choice)
    table = choice if isinstance(choice, dict) else {"name": choice}
    known = find_strategy(str(table.get("name")), table.get("source"))
    if known and table.get("source") not in (None, source_of(known)):
        raise StrategyError(
            known.source,
            f"strategy {known.name!r} is not the version that this scenario was made with",
            "install that one, or drop `source` to use this one anyway",
        )
    return choice


def find_strategy(name: str, source: object = None) -> Strategy | None:
    """The strategy of a name: the one that a file of this source defines, or else the catalogue's or a package's.

    Raises
    ------
    StrategyError : an installed package offers it and fails to import
    """
    loaded = _LOADED.get(source, {}) if isinstance(source, str) else {}
    return loaded.get(name) or CATALOGUE.get(name) or load_installed(name)


def meant_by(name: str, known: Iterable[str]) -> str:
    """What whoever names a strategy that is not there may mean; empty, or ends in a space."""
    if name in TEMPLATES:
        return f"{name} is a template: `shoal learn {name}` makes learned.py of it, a strategy: --strategy learned.py; "
    return did_you_mean(name, known)


def known_strategy(name: str, source: object = None) -> Strategy | None:
    """The strategy of a name and source if this process has that very one already; nothing is loaded."""
    if isinstance(source, str) and name in _LOADED.get(source, {}):
        return _LOADED[source][name]
    known = CATALOGUE.get(name)
    return known if known and source_of(known) == source else None


def name_of(choice: Any) -> Any:
    """The name of a strategy given as the function that @shoal.strategy decorates; anything else unchanged."""
    return next((known.name for known in CATALOGUE.values() if known.decide is choice), choice)


def source_of(known: Strategy) -> str | None:
    """First 16 hex digits of a hash over the file or the notebook cell that defines a user's strategy.

    None of a built-in one, and of one whose text nobody has kept.
    """
    path = Path(known.source)
    if known.builtin:
        return None
    text = path.read_bytes() if path.is_file() else "".join(linecache.getlines(known.source)).encode()
    return _hash(text) if text else None


def _load_file(choice: dict[str, Any]) -> dict[str, Any]:
    """Execute the file that a table names.

    Raises
    ------
    StrategyError : no such file, it fails to import, it defines no strategy or several and none is named,
        or its source is not the one that the table insists on
    """
    path = Path(choice["file"])
    try:
        if path.suffix != ".py" and path.is_file():
            raise StrategyError(str(path), "is not a Python file", "name a file that ends in .py")
        text = path.read_bytes()
    except OSError as error:
        raise StrategyError(str(path), f"cannot be read: {error.strerror}", "name a Python file") from None
    except ValueError as error:
        if isinstance(error, StrategyError):
            raise
        raise StrategyError(str(path), "holds a NUL, which no path can", "name a Python file") from None
    source = _hash(text)
    if choice.get("source") not in (None, source):
        raise StrategyError(
            str(path),
            "is not the file that this scenario was made with",
            "restore it, or drop `source` to use it anyway",
        )
    names = list(_defined_by(path, source))
    name = choice.get("name") or (names[0] if len(names) == 1 else None)
    if name not in names:
        raise StrategyError(str(path), f"defines {', '.join(names)}", 'choose one: name = "..."')
    return {**choice, "name": name, "source": source}


def _hash(text: bytes) -> str:
    return hashlib.sha256(text).hexdigest()[:16]


_LOADED: dict[str, dict[str, Strategy]] = {}  # by source: a file is executed once per version


def _defined_by(path: Path, source: str) -> dict[str, Strategy]:
    if source not in _LOADED:
        before = dict(CATALOGUE)
        try:
            _execute(path, f"shoal_plugin_{path.stem.replace('-', '_')}_{source}")
            _LOADED[source] = _new_strategies(path, before)
        finally:  # the catalogue is ours; a file's strategies are found by its source
            CATALOGUE.clear()
            CATALOGUE.update(before)
    return _LOADED[source]


def _new_strategies(path: Path, before: dict[str, Strategy]) -> dict[str, Strategy]:
    new = {name: known for name, known in CATALOGUE.items() if before.get(name) is not known}
    taken = [name for name in new if name in before and before[name].builtin]
    if taken:
        raise StrategyError(str(path), f"redefines the built-in strategy {taken[0]!r}", "give it a name of its own")
    if not new:
        raise StrategyError(str(path), "defines no strategy", "decorate a function with @shoal.strategy(...)")
    return new


def _execute(path: Path, module_name: str) -> None:
    spec = importlib.util.spec_from_file_location(module_name, path)
    if spec is None or spec.loader is None:
        raise StrategyError(str(path), "is not a Python file", "name a file that ends in .py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[module_name] = module
    try:
        spec.loader.exec_module(module)
    except StrategyError as error:
        where, problem, fix = error.args
        raise StrategyError(f"{path} {where}", problem, fix) from error
    except (Exception, SystemExit) as error:
        line = error.lineno if isinstance(error, SyntaxError) else line_in(error.__traceback__, path)
        raise StrategyError(
            f"{path}:{line}" if line else str(path), f"{type(error).__name__}: {error}", "correct it"
        ) from error


def line_in(trace: TracebackType | None, file: str | Path) -> int | None:
    """The innermost line of a file that a traceback goes through.

    Machine code kept from an earlier process knows its file by the path that it had then, so a file of the same name
    will do where there is none of this path.
    """
    exact, by_name = None, None
    while trace:
        passed = trace.tb_frame.f_code.co_filename
        if passed == str(file):
            exact = trace.tb_lineno
        elif Path(passed).name == Path(file).name:
            by_name = trace.tb_lineno
        trace = trace.tb_next
    return by_name if exact is None else exact
