"""Entry kernels compiled for some strategies: kept on disk for our own, whose sources the cache knows, or made anew."""

from collections.abc import Callable, Sequence
from typing import Any

from shoal.compiler.kernel import uncached
from shoal.strategies.contract import Strategy

_ANEW: dict[Any, tuple[Callable[..., Any], ...]] = {}


def compiled_for(strategies: Sequence[Strategy], *entries: Callable[..., Any]) -> tuple[Callable[..., Any], ...]:
    """Return entry kernels for these strategies; of a user's, the same ones at every call of this process."""
    if all(each.builtin for each in strategies):
        return entries
    kind = (*entries, *(each.params for each in strategies))
    if kind not in _ANEW:
        _ANEW[kind] = tuple(map(uncached, entries))
    return _ANEW[kind]
