"""Records that are assembled from files which declare themselves: the fields of every kind, one behind the other.

All targets of a run lie in one array of records, and so do all disturbances, so that any mixture of kinds compiles
once. A record has the fields that all kinds have in common and those that each kind adds. A field of the same name is
the same field, whichever kind names it: a record is of one kind only.
"""

from collections.abc import Iterable, Mapping
from typing import Any, get_args, get_type_hints

import numpy as np

from shoal.core.declared import Declared
from shoal.core.errors import PluginError
from shoal.core.units import Choice

Fields = dict[str, type[Any]]  # int or float, by name


def numbers_of(options: type[Any]) -> Fields:
    """The options that kernels can read: numbers, perhaps None (0), and words of a Choice (their index)."""
    return {name: kind for name, hint in get_type_hints(options).items() if (kind := _number(hint))}


def words_of(options: type[Any]) -> dict[str, tuple[str, ...]]:
    """The words of every option that is a choice, by its name."""
    hints = get_type_hints(options, include_extras=True)
    marks = {name: getattr(hint, "__metadata__", ()) for name, hint in hints.items()}
    return {name: mark.words for name in marks for mark in marks[name] if isinstance(mark, Choice)}


def _number(hint: Any) -> type[Any] | None:
    return next((int if kind is bool else kind for kind in (hint, *get_args(hint)) if kind in (bool, int, float)), None)


def without_contradictions(
    found: Iterable[Declared[Any]], state: Fields, make: Fields
) -> tuple[list[Declared[Any]], Fields, Fields, list[PluginError]]:
    """Return the kinds that go together, the fields of their state and of what is chosen, what is wrong with others.

    state, make : what all kinds have in common
    """
    kept, wrong = [], []
    for each in found:
        kind = each.value
        chosen = {**numbers_of(kind.options), **dict.fromkeys(kind.make, float)}
        chosen = {name: number for name, number in chosen.items() if name not in state or name in kind.state}
        known = {**state, **make}
        other = [name for name, number in {**chosen, **kind.state}.items() if known.get(name, number) is not number]
        moved = [name for name in kind.state if name in make] + [name for name in chosen if name in state]
        if other or moved:
            problem = f"{kind.name!r} has a field {(other + moved)[0]!r}, which is something else for other kinds"
            wrong.append(PluginError(each.package or "shoal", problem, "rename it, or uninstall the package"))
            continue
        state, make = {**state, **kind.state}, {**make, **chosen}
        kept.append(each)
    return kept, state, make, wrong


def dtype_of(fields: Mapping[str, type[Any]]) -> np.dtype[Any]:
    """A record of 64-bit numbers; nothing cannot be compiled, so it has an unused one."""
    return np.dtype(
        [(name, np.int64 if kind is int else np.float64) for name, kind in fields.items() or [("unused", float)]]
    )


def fill(record: Any, kind: Any, options: Any) -> None:
    """Write what is chosen of one into its record: its options, and what the kind works out from them."""
    words = words_of(kind.options)
    for name in numbers_of(kind.options):
        value = getattr(options, name)
        record[name] = words[name].index(value) if name in words else value or 0
    for name, work_out in kind.make.items():
        record[name] = work_out(options)


def refuse_wrong_fields(where: str, kind: Any, common: Iterable[str], shared: Iterable[str]) -> None:
    """Refuse fields of a kind that nobody could tell apart.

    Parameters
    ----------
    where : what errors call the kind
    common : fields that all kinds have; shared : those of them that an option may be

    Raises
    ------
    PluginError : a field has a name that all have, or is declared twice; one of the state is not a number
    """
    try:
        numbers = numbers_of(kind.options)
    except Exception as error:
        raise PluginError(where, f"its options cannot be read: {error}", "annotate each with a type") from error
    own = [*kind.state, *kind.make]
    taken = [name for name in own if name in common] or [name for name in numbers if name in {*common} - {*shared}]
    if taken:
        raise PluginError(where, f"{taken[0]!r} is a field that all have", "rename it")
    twice = [name for name in own if own.count(name) > 1 or name in numbers]
    if twice:
        raise PluginError(where, f"{twice[0]!r} is declared twice", "rename one")
    for name, kind_of in kind.state.items():
        if kind_of not in (int, float):
            raise PluginError(where, f"its state {name!r} is of type {kind_of!r}", "write float or int")


def refuse_wrong_arguments(where: str, functions: Mapping[str, tuple[Any, tuple[str, ...]]]) -> None:
    """Refuse functions that do not take what they are given: {role: (function or None, its arguments)}.

    Raises
    ------
    PluginError : one takes another number of arguments
    """
    for role, (function, arguments) in functions.items():
        if function is None:
            continue
        count = getattr(function, "py_func", function).__code__.co_argcount
        if count != len(arguments):
            problem = f"{role} takes {count} arguments"
            raise PluginError(where, problem, f"let it take ({', '.join(arguments)})")
