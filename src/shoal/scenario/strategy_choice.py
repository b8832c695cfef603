"""The [strategy] table of a scenario: a name and the parameters that this strategy has."""

from collections.abc import Hashable
from functools import cache
from typing import Annotated, Any, Literal, cast, get_type_hints

from pydantic import BaseModel, ConfigDict, Field, create_model
from pydantic import ValidationError as PydanticError
from pydantic_core import PydanticCustomError, core_schema

from shoal.core.units import Choice, Doc, Follows, Range, Unit
from shoal.scenario.scales import PAPER, Scales, followed
from shoal.strategies import CATALOGUE, Strategy
from shoal.strategies.installed import installed_names, load_all_installed
from shoal.strategies.plugins import find_strategy, load_strategies, source_of


class StrategyChoice:
    """Which strategy a scenario uses and its parameters, all filled in.

    Attributes
    ----------
    known : the strategy itself; name : what it is called
    file : the user's Python file that defines it, or None; source : hash of its text, or of an installed package's file
    params : {parameter: value}, words for choices
    defaults : {parameter: value} where nothing is said, in a scenario of these scales
    scales : of the scenario; the paper's until it is known
    """

    def __init__(
        self, owner: Strategy, file: str | None, source: str | None, said: dict[str, Any], scales: Scales = PAPER
    ) -> None:
        self.known: Strategy | None = owner
        self.name = owner.name
        self.file = file
        self.source = source
        self.scales = scales
        self.defaults = defaults_at(owner, scales)
        self.params = self.defaults | said
        self._open = frozenset(following(owner)) - said.keys()

    @property
    def owner(self) -> Strategy:
        """The strategy itself."""
        return cast(Strategy, self.known)

    @property
    def open(self) -> dict[str, Any]:
        """The parameters that are left to follow the scenario, with what they are in it."""
        return {key: each for key, each in self.params.items() if key in self._open and each == self.defaults[key]}

    def at(self, scales: Scales) -> "StrategyChoice":
        """Return the choice in a scenario of these scales: what was said stays, what was left open follows."""
        open = self.open
        said = {key: each for key, each in self.params.items() if key not in open}
        return StrategyChoice(self.owner, self.file, self.source, said, scales)

    def flat(self) -> dict[str, Any]:
        """The table as a scenario file spells it: without what is left to follow the scenario."""
        loaded, open = {"file": self.file, "source": self.source}, self.open
        said = {key: each for key, each in self.params.items() if key not in open}
        return {"name": self.name, **{key: text for key, text in loaded.items() if text}, **said}

    def choices(self) -> dict[str, Any]:
        """The table without the parameters that are at their defaults, said or not."""
        return {
            key: each for key, each in self.flat().items() if key not in self.defaults or each != self.defaults[key]
        }

    def kernel_params(self) -> Any:
        """The strategy's NamedTuple of parameters: words become their index, numbers the type of the default."""
        params: Any = self.owner.params
        hints = get_type_hints(params, include_extras=True)
        values = {}
        for field, value in self.params.items():
            words = _mark(hints[field], Choice)
            values[field] = words.words.index(value) if words else type(params._field_defaults[field])(value)
        return params(**values)

    @property
    def outdated(self) -> bool:
        """Whether its strategy, defined outside a file, has been redefined since, as in a notebook's cell run twice."""
        return self.file is None and CATALOGUE.get(self.name, self.owner) is not self.owner

    def __eq__(self, other: object) -> bool:
        return isinstance(other, StrategyChoice) and (self.flat(), self.params) == (other.flat(), other.params)

    def __hash__(self) -> int:
        return hash(tuple(sorted((key, str(value)) for key, value in self.flat().items())))

    def __repr__(self) -> str:
        return f"StrategyChoice({self.flat()})"

    def __deepcopy__(self, memo: dict[int, Any]) -> "StrategyChoice":
        twin = object.__new__(type(self))
        vars(twin).update(vars(self), params=dict(self.params))
        return twin

    def __reduce__(self) -> tuple[Any, ...]:
        return _revived, (self.flat(), self.scales)  # as a file would say it: compiled functions cannot travel

    @classmethod
    def validate(cls, value: Any) -> "StrategyChoice":
        """Return the choice that a table describes; see `load_strategies` for files and packages."""
        if isinstance(value, StrategyChoice):  # one that somebody may have changed since
            said = {key: each for key, each in value.params.items() if key not in value.open}
            return StrategyChoice(value.owner, value.file, value.source, _valid(value.owner, said), value.scales)
        if isinstance(value, str):
            value = {"name": value}
        if not isinstance(value, dict) or "name" not in value:
            raise PydanticCustomError("strategy", "a strategy is a table with a name, or just the name")
        table = dict(value)
        file, source = table.pop("file", None), table.pop("source", None)
        owner = find_strategy(str(table["name"]), source)
        if owner is None:
            known = ", ".join(sorted({*CATALOGUE, *installed_names()}))
            raise PydanticCustomError("strategy_name", "unknown strategy; there are: {known}", {"known": known})
        if file is None:
            source = source_of(owner)
        return cls(owner, file, source, _valid(owner, table))

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: Any) -> core_schema.CoreSchema:
        return core_schema.no_info_plain_validator_function(
            cls._validate_for_pydantic,
            serialization=core_schema.plain_serializer_function_ser_schema(
                lambda choice, info: choice.choices() if info.exclude_defaults else choice.flat(), info_arg=True
            ),
        )

    @classmethod
    def _validate_for_pydantic(cls, value: Any) -> "StrategyChoice":
        try:
            return cls.validate(value)
        except PydanticError as error:  # keep the path: pydantic only nests errors of its own schemas
            raise StrategyParamsError(error, value) from error

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: Any) -> dict[str, Any]:
        load_all_installed()
        known = [CATALOGUE[name] for name in sorted(CATALOGUE)]
        names = {"type": "string", "enum": [each.name for each in known]}
        from_file = {"type": "object", "properties": {"file": {"type": "string"}}, "required": ["file"]}
        return {"anyOf": [*(params_model(each).model_json_schema() for each in known), names, from_file]}


