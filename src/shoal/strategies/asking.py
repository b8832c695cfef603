"""How kernels ask a strategy: the engine calls these names, and the type of `params` decides which strategy answers.

Passing functions as arguments or closures would recompile the engine in every process; dispatching on a type is cached
by numba.
"""

from functools import cache
from typing import Any

from shoal.compiler.kernel import kernel, overload
from shoal.compiler.lanes import either, everywhere, put, take
from shoal.compiler.late import load
from shoal.core.errors import StrategyError
from shoal.core.messages import Heard
from shoal.strategies.contract import TEAM, Strategy, has_owner, owner_of


def begin(me: Any, memory: Any, params: Any, draw: Any) -> None:
    """Let the strategy that owns this type of params set up a memory."""
    owner_of(type(params)).begin(me, memory, params, draw)


def leads(other: Any, params: Any) -> Any:
    """Ask the owner of params whether a neighbor may lead."""
    return owner_of(type(params)).leads(other, params)


def priority(me: Any, other: Any, params: Any) -> Any:
    """Ask the owner of params how low a neighbor ranks."""
    return owner_of(type(params)).priority(me, other, params)


def influence(me: Any, other: Any, params: Any) -> Any:
    """Ask the owner of params what a neighbor adds to each of its sums."""
    owner = owner_of(type(params))
    if owner.influence is None:
        return (0.0,) * len(owner.sums._fields)
    return counted(owner.influence(me, other, params), params)


def counted(values: Any, params: Any) -> Any:
    """What an influence returned as a tuple with a number per sum; that of a team is filled up with zeros."""
    owner = owner_of(type(params))
    if owner.name == TEAM:
        return (*values, *(0.0,) * (_width(params, type(params)) - len(values)))
    values = values if isinstance(values, tuple) else (values,)
    if problem := _miscounted(owner, len(values)):
        raise StrategyError(owner.source, problem, _COUNT_THEM)
    return values


def clear(sums: Any, i: int, params: Any) -> None:
    """Set the sums of listener i (S, L) to zero."""
    sums[: _width(params, type(params)), i] = 0.0


def add(sums: Any, i: int, values: Any, linked: bool) -> None:
    """Add to the sums of listener i (S, L) what a neighbor exerts, if it is linked."""
    for number, value in enumerate(values):
        sums[number, i] += value if linked else 0.0


def no_sums(zero: Any, params: Any) -> Any:
    """Zeros, one for each sum of the owner of params."""
    return (zero,) * _width(params, type(params))


def added(totals: Any, values: Any, linked: Any) -> Any:
    """The totals with what a neighbor exerts, where it is linked; all of lanes."""
    return tuple(total + either(linked, value, 0.0) for total, value in zip(totals, values, strict=True))


def put_sums(sums: Any, i: Any, totals: Any) -> None:
    """Write totals into the sums of the listeners from i on, (S, L)."""
    for number, total in enumerate(totals):
        put(sums, (number, i), total)


def ranks_of(rank: Any, j: Any, i: Any, params: Any) -> Any:
    """As `rank_of`, with the listeners from i on, as lanes."""
    return take(rank, (j, i), everywhere(0)) if _has(params, type(params), "ranked") else None


def rank_of(rank: Any, j: int, i: int, params: Any) -> Any:
    """The rank of speaker j with listener i, None if the owner of params does not ask for ranks."""
    return rank[j, i] if _has(params, type(params), "ranked") else None


def has_influence(params: Any) -> Any:
    """Whether the owner of params sums anything; a compile-time constant, so that no sum is wasted."""
    return _has(params, type(params), "influence")


def is_informed(params: Any) -> Any:
    """Whether the owner of params is told the truth; a compile-time constant, too."""
    return _has(params, type(params), "informed")


def decide(me: Any, heard: Any, memory: Any, params: Any, draw: Any) -> Any:
    """Ask the owner of params for the velocity wanted; heard.sums has its sums in their order, and maybe more."""
    owner = owner_of(type(params))
    if owner.name != TEAM:
        sums = owner.sums(*heard.sums[: len(owner.sums._fields)])
        heard = heard._replace(sum_x=heard.sums[0], sum_y=heard.sums[1], sums=sums)
    return owner.decide(me, heard, memory, params, draw)


