"""The strategy contract: five small functions that see only what a buoy could know.

    begin(me, memory, params, draw)             once, at the start: set up the memory
    leads(other, params) -> bool                may this neighbor be followed?
    priority(me, other, params) -> float        of those that may, the lowest is followed
    influence(me, other, params) -> (x, y)      what one neighbor adds to the sums that I hear, as many as are named
    decide(me, heard, memory, params, draw) -> (vx, vy)     the velocity I want [m/s]

The shape is message passing: additive influences per linked pair, one leader, one decision per agent. It is what
lets one plain function serve the vectorized engine, a buoy that loops over its inbox, and a GPU thread.
"""

from collections import namedtuple
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any, Required, TypedDict, Unpack

from shoal.compiler.kernel import kernel, overload
from shoal.compiler.lanes import either, everywhere, put, take
from shoal.compiler.late import load
from shoal.core.errors import StrategyError, did_you_mean
from shoal.core.keywords import lists_keywords
from shoal.core.messages import Heard
from shoal.core.text import checked_name
from shoal.core.units import follows_in_vain
from shoal.strategies.rank import asks_for_rank


@dataclass(frozen=True)
class Strategy:
    """One way to decide: its functions (compiled), its parameters and what it remembers.

    Attributes
    ----------
    name : what scenarios call it
    params : NamedTuple class of its parameters, with units in their annotations
    memory : unit of each remembered field, by name
    told : the fields of memory that reports carry; they come first in memory
    sums : class of heard.sums, a NamedTuple with one number per sum
    ranked : whether influence or priority ask for other.rank
    informed : whether it is told the truth about targets, which no buoy could know
    hears_all : whether it is defined for all-to-all communication, whatever k is
    summary : first line of the docstring of `decide`
    reference : where it was published
    source : file it was defined in
    """

    name: str
    params: type[Any]
    memory: dict[str, str]
    told: tuple[str, ...]
    sums: type[Any]
    ranked: bool
    informed: bool
    hears_all: bool
    summary: str
    reference: str
    source: str
    builtin: bool
    begin: Callable[..., Any]
    leads: Callable[..., Any]
    priority: Callable[..., Any]
    influence: Callable[..., Any] | None
    decide: Callable[..., Any]


RESERVED = ("name", "file", "source")  # what else a [strategy] table says

# No scenario can ask for these, and no strategy of a user is called so.
TEAM = "(team)"  # its params hold other strategies' params; scenarios make it from fleets.strategy, see team.py
PUPPET = "(puppet)"  # wants what it is told from outside; the stand-in sea makes it of buoys, see puppet.py
GUIDED = "(guided)"  # the paper's, with what it is told from outside; environments make it, see guided.py
CATALOGUE: dict[str, Strategy] = {}  # by name; the last one registered under a name
_OWNERS: dict[type[Any], Strategy] = {}  # by class of parameters; all that were ever registered
ARGUMENTS = {  # of the functions of a strategy
    "decide": ("me", "heard", "memory", "params", "draw"),
    "begin": ("me", "memory", "params", "draw"),
    "leads": ("other", "params"),
    "priority": ("me", "other", "params"),
    "influence": ("me", "other", "params"),
}


class Declaration(TypedDict, total=False):
    """What `@strategy` takes besides the name, see there."""

    params: Required[type[Any]]
    memory: dict[str, str] | None
    tells: tuple[str, ...]
    sums: tuple[str, ...]
    informed: bool
    hears_all: bool
    reference: str
    begin: Callable[..., Any] | None
    leads: Callable[..., Any] | None
    priority: Callable[..., Any] | None
    influence: Callable[..., Any] | None


_TWO_SUMS = ("x", "y")
_DEFAULTS: dict[str, Any] = {
    "memory": None,
    "tells": (),
    "sums": _TWO_SUMS,
    "informed": False,
    "hears_all": False,
    "reference": "",
    "begin": None,
    "leads": None,
    "priority": None,
    "influence": None,
}