def _revived(table: dict[str, Any], scales: Scales) -> StrategyChoice:
    """The choice of a pickled table, its file or package loaded."""
    return StrategyChoice.validate(load_strategies(table)).at(scales)


class StrategyParamsError(Exception):
    """Carries pydantic's error about a parameter out of the scenario's own validation."""

    def __init__(self, error: PydanticError, table: Any) -> None:
        super().__init__(str(error))
        self.error = error
        self.table = table


def _valid(owner: Strategy, said: dict[str, Any]) -> dict[str, Any]:
    """What is said of the parameters of a strategy, valid."""
    filled = params_model(owner)(**said).model_dump(exclude={"name"})
    return {key: each for key, each in filled.items() if key in said}


def following(owner: Strategy) -> dict[str, Follows]:
    """The parameters of a strategy whose defaults follow a length of the scenario, and which one."""
    hints = get_type_hints(owner.params, include_extras=True)
    return {name: mark for name, hint in hints.items() if (mark := _mark(hint, Follows))}


def defaults_at(owner: Strategy, scales: Scales) -> dict[str, Any]:
    """Every parameter of a strategy where nothing is said, in a scenario of these scales."""
    hints = get_type_hints(owner.params, include_extras=True)
    values = {name: field.default for name, field in params_model(owner).model_fields.items() if name != "name"}
    return values | {
        name: followed(values[name], follows, _mark(hints[name], Unit).symbol, _mark(hints[name], Range), scales)
        for name, follows in following(owner).items()
    }


def params_model(owner: Strategy) -> type[BaseModel]:
    """Pydantic model of a strategy's parameters, made from its NamedTuple."""
    return _model_of(owner.name, cast(Hashable, owner.params))


@cache
def _model_of(name: str, key: Hashable) -> type[BaseModel]:
    params = cast(Any, key)
    hints = get_type_hints(params, include_extras=True)
    fields: dict[str, Any] = {"name": (Literal[name], name)}
    for field, default in params._field_defaults.items():
        choice, says = _mark(hints[field], Choice), _mark(hints[field], Doc)
        description = says.sentence if says else ""
        if choice:
            fields[field] = (Literal[choice.words], Field(default=choice.words[default], description=description))
        else:
            unit = _mark(hints[field], Unit)
            limits = _limits(_mark(hints[field], Range), type(default))
            kind: Any = Annotated[type(default), Field(strict=True, **limits)]
            kind = Annotated[kind, unit] if unit else kind
            follows = _mark(hints[field], Follows)
            also: Any = {"follows": list(follows.lengths)} if follows else None
            fields[field] = (kind, Field(default=default, description=description, json_schema_extra=also))
    config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)
    return create_model(f"{params.__name__}Table", __config__=config, __doc__=params.__doc__, **fields)


def _limits(allowed: Range | None, kind: type[Any]) -> dict[str, Any]:
    """What a number may be, in pydantic's words."""
    if allowed:
        return {"gt" if allowed.open else "ge": allowed.least, "le": allowed.most}
    return {"ge": -(2**53), "le": 2**53} if kind is int else {}


def _mark(hint: Any, kind: type[Any]) -> Any:
    """The first annotation of a kind on a type hint, or None."""
    return next((mark for mark in getattr(hint, "__metadata__", ()) if isinstance(mark, kind)), None)
