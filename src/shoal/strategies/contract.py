"""The strategy contract: four small functions that see only what a buoy could know.

    begin(me, memory, params, draw)             once, at the start: set up the memory
    leads(other, params) -> bool                may this neighbor be followed?
    priority(me, other, params) -> float        of those that may, the lowest is followed
    influence(me, other, params) -> (x, y)      what one neighbor adds to the sum that I hear
    decide(me, heard, memory, params, draw) -> (vx, vy)     the velocity I want [m/s]

The shape is message passing: an additive influence per linked pair, one leader, one decision per agent. It is what
lets one plain function serve the vectorized engine, a buoy that loops over its inbox, and a GPU thread.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from numba.extending import overload

from shoal.compiler.kernel import kernel
from shoal.core.errors import StrategyError


@dataclass(frozen=True)
class Strategy:
    """One way to decide: its functions (compiled), its parameters and what it remembers.

    Attributes
    ----------
    name : what scenarios call it
    params : NamedTuple class of its parameters, with units in their annotations
    memory : unit of each remembered field, by name
    told : the fields of memory that reports carry; they come first in memory
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

TEAM = "team"  # its params hold other strategies' params; scenarios make it from fleets.strategy, see team.py
CATALOGUE: dict[str, Strategy] = {}  # by name; the last one registered under a name
_OWNERS: dict[type[Any], Strategy] = {}  # by class of parameters; all that were ever registered
ARGUMENTS = {  # of the functions of a strategy
    "decide": ("me", "heard", "memory", "params", "draw"),
    "begin": ("me", "memory", "params", "draw"),
    "leads": ("other", "params"),
    "priority": ("me", "other", "params"),
    "influence": ("me", "other", "params"),
}


