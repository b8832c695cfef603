"""Whether a function of a strategy asks for the rank of a neighbor: ranks are worked out only for those that do."""

from collections.abc import Callable
from types import CodeType, FunctionType, ModuleType
from typing import Any


def asks_for_rank(function: Callable[..., Any]) -> bool:
    """Whether it, or a function that it calls, reads a field called `rank`."""
    return _asks(function, set())


def _asks(function: Any, seen: set[Any]) -> bool:
    plain = getattr(function, "py_func", function)
    if not isinstance(plain, FunctionType) or plain in seen:
        return False
    seen.add(plain)
    names = _names(plain.__code__)
    return "rank" in names or any(_asks(each, seen) for each in _mentioned(plain, names))


def _names(code: CodeType) -> set[str]:
    """Globals and fields that code mentions, that of functions inside it too."""
    inner = [_names(each) for each in code.co_consts if isinstance(each, CodeType)]
    return set(code.co_names).union(*inner)


def _mentioned(plain: FunctionType, names: set[str]) -> list[Any]:
    """What the names may stand for: globals, what modules among them hold, and what it closes over."""
    found = [plain.__globals__[name] for name in names if name in plain.__globals__]
    inside = [getattr(each, name, None) for each in found if isinstance(each, ModuleType) for name in names]
    return [*found, *inside, *(cell.cell_contents for cell in plain.__closure__ or ())]
