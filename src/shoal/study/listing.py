"""What there is: strategies, metrics, presets, each list a table in a notebook."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, Protocol, TypeVar, overload

from shoal.core.errors import UnknownNameError
from shoal.core.sheet import Sheet
from shoal.metrics.summary import METRICS
from shoal.record.tables import data_frame
from shoal.scenario.load import presets, raw_table
from shoal.scenario.strategy_choice import params_model
from shoal.strategies import CATALOGUE, Strategy
from shoal.strategies.installed import load_all_installed

if TYPE_CHECKING:
    import pandas


class MetricInfo(NamedTuple):
    """A metric: its name, its unit, whether more or less of it is better, and what it is."""

    name: str
    unit: str
    direction: str
    sentence: str


class StrategyInfo(NamedTuple):
    """A strategy: its name, what it does, the defaults of its parameters, where it was published.

    knows_target : a reference, which no buoy could follow
    source : "Shoal", or the file or cell that defines it
    """

    name: str
    summary: str
    parameters: dict[str, Any]
    reference: str
    knows_target: bool
    source: str


class PresetInfo(NamedTuple):
    """A scenario that comes with Shoal."""

    name: str
    description: str


class _Named(Protocol):
    @property
    def name(self) -> str: ...

    def _asdict(self) -> dict[str, Any]: ...


T = TypeVar("T", bound=_Named)


class Listing(Sequence[T], Generic[T]):
    """A list of what there is: by number or by name; a notebook shows it as a table."""

    def __init__(self, what: str, entries: Sequence[T], columns: Sequence[str]) -> None:
        self._what = what
        self._entries = tuple(entries)
        self._columns = columns

    @property
    def names(self) -> list[str]:
        """Names of all."""
        return [each.name for each in self._entries]

    @overload
    def __getitem__(self, key: int | str) -> T: ...

    @overload
    def __getitem__(self, key: slice) -> "Listing[T]": ...

    def __getitem__(self, key: int | str | slice) -> "T | Listing[T]":
        """The entry of a number or a name."""
        if isinstance(key, slice):
            return Listing(self._what, self._entries[key], self._columns)
        if isinstance(key, int):
            return self._entries[key]
        if key not in self.names:
            raise UnknownNameError.of(self._what, key, self.names)
        return self._entries[self.names.index(key)]

    def __contains__(self, key: object) -> bool:
        return key in self.names or key in self._entries

    def __iter__(self) -> Iterator[T]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def to_pandas(self) -> "pandas.DataFrame":
        """Return the table (extra: sweep).

        Raises
        ------
        MissingExtraError : pandas is not installed
        """
        return data_frame([each._asdict() for each in self._entries], "a list as a DataFrame")

    def __repr__(self) -> str:
        return self._sheet().text()

    def _repr_html_(self) -> str:
        return self._sheet().html()

    def _sheet(self) -> Sheet:
        rows = [tuple(str(each._asdict()[name]) for name in self._columns) for each in self._entries]
        return Sheet("", self._columns, rows, words=self._columns)


def list_metrics() -> Listing[MetricInfo]:
    """Every metric with its unit, whether more or less is better, and one sentence."""
    words = {1: "more is better", -1: "less is better", 0: "neither"}
    found = [MetricInfo(each.name, each.unit, words[each.direction], each.sentence) for each in METRICS.values()]
    return Listing("metric", found, MetricInfo._fields)


def list_strategies() -> Listing[StrategyInfo]:
    """Every strategy that comes with Shoal or an installed package, or that was defined with @shoal.strategy."""
    load_all_installed()
    return Listing(
        "strategy", [_strategy(CATALOGUE[name]) for name in sorted(CATALOGUE)], ("name", "summary", "reference")
    )


def list_presets() -> Listing[PresetInfo]:
    """Every scenario that comes with Shoal."""
    found = [PresetInfo(name, raw_table(name)["description"]) for name in presets()]  # whose files stay closed
    return Listing("preset", found, PresetInfo._fields)


def _strategy(known: Strategy) -> StrategyInfo:
    return StrategyInfo(
        name=known.name,
        summary=known.summary,
        parameters=params_model(known)().model_dump(exclude={"name"}),
        reference=known.reference,
        knows_target=known.informed,
        source="Shoal" if known.builtin else known.source,
    )