def strategy(
    name: str,
    *,
    params: type[Any],
    memory: dict[str, str] | None = None,
    tells: tuple[str, ...] = (),
    informed: bool = False,
    hears_all: bool = False,
    reference: str = "",
    begin: Callable[..., Any] | None = None,
    leads: Callable[..., Any] | None = None,
    priority: Callable[..., Any] | None = None,
    influence: Callable[..., Any] | None = None,
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Register the decorated `decide` function as a strategy.

    Parameters
    ----------
    name : how scenarios call it
    params : NamedTuple class; every field has a default and, if it has a unit, an annotation such as shoal.Meters
    memory : {field: unit}; each agent remembers one number per field, `memory.field` reads and writes it
    tells : fields of the memory that go into every report, where neighbors read them as other.told.field
    informed : give `begin` and `decide` the truth about the nearest target, me.truth: for references, not for buoys
    hears_all : every agent hears every other, whatever network.neighbors says
    reference : where it was published
    begin : sets up the memory before the first step (default: zeros)
    leads, priority : who is followed (default: the nearest neighbor on target)
    influence : what each neighbor adds to heard.sum_x, heard.sum_y (default: nothing)

    Raises
    ------
    StrategyError : params are no NamedTuple, belong to another strategy, or one has no default; a field is told that
        is not remembered; a function takes other arguments
    """

    def register(decide: Callable[..., Any]) -> Callable[..., Any]:
        where = f"strategy {name!r}"
        fields = getattr(params, "_fields", None)
        if fields is None:
            raise StrategyError(
                where, f"params={params!r} is no NamedTuple class", "write class Params(NamedTuple): ..."
            )
        bare = [field for field in fields if field not in params._field_defaults]
        if bare:
            raise StrategyError(where, f"parameter {bare[0]!r} has no default", f"write {bare[0]}: float = ...")
        taken = [field for field in fields if field in RESERVED]
        if taken:
            raise StrategyError(where, f"parameter {taken[0]!r} is a word of the [strategy] table", "rename it")
        if params in _OWNERS:
            problem = f"params={params.__name__} belong to strategy {_OWNERS[params].name!r}"
            raise StrategyError(
                where, problem, "write a NamedTuple class of its own: the class decides whose functions run"
            )
        untold = [field for field in tells if field not in (memory or {})]
        if untold:
            raise StrategyError(where, f"tells {untold[0]!r}, which is not in memory", "add it to memory={...}")
        given = {"decide": decide, "begin": begin, "leads": leads, "priority": priority, "influence": influence}
        for role, function in given.items():
            if function and (count := _arguments(function)) != len(ARGUMENTS[role]):
                wanted = f"({', '.join(ARGUMENTS[role])})"
                raise StrategyError(where, f"{role} takes {count} arguments", f"let it take {wanted}")
        remembered = dict(memory or {})
        compiled = kernel(decide)
        plain: Any = getattr(decide, "py_func", decide)
        _add(
            Strategy(
                name=name,
                params=params,
                memory={field: remembered[field] for field in (*tells, *remembered)},
                told=tuple(tells),
                informed=informed,
                hears_all=hears_all,
                summary=(plain.__doc__ or "").strip().split("\n")[0],
                reference=reference,
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


@kernel
def _no_influence(me, other, params):
    return 0.0, 0.0


# The engine calls these names; which strategy answers is decided by the type of `params`. Passing functions as
# arguments or closures would recompile the engine in every process; dispatching on a type is cached by numba.


def begin(me: Any, memory: Any, params: Any, draw: Any) -> None:
    """Let the strategy that owns this type of params set up a memory."""
    _owner(type(params)).begin(me, memory, params, draw)


def leads(other: Any, params: Any) -> Any:
    """Ask the owner of params whether a neighbor may lead."""
    return _owner(type(params)).leads(other, params)


def priority(me: Any, other: Any, params: Any) -> Any:
    """Ask the owner of params how low a neighbor ranks."""
    return _owner(type(params)).priority(me, other, params)


def influence(me: Any, other: Any, params: Any) -> Any:
    """Ask the owner of params what a neighbor adds to the sum."""
    return (_owner(type(params)).influence or _no_influence)(me, other, params)


def has_influence(params: Any) -> Any:
    """Whether the owner of params sums anything; a compile-time constant, so that nothing is summed in vain."""
    return _has(params, type(params), "influence")


def is_informed(params: Any) -> Any:
    """Whether the owner of params is told the truth; a compile-time constant, too."""
    return _has(params, type(params), "informed")


def decide(me: Any, heard: Any, memory: Any, params: Any, draw: Any) -> Any:
    """Ask the owner of params for the velocity wanted."""
    return _owner(type(params)).decide(me, heard, memory, params, draw)


@overload(begin, inline="always")
def _begin(me, memory, params, draw):
    chosen = _owner(params.instance_class).begin
    return lambda me, memory, params, draw: chosen(me, memory, params, draw)


@overload(leads, inline="always")
def _leads(other, params):
    chosen = _owner(params.instance_class).leads
    return lambda other, params: chosen(other, params)


@overload(priority, inline="always")
def _priority(me, other, params):
    chosen = _owner(params.instance_class).priority
    return lambda me, other, params: chosen(me, other, params)


@overload(influence, inline="always")
def _influence(me, other, params):
    chosen = _owner(params.instance_class).influence or _no_influence
    return lambda me, other, params: chosen(me, other, params)


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
    chosen = _owner(params.instance_class).decide
    return lambda me, heard, memory, params, draw: chosen(me, heard, memory, params, draw)


def _has(parts: Any, params_class: type[Any], trait: str) -> bool:
    """Whether the owner of params has a trait, or any params inside these (values or their types)."""
    owner = _owner(params_class)
    if owner.name != TEAM:
        return bool(getattr(owner, trait))
    inside = [(part, getattr(part, "instance_class", type(part))) for part in parts]
    return any(_has(getattr(part, "types", part), kind, trait) for part, kind in inside if kind in _OWNERS)


def _owner(params_class: type[Any]) -> Strategy:
    return _OWNERS[params_class]


def _add(known: Strategy) -> None:
    if known.name != TEAM:
        CATALOGUE[known.name] = known
    _OWNERS[known.params] = known
