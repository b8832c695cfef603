"""A scenario as a record tells it: of the right shape, but nothing that it names is loaded, opened or run."""

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, PlainValidator, PrivateAttr, SerializeAsAny, ValidationError
from pydantic_core import PydanticCustomError

from shoal.core.errors import StrategyError
from shoal.core.units import Meters, MetersPerSecond
from shoal.scenario.disturbances import DISTURBANCES, AnyDisturbance
from shoal.scenario.frozen import Frozen
from shoal.scenario.scales import PAPER, Scales
from shoal.scenario.schema import Fleet, Scenario
from shoal.scenario.strategy_choice import StrategyChoice, defaults_at, following
from shoal.scenario.targets import TARGETS
from shoal.strategies import Strategy
from shoal.strategies.plugins import known_strategy


class RecordedStrategy(StrategyChoice):
    """A strategy in the words of a record; its file or package may be another by now, or gone.

    Attributes
    ----------
    known : the strategy, where this process has that very one already; else None
    """

    def __init__(self, table: Mapping[str, Any], scales: Scales = PAPER) -> None:
        rest = dict(table)
        self.name, self.file, self.source = rest.pop("name"), rest.pop("file", None), rest.pop("source", None)
        self.known = known_strategy(self.name, self.source)
        self.scales = scales
        self.defaults = defaults_at(self.known, scales) if self.known else {}
        self._open = frozenset(following(self.known) if self.known else ()) - rest.keys()
        self.params = {key: each for key, each in self.defaults.items() if key in self._open} | rest

    @property
    def owner(self) -> Strategy:
        """The strategy itself.

        Raises
        ------
        StrategyError : this process has not loaded it
        """
        if self.known is None:
            problem = "is only known by the words of a record"
            raise StrategyError(f"strategy {self.name!r}", problem, "load its scenario: shoal.load(record.scenario)")
        return self.known

    def at(self, scales: Scales) -> "RecordedStrategy":
        """Return the choice in a scenario of these scales."""
        return RecordedStrategy(self.flat(), scales)

    def __reduce__(self) -> tuple[Any, ...]:
        return RecordedStrategy, (self.flat(), self.scales)

    @classmethod
    def validate(cls, value: Any) -> "RecordedStrategy":
        """Return the choice that a table tells."""
        if isinstance(value, cls):
            return value
        if not isinstance(value, dict) or not isinstance(value.get("name"), str):
            raise PydanticCustomError("strategy", "a strategy is a table with a name")
        return cls(value)


class RecordedFleet(Fleet):
    """A fleet as a record tells it. Names are text of any kind: whoever shows one shows it as text."""

    name: str
    strategy: RecordedStrategy | None = None


class RecordedTarget(Frozen):
    """A target of a kind that this Shoal does not know."""

    model_config = ConfigDict(extra="allow")

    kind: str
    radius: Meters
    speed: MetersPerSecond | None = None


class RecordedDisturbance(AnyDisturbance):
    """A disturbance of a kind that this Shoal does not know."""

    model_config = ConfigDict(extra="allow")


def _target(value: Any) -> Frozen:
    return _in_words(value, TARGETS, RecordedTarget)


def _disturbance(value: Any) -> Frozen:
    return _in_words(value, DISTURBANCES, RecordedDisturbance)


def _in_words(value: Any, known: Mapping[str, type[Frozen]], recorded: type[Frozen]) -> Frozen:
    """A target or a disturbance as a record tells it, without the fields that this Shoal does not know.

    One of a package that is not installed, or in another version, is what the record says.
    """
    if not isinstance(value, dict):
        raise PydanticCustomError("kind", "a target or a disturbance is a table with a kind")
    kind = known.get(str(value.get("kind")))
    source = kind.model_fields.get("source") if kind else None
    if kind is None or (source and value.get("source") != source.default):
        return recorded.model_validate(value)
    return kind.model_validate({name: each for name, each in value.items() if name in kind.model_fields})


class RecordedScenario(Scenario):
    """A scenario as a record tells it. `shoal.load`, and so whatever runs it, validates it in full."""

    name: str
    description: str = ""
    fleets: tuple[RecordedFleet, ...] = Field(min_length=1)
    strategy: RecordedStrategy
    targets: tuple[Annotated[SerializeAsAny[Any], PlainValidator(_target)], ...] = Field(min_length=1)
    disturbances: tuple[Annotated[SerializeAsAny[Any], PlainValidator(_disturbance)], ...] = ()

    _told_hash: str = PrivateAttr(default="")

    @property
    def hash(self) -> str:
        """The hash that its record tells: it may be of defaults that nobody here knows."""
        return self._told_hash or super().hash


def recorded_scenario(table: Mapping[str, Any], hash: str = "") -> RecordedScenario:
    """Return the scenario in a record's words, with the hash that it tells.

    Fields that this Shoal does not know are left out.

    Raises
    ------
    ValidationError : pydantic's, where it is not of the shape of a scenario
    """
    try:
        scenario = RecordedScenario.model_validate(table)
    except ValidationError as error:
        unknown = [each["loc"] for each in error.errors() if each["type"] == "extra_forbidden"]
        if not unknown:
            raise
        scenario = RecordedScenario.model_validate(_without(table, unknown))
    BaseModel.__setattr__(scenario, "_told_hash", hash)  # which a Frozen does not let anybody else do
    return scenario


def _without(part: Any, paths: list[tuple[Any, ...]]) -> Any:
    """A table or list without what is at some paths."""
    gone = {path[0] for path in paths if len(path) == 1}
    deeper = {path[0] for path in paths if len(path) > 1}

    def of(key: Any, value: Any) -> Any:
        return _without(value, [path[1:] for path in paths if path[0] == key]) if key in deeper else value

    if isinstance(part, Mapping):
        return {key: of(key, value) for key, value in part.items() if key not in gone}
    return [of(key, value) for key, value in enumerate(part)] if isinstance(part, (list, tuple)) else part
