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
from typing import Any, Required, TypedDict, Unpack

from shoal.compiler.kernel import kernel
from shoal.core.errors import StrategyError, did_you_mean
from shoal.core.keywords import lists_keywords
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


def owner_of(params_class: type[Any]) -> Strategy:
    """Return the strategy whose parameters are of a class."""
    return _OWNERS[params_class]


def has_owner(params_class: type[Any]) -> bool:
    """Whether a class is that of some strategy's parameters."""
    return params_class in _OWNERS


def _register(known: Strategy) -> None:
    if known.name not in (TEAM, PUPPET, GUIDED):
        CATALOGUE[known.name] = known
    _OWNERS[known.params] = known
