"""Keywords of a function that are declared once, as a class: help() and notebooks list them as if written out."""

import inspect
from collections.abc import Callable, Mapping
from typing import Any, TypeVar, get_type_hints

Function = TypeVar("Function", bound=Callable[..., Any])
Options = TypeVar("Options", bound=tuple[Any, ...])


def lists_keywords(declared: type[Any], defaults: Mapping[str, Any] | None = None) -> Callable[[Function], Function]:
    """Show the fields of a class in the signature of a function that takes them as `**words`.

    Parameters
    ----------
    declared : a NamedTuple, of words beside others, or a TypedDict, of all words
    defaults : of a TypedDict; a NamedTuple has its own
    """
    others = hasattr(declared, "_fields")
    known: Mapping[str, Any] = declared._field_defaults if others else defaults or {}

    def mark(function: Function) -> Function:
        shown = inspect.signature(function)
        *written, words = shown.parameters.values()
        fields = [
            inspect.Parameter(
                name,
                inspect.Parameter.KEYWORD_ONLY,
                annotation=hint,
                default=known.get(name, inspect.Parameter.empty),
            )
            for name, hint in get_type_hints(declared).items()
        ]
        parameters = [*written, *fields, *([words] if others else [])]
        function.__signature__ = shown.replace(parameters=parameters)  # type: ignore[attr-defined]
        return function

    return mark


def split_keywords(declared: type[Options], words: Mapping[str, Any]) -> tuple[Options, dict[str, Any]]:
    """Return those words that are fields of a NamedTuple as one, and the others."""
    fields: tuple[str, ...] = declared._fields  # type: ignore[attr-defined]
    own = {name: value for name, value in words.items() if name in fields}
    return declared(**own), {name: value for name, value in words.items() if name not in fields}