@overload(begin, inline="always")
def _begin(me, memory, params, draw):
    chosen = owner_of(params.instance_class).begin
    return lambda me, memory, params, draw: chosen(me, memory, params, draw)


@overload(leads, inline="always")
def _leads(other, params):
    chosen = owner_of(params.instance_class).leads
    return lambda other, params: chosen(other, params)


@overload(priority, inline="always")
def _priority(me, other, params):
    chosen = owner_of(params.instance_class).priority
    return lambda me, other, params: chosen(me, other, params)


@overload(influence, inline="always")
def _influence(me, other, params):
    owner = owner_of(params.instance_class)
    chosen, zeros = owner.influence, (0.0,) * len(owner.sums._fields)
    if chosen is None:
        return lambda me, other, params: zeros
    return lambda me, other, params: counted(chosen(me, other, params), params)


@overload(counted, inline="always")
def _counted(values, params):
    owner = owner_of(params.instance_class)
    count = getattr(values, "count", 1)  # a tuple has one
    if owner.name != TEAM:
        if problem := _miscounted(owner, count):
            raise load().core.errors.TypingError(f"{problem}; {_COUNT_THEM}")
        return (lambda values, params: values) if hasattr(values, "count") else (lambda values, params: (values,))
    zeros = (0.0,) * (_width(params.types, params.instance_class) - count)
    return lambda values, params: values + zeros


@overload(clear, inline="always")
def _clear(sums, i, params):
    cleared = _clearing(_width(params.types, params.instance_class))
    return lambda sums, i, params: cleared(sums, i)


@overload(add, inline="always")
def _add(sums, i, values, linked):
    added = _adding(values.count)
    return lambda sums, i, values, linked: added(sums, i, values, linked)


@overload(no_sums, inline="always")
def _no_sums(zero, params):
    made = _zeros(_width(params.types, params.instance_class))
    return lambda zero, params: made(zero)


@overload(added, inline="always")
def _added(totals, values, linked):
    made = _plus(totals.count)
    return lambda totals, values, linked: made(totals, values, linked)


@overload(put_sums, inline="always")
def _put_sums(sums, i, totals):
    made = _putting(totals.count)
    return lambda sums, i, totals: made(sums, i, totals)


@overload(ranks_of, inline="always")
def _ranks_of(rank, j, i, params):
    if _has(params.types, params.instance_class, "ranked"):
        return lambda rank, j, i, params: take(rank, (j, i), everywhere(0))
    return lambda rank, j, i, params: None


@overload(rank_of, inline="always")
def _rank_of(rank, j, i, params):
    if _has(params.types, params.instance_class, "ranked"):
        return lambda rank, j, i, params: rank[j, i]
    return lambda rank, j, i, params: None


@overload(has_influence, inline="always")
def _has_influence(params):
    if _has(params.types, params.instance_class, "influence"):
        return lambda params: True
    return lambda params: False


@overload(is_informed, inline="always")
def _is_informed(params):
    if _has(params.types, params.instance_class, "informed"):
        return lambda params: True
    return lambda params: False


@overload(decide, inline="always")
def _decide(me, heard, memory, params, draw):
    owner = owner_of(params.instance_class)
    chosen, named, taken = owner.decide, owner.sums, _taking(len(owner.sums._fields))
    if owner.name == TEAM:
        return lambda me, heard, memory, params, draw: chosen(me, heard, memory, params, draw)

    def decide_by_name(me, heard, memory, params, draw):
        by_name = Heard(  # here and not in a function: numba lets none return what holds a record
            heard.found,
            heard.x,
            heard.y,
            heard.vx,
            heard.vy,
            heard.on_target,
            heard.sums[0],
            heard.sums[1],
            heard.neighbors,
            heard.told,
            named(*taken(heard.sums)),
        )
        return chosen(me, by_name, memory, params, draw)

    return decide_by_name


