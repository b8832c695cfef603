"""Weights: the parameters of a strategy that can be learned, and its file with others as defaults."""

import ast
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_type_hints

import numpy as np
import numpy.typing as npt

from shoal.core.errors import did_you_mean
from shoal.core.units import Choice, Range, Unit
from shoal.learn.errors import LearnError
from shoal.scenario.schema import Scenario
from shoal.scenario.strategy_choice import StrategyChoice


@dataclass(frozen=True)
class Weight:
    """One number that is learned.

    Attributes
    ----------
    name : of the parameter
    start : what it is in the scenario before it learns; declared : what the file says
    low, high : it stays between
    """

    name: str
    start: float
    declared: float
    low: float
    high: float

    @property
    def scale(self) -> float:
        """0.3 of the weight itself; of one that may have any sign, or is 0, of 1 at least."""
        own = 0.3 * abs(self.start)
        return own if self.low >= 0.0 and self.start else max(0.3, own)

    def default(self, value: float) -> float:
        """What the file says where it is `value` in the scenario: defaults that follow it are said for the paper's."""
        return value if self.start == self.declared or not self.start else self.declared * (value / self.start)


def weights_of(scenario: Scenario, names: Sequence[str] = ()) -> list[Weight]:
    """Return the weights of a scenario's strategy: those named, or all of its parameters that are no whole numbers.

    Raises
    ------
    LearnError : it has none, or none of a name
    """
    choice = scenario.strategy
    hints = get_type_hints(choice.owner.params, include_extras=True)
    declared = choice.owner.params._field_defaults
    known = [name for name, value in declared.items() if isinstance(value, float) and not _mark(hints[name], Choice)]
    for name in names:
        if name not in known:
            fix = f"{did_you_mean(name, known)}there are: {', '.join(known) or 'none'}"
            raise LearnError(f"strategy {choice.name!r}", f"has no weight {name!r}", fix)
    if len(names or known) < 2:
        problem = f"has {len(names or known)} parameters that are numbers with decimals to learn"
        fix = "write its weights as parameters, two or more, such as gain: float = 1.0; or vary more of them"
        raise LearnError(f"strategy {choice.name!r}", problem, fix)
    weights = []
    for name in known:
        if not names or name in names:
            limits = _mark(hints[name], Range) or Range(-math.inf, math.inf)
            least = limits.least + (1e-9 if limits.open else 0.0)
            start = float(choice.params[name])
            sized = _has_unit(hints[name])  # a length or a time is above 0, and not a thousand times what it was
            low = max(least, 0.01 * start) if sized and start > 0 else least
            high = min(limits.most, 100.0 * start) if sized and start > 0 else limits.most
            weights.append(Weight(name, start, float(declared[name]), low, high))
    return weights


def trial(scenario: Scenario, weights: Sequence[Weight], values: Iterable[float]) -> Scenario:
    """The scenario with other weights of its strategy; nothing is compiled anew for it."""
    old: StrategyChoice = scenario.strategy
    said = {weight.name: float(value) for weight, value in zip(weights, values, strict=True)}
    changed = StrategyChoice(old.owner, old.file, old.source, {**old.params, **said}, old.scales)
    return scenario.model_copy(update={"strategy": changed})


def bounds_of(weights: Sequence[Weight]) -> npt.NDArray[np.float64]:
    """How far each weight may go from its start, in its scale, (W, 2)."""
    return np.array([[(w.low - w.start) / w.scale, (w.high - w.start) / w.scale] for w in weights])


def rewritten(text: str, owner: Any, name: str, weights: Sequence[Weight], values: Iterable[float]) -> str:
    """Return the text of a strategy's file with these weights as defaults, and the strategy called `name`.

    Raises
    ------
    LearnError : defaults or name are not written as plain numbers and text where they are declared
    """
    tree = ast.parse(text)
    wanted = {w.name: repr(float(w.default(float(value)))) for w, value in zip(weights, values, strict=True)}
    places: list[tuple[ast.expr, str]] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef) and node.name == owner.params.__name__:
            for field in node.body:
                if isinstance(field, ast.AnnAssign) and field.value and (called := ast.unparse(field.target)) in wanted:
                    places.append((field.value, wanted.pop(called)))
        elif isinstance(node, ast.Call) and _names_strategy(node, owner.name):
            places.append((node.args[0], f'"{name}"'))
    renamed = any(new == f'"{name}"' for _, new in places)
    if wanted or not renamed:
        what = f"weight {next(iter(wanted))!r}" if wanted else "its name"
        fix = "declare it there: a NamedTuple with defaults, and @shoal.strategy with the name as text"
        raise LearnError(owner.source, f"does not declare {what} in plain sight", fix)
    return _replaced(text, places)


def _names_strategy(call: ast.Call, name: str) -> bool:
    """Whether a call is that of @strategy with this name."""
    first = call.args[0] if call.args else None
    named = isinstance(first, ast.Constant) and first.value == name
    return named and ast.unparse(call.func).split(".")[-1] == "strategy"


def source_text(choice: StrategyChoice) -> str:
    """The text of the file that defines a strategy: the one named, for files of the same text are loaded once.

    Raises
    ------
    LearnError : there is no such file, as of a notebook's cell
    """
    file = choice.file or choice.owner.source
    try:
        return Path(file).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise LearnError(file, f"cannot be read: {error}", "write the strategy into a file") from None


def _replaced(text: str, places: list[tuple[ast.expr, str]]) -> str:
    """The text with other expressions at these places; columns of the syntax tree count bytes."""
    lines = [line.encode() for line in text.splitlines(keepends=True)]
    for node, new in sorted(places, key=lambda place: (place[0].lineno, place[0].col_offset), reverse=True):
        last_line, last = node.end_lineno or node.lineno, node.end_col_offset or node.col_offset
        after = lines[last_line - 1][last:]
        lines[node.lineno - 1 : last_line] = [lines[node.lineno - 1][: node.col_offset] + new.encode() + after]
    return b"".join(lines).decode()


def _mark(hint: Any, kind: type[Any]) -> Any:
    return next((mark for mark in getattr(hint, "__metadata__", ()) if isinstance(mark, kind)), None)


def _has_unit(hint: Any) -> bool:
    mark = _mark(hint, Unit)
    return mark is not None and mark.symbol != "1"