@lists_keywords(Declaration, _DEFAULTS)
def strategy(name: str, **declared: Unpack[Declaration]) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Register the decorated `decide` function as a strategy.

    Parameters
    ----------
    name : how scenarios call it
    params : NamedTuple class; every field has a default and, if it has a unit, an annotation such as shoal.Meters
    memory : {field: unit}; each agent remembers one number per field, `memory.field` reads and writes it
    tells : fields of the memory that go into every report, where neighbors read them as other.told.field
    sums : names of the numbers that `influence` returns, of which heard.sums.NAME is the sum over all neighbors;
        heard.sum_x, heard.sum_y are the first two
    informed : give `begin` and `decide` the truth about the nearest target, me.truth: for references, not for buoys
    hears_all : every agent hears every other, whatever network.neighbors says
    reference : where it was published
    begin : sets up the memory before the first step (default: zeros)
    leads, priority : who is followed (default: the nearest neighbor on target)
    influence : what each neighbor adds to the sums (default: nothing)

    Raises
    ------
    StrategyError : another keyword; params are missing, not a NamedTuple, another strategy's, or one has no default;
        a parameter follows that is no length or time; a field is told that is not remembered; sums are not names; a
        function takes other arguments, or asks for what it cannot know
    """

    where = f"strategy {name!r}"
    for word in declared:
        if word not in Declaration.__annotations__:
            known = list(Declaration.__annotations__)
            raise StrategyError(where, f"has no {word!r}", f"{did_you_mean(word, known)}there are: {', '.join(known)}")
    given: dict[str, Any] = {**_DEFAULTS, **declared}
    params: Any = given.get("params")
    memory, tells, sums = given["memory"] or {}, given["tells"], given["sums"]
    begin, leads, priority, influence = (given[role] for role in ("begin", "leads", "priority", "influence"))

    def register(decide: Callable[..., Any]) -> Callable[..., Any]:
        fields = getattr(params, "_fields", None)
        if fields is None:
            raise StrategyError(
                where, f"params={params!r} is not a NamedTuple class", "write class Params(NamedTuple): ..."
            )
        try:
            checked_name(name)
        except ValueError as error:
            raise StrategyError(where, str(error), "name it by words, such as my-search") from None
        bare = [field for field in fields if field not in params._field_defaults]
        if bare:
            raise StrategyError(where, f"parameter {bare[0]!r} has no default", f"write {bare[0]}: float = ...")
        if vain := follows_in_vain(params):
            fix = f"annotate it with shoal.Meters or shoal.Seconds, with a default such as {vain}: ... = 2.0"
            raise StrategyError(where, f"parameter {vain!r} follows, but is neither a length nor a time", fix)
        taken = [field for field in fields if field in RESERVED]
        if taken:
            raise StrategyError(where, f"parameter {taken[0]!r} is a word of the [strategy] table", "rename it")
        if params in _OWNERS:
            problem = f"params={params.__name__} belong to strategy {_OWNERS[params].name!r}"
            raise StrategyError(
                where, problem, "write a NamedTuple class of its own: the class decides whose functions run"
            )
        untold = [field for field in tells if field not in memory]
        if untold:
            raise StrategyError(where, f"tells {untold[0]!r}, which is not in memory", "add it to memory={...}")
        functions = {"decide": decide, "begin": begin, "leads": leads, "priority": priority, "influence": influence}
        for role, function in functions.items():
            if function and (count := _arguments(function)) != len(ARGUMENTS[role]):
                wanted = f"({', '.join(ARGUMENTS[role])})"
                raise StrategyError(where, f"{role} takes {count} arguments", f"let it take {wanted}")
        if influence is None and tuple(sums) != _TWO_SUMS:
            raise StrategyError(where, "names sums, but nothing adds to them", "give influence=...")
        if leads and "rank" not in fields and asks_for_rank(leads):
            problem = "leads asks for other.rank, but is asked once for all listeners"
            raise StrategyError(where, problem, "return math.inf from priority for neighbors not to follow")
        compiled = kernel(decide)
        plain: Any = getattr(decide, "py_func", decide)
        _register(
            Strategy(
                name=name,
                params=params,
                memory={field: memory[field] for field in (*tells, *memory)},
                told=tuple(tells),
                sums=_sums_class(where, sums),
                ranked=any(asks_for_rank(function) for function in (influence, priority) if function),
                informed=given["informed"],
                hears_all=given["hears_all"],
                summary=(plain.__doc__ or "").strip().split("\n")[0],
                reference=given["reference"],
                source=plain.__code__.co_filename,
                builtin=plain.__module__.startswith("shoal."),
                begin=kernel(begin) if begin else _keep_zeros,
                leads=kernel(leads) if leads else _is_on_target,
                priority=kernel(priority) if priority else _nearest_first,
                influence=kernel(influence) if influence else None,
                decide=compiled,
            )
        )
        return compiled

    return register


def _sums_class(where: str, names: Any) -> type[Any]:
    try:
        if isinstance(names, str):
            raise TypeError("is one word, not a tuple of names")
        return namedtuple("Sums", tuple(names))
    except (TypeError, ValueError) as error:
        raise StrategyError(where, f"sums={names!r}: {error}", 'write sums=("push_x", "push_y")') from None


def _arguments(function: Callable[..., Any]) -> int:
    plain: Any = getattr(function, "py_func", function)
    return int(plain.__code__.co_argcount)


@kernel
def _keep_zeros(me, memory, params, draw):
    """Start with an empty memory."""


@kernel
def _is_on_target(other, params):
    return other.on_target


@kernel
def _nearest_first(me, other, params):
    dx = me.x - other.x
    dy = me.y - other.y
    return dx * dx + dy * dy


# The engine calls these names; which strategy answers is decided by the type of `params`. Passing functions as
# arguments or closures would recompile the engine in every process; dispatching on a type is cached by numba.


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


# Loops over sums, unrolled: their number is known when a strategy is compiled.


@cache
def _clearing(count: int) -> Any:
    if count == 0:
        return kernel(lambda sums, i: None)
    before, last = _clearing(count - 1), count - 1

    def clear_all(sums, i):
        before(sums, i)
        sums[last, i] = 0.0

    return kernel(clear_all)


@cache
def _adding(count: int) -> Any:
    if count == 0:
        return kernel(lambda sums, i, values, linked: None)
    before, last = _adding(count - 1), count - 1

    def add_all(sums, i, values, linked):
        before(sums, i, values, linked)
        sums[last, i] += values[last] if linked else 0.0

    return kernel(add_all)


@cache
def _taking(count: int) -> Any:
    if count == 0:
        return kernel(lambda sums: ())
    before, last = _taking(count - 1), count - 1

    def take_all(sums):
        return (*before(sums), sums[last])

    return kernel(take_all)


@cache
def _zeros(count: int) -> Any:
    if count == 0:
        return kernel(lambda zero: ())
    before = _zeros(count - 1)
    return kernel(lambda zero: (*before(zero), zero))


@cache
def _plus(count: int) -> Any:
    if count == 0:
        return kernel(lambda totals, values, linked: ())
    before, last = _plus(count - 1), count - 1

    def add_all(totals, values, linked):
        return (*before(totals, values, linked), totals[last] + either(linked, values[last], 0.0))

    return kernel(add_all)


@cache
def _putting(count: int) -> Any:
    if count == 0:
        return kernel(lambda sums, i, totals: None)
    before, last = _putting(count - 1), count - 1

    def put_all(sums, i, totals):
        before(sums, i, totals)
        put(sums, (last, i), totals[last])

    return kernel(put_all)


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
    return [(part, kind) for part, kind in inside if kind in _OWNERS]


def owner_of(params_class: type[Any]) -> Strategy:
    """Return the strategy whose parameters are of a class."""
    return _OWNERS[params_class]


def _register(known: Strategy) -> None:
    if known.name not in (TEAM, PUPPET, GUIDED):
        CATALOGUE[known.name] = known
    _OWNERS[known.params] = known
