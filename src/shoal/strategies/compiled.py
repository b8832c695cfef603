"""Entry kernels compiled for some strategies, and kept on disk: a user's by a hash of all that they are made of."""

from collections.abc import Callable, Sequence
from typing import Any

from shoal.compiler.fingerprint import fingerprint
from shoal.compiler.kernel import twin
from shoal.strategies.contract import Strategy

_TWINS: dict[Any, tuple[Callable[..., Any], ...]] = {}


def compiled_for(strategies: Sequence[Strategy], *entries: Callable[..., Any]) -> tuple[Callable[..., Any], ...]:
    """Return entry kernels for these strategies; of a user's, the same ones at every call of this process."""
    if all(each.builtin for each in strategies):
        return entries
    kind = (*entries, *(each.params for each in strategies))
    if kind not in _TWINS:
        origin = made_of(strategies)
        _TWINS[kind] = tuple(twin(each, origin) for each in entries)
    return _TWINS[kind]


def made_of(strategies: Sequence[Strategy]) -> str | None:
    """A hash of what the compiler will see of those that are a user's; None if nobody can say, empty if none is."""
    own = [each for each in strategies if not each.builtin]
    functions = [
        function
        for each in own
        for function in (each.begin, each.leads, each.priority, each.influence, each.decide, each.params)
    ]
    facts = [(each.name, each.memory, each.told, each.sums._fields, each.ranked, each.informed) for each in own]
    return fingerprint(functions, *facts) if own else ""