# Loops over sums, unrolled: their number is known when a strategy is compiled. By halves: one within the other, fifty
# would be deeper than Python lets the compiler go.


@cache
def _clearing(count: int, first: int = 0) -> Any:
    if count < 2:
        return kernel(_clear_one(first) if count else lambda sums, i: None)
    half = count // 2
    before, after = _clearing(half, first), _clearing(count - half, first + half)

    def clear_all(sums, i):
        before(sums, i)
        after(sums, i)

    return kernel(clear_all)


def _clear_one(number: int) -> Any:
    def clear_one(sums, i):
        sums[number, i] = 0.0

    return clear_one


@cache
def _adding(count: int, first: int = 0) -> Any:
    if count < 2:
        return kernel(_add_one(first) if count else lambda sums, i, values, linked: None)
    half = count // 2
    before, after = _adding(half, first), _adding(count - half, first + half)

    def add_all(sums, i, values, linked):
        before(sums, i, values, linked)
        after(sums, i, values, linked)

    return kernel(add_all)


def _add_one(number: int) -> Any:
    def add_one(sums, i, values, linked):
        sums[number, i] += values[number] if linked else 0.0

    return add_one


@cache
def _taking(count: int, first: int = 0) -> Any:
    if count < 2:
        return kernel((lambda sums: (sums[first],)) if count else lambda sums: ())
    half = count // 2
    before, after = _taking(half, first), _taking(count - half, first + half)
    return kernel(lambda sums: (*before(sums), *after(sums)))


@cache
def _zeros(count: int) -> Any:
    if count < 2:
        return kernel((lambda zero: (zero,)) if count else lambda zero: ())
    before, after = _zeros(count // 2), _zeros(count - count // 2)
    return kernel(lambda zero: (*before(zero), *after(zero)))


@cache
def _plus(count: int, first: int = 0) -> Any:
    if count < 2:
        return kernel(_plus_one(first) if count else lambda totals, values, linked: ())
    half = count // 2
    before, after = _plus(half, first), _plus(count - half, first + half)
    return kernel(lambda totals, values, linked: (*before(totals, values, linked), *after(totals, values, linked)))


def _plus_one(number: int) -> Any:
    return lambda totals, values, linked: (totals[number] + either(linked, values[number], 0.0),)


@cache
def _putting(count: int, first: int = 0) -> Any:
    if count < 2:
        return kernel(_put_one(first) if count else lambda sums, i, totals: None)
    half = count // 2
    before, after = _putting(half, first), _putting(count - half, first + half)

    def put_all(sums, i, totals):
        before(sums, i, totals)
        after(sums, i, totals)

    return kernel(put_all)


def _put_one(number: int) -> Any:
    return lambda sums, i, totals: put(sums, (number, i), totals[number])


_COUNT_THEM = "return as many numbers as sums=(...) names, which are x and y if it names none"


def _miscounted(owner: Strategy, count: int) -> str:
    """What is wrong with an influence that returns `count` numbers; empty if that is the number of sums."""
    names = owner.sums._fields
    return "" if count == len(names) else f"influence returns {count} numbers, but the sums are {', '.join(names)}"


def _width(parts: Any, params_class: type[Any]) -> int:
    """How many sums the owner of params has, or the one with most of them in a team (values or their types)."""
    owner = owner_of(params_class)
    if owner.name != TEAM:
        return len(owner.sums._fields)
    return max(_width(getattr(part, "types", part), kind) for part, kind in _inside(parts))


def _has(parts: Any, params_class: type[Any], trait: str) -> bool:
    """Whether the owner of params has a trait, or any params inside these (values or their types)."""
    owner = owner_of(params_class)
    if owner.name != TEAM:
        return bool(getattr(owner, trait))
    return any(_has(getattr(part, "types", part), kind, trait) for part, kind in _inside(parts))


def _inside(parts: Any) -> list[tuple[Any, type[Any]]]:
    """The params inside those of a team, with their classes."""
    inside = [(part, getattr(part, "instance_class", type(part))) for part in parts]
    return [(part, kind) for part, kind in inside if has_owner(kind)]
