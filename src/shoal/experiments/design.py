"""A design: which scenarios a sweep runs, as a list of changes to one base scenario."""

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from shoal.core.errors import MissingExtraError, ScenarioError
from shoal.core.text import cut, quoted
from shoal.scenario.edit import parse_value
from shoal.scenario.load import Source, presets, raw_table

MOST_POINTS = 1_000_000  # combinations of a design

Point = dict[str, Any]  # {field: value}: shorthands (neighbors, fast, ...) and dotted paths, see scenario/edit.py


@dataclass(frozen=True)
class Design:
    """A base scenario (what shoal.load takes), the points at which it is changed, and the replicates of each."""

    scenario: Source
    points: tuple[Point, ...]
    runs: int

    @property
    def fields(self) -> list[str]:
        """Every field that varies, in order of first use."""
        return list(dict.fromkeys(name for point in self.points for name in point))


def grid(vary: Mapping[str, Sequence[Any]]) -> list[Point]:
    """Return every combination of values; the first field varies slowest.

    Raises
    ------
    ScenarioError : there are more than a million
    """
    if (count := math.prod(len(values) for values in vary.values())) > MOST_POINTS:
        raise ScenarioError(", ".join(vary), f"have {count:,} combinations", f"ask for {MOST_POINTS:,} at most")
    return [dict(zip(vary, values, strict=True)) for values in itertools.product(*vary.values())]


def together(vary: Mapping[str, Sequence[Any]]) -> list[Point]:
    """Return the first values of all fields, then the second of all, and so on.

    Raises
    ------
    ScenarioError : the fields do not have equally many values
    """
    counts = {name: len(values) for name, values in vary.items()}
    if len(set(counts.values())) > 1:
        counted = ", ".join(f"{name} {count}" for name, count in counts.items())
        raise ScenarioError("zip", f"fields have different numbers of values: {counted}", "give each the same number")
    return [dict(zip(vary, values, strict=True)) for values in zip(*vary.values(), strict=True)]


def latin_hypercube(vary: Mapping[str, Sequence[Any]], samples: int, seed: int) -> list[Point]:
    """Return `samples` points spread over the box of each field's first and last value (integers between two integers).

    McKay, Beckman, Conover, Technometrics 21 (1979), by scipy.stats.qmc.

    Raises
    ------
    MissingExtraError : scipy is absent
    """
    try:
        from scipy.stats import qmc
    except ImportError:
        raise MissingExtraError.of("scipy", "sweep", "a Latin hypercube design") from None
    unit = qmc.LatinHypercube(d=len(vary), rng=seed).random(samples)
    return [
        {
            name: _between(values[0], values[-1], float(share))
            for (name, values), share in zip(vary.items(), row, strict=True)
        }
        for row in unit
    ]


def parse_vary(text: str) -> tuple[str, list[Any]]:
    """Read "neighbors=10:49:3" (from, to, step; the end included) or "target-speed=3,5".

    Raises
    ------
    ScenarioError : it is neither
    """
    name, equals, values = text.partition("=")
    if not equals or not name.strip() or not values.strip():
        raise ScenarioError(f"--vary {text}", "is not a variation", "write field=1,2,3 or field=from:to:step")
    return name.strip().replace("-", "_") if "." not in name else name.strip(), parse_values(values, f"--vary {text}")


_FARTHEST = 1e18  # of a range: beyond all fields


def parse_values(text: str, where: str) -> list[Any]:
    """Read a list of values or a range."""
    parts = text.split(":")
    if 2 <= len(parts) <= 3 and all(type(parse_value(part)) in (int, float) for part in parts):
        start, stop, step = (*map(parse_value, parts), 1)[:3]
        if len(parts) == 2 and float in (type(start), type(stop)):
            fix = f"add a step, such as {text.strip()}:0.01, or let `shoal tune` search all values between the two"
            raise ScenarioError(where, f"the range {cut(text)} has decimal ends and no step", fix)
        if not all(-_FARTHEST <= number <= _FARTHEST for number in (start, stop, step)):
            raise ScenarioError(where, f"the range {cut(text)} has no end", "write numbers, such as 10:49:3")
        if step <= 0 or stop < start:
            fix = "write from:to:step with from <= to and step > 0"
            raise ScenarioError(where, f"the range {cut(text)} is empty", fix)
        count = math.floor(min((stop - start) / step, 1e18) + 1e-9) + 1
        if count > MOST_POINTS:
            raise ScenarioError(
                where, f"the range {cut(text)} has {count:,} values", f"ask for {MOST_POINTS:,} at most"
            )
        return [start + number * step for number in range(count)]
    return [parse_value(part.strip()) for part in text.split(",")]


def is_design_file(source: str) -> bool:
    """Whether a TOML file describes a sweep rather than a scenario."""
    if source in presets() or not source.endswith(".toml") or not Path(source).is_file():
        return False
    table = raw_table(source)
    return any(key in table for key in ("vary", "points"))


def read_design(source: str) -> Design:
    """Read a design file: scenario, runs, mode (grid, zip, latin-hypercube), [vary], [[points]], samples, seed.

    Raises
    ------
    ScenarioError : unknown fields or values
    """
    table = raw_table(source)
    unknown = set(table) - {"scenario", "runs", "mode", "vary", "points", "samples", "seed"}
    if unknown:
        known = "scenario, runs, mode, vary, points, samples, seed"
        raise ScenarioError(f"{source} {sorted(unknown)[0]}", "unknown field", f"fields of a design: {known}")
    if "scenario" not in table:
        raise ScenarioError(f"{source} scenario", "is required and missing", 'add scenario = "oceans2020"')
    vary = {
        name: value if isinstance(value, list) else parse_values(str(value), f"{source} vary.{name}")
        for name, value in _table(source, "vary", table.get("vary", {})).items()
    }
    if empty := next((name for name, values in vary.items() if not values), None):
        raise ScenarioError(f"{source} vary.{empty}", "has no values", "give it one or more, or leave it out")
    integers = {
        name: _integer(source, name, table.get(name, default))
        for name, default in (("runs", 5), ("samples", 10), ("seed", 1))
    }
    mode = table.get("mode", "grid")
    if mode == "grid":
        varied = grid(vary)
    elif mode == "zip":
        varied = together(vary)
    elif mode == "latin-hypercube":
        varied = latin_hypercube(vary, integers["samples"], integers["seed"])
    else:
        raise ScenarioError(f"{source} mode", f"is {quoted(mode)}", "choose grid, zip or latin-hypercube")
    given = table.get("points", [{}])
    listed = [_table(source, "points", each) for each in (given if isinstance(given, list) else [given])]
    if len(listed) * len(varied) > MOST_POINTS:
        count = f"{len(listed) * len(varied):,}"
        raise ScenarioError(source, f"has {count} combinations", f"ask for {MOST_POINTS:,} at most")
    points = [{**one, **other} for one in listed for other in varied]
    base = table["scenario"]
    if not isinstance(base, str) or not base:
        raise ScenarioError(f"{source} scenario", f"is {quoted(base)}", 'name a preset or a file, such as "oceans2020"')
    if base not in presets():
        base = str(Path(source).resolve().parent / base)
    return Design(base, tuple(points), integers["runs"])


def _table(source: str, name: str, value: Any) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise ScenarioError(f"{source} {name}", f"{quoted(value)} is not a table", f"write [{name}] and FIELD = VALUE")
    return value


def _integer(source: str, name: str, value: Any) -> int:
    least = 0 if name == "seed" else 1
    if type(value) is not int or not least <= value <= MOST_POINTS:
        raise ScenarioError(
            f"{source} {name}", f"is {quoted(value)}", f"give a whole number, {least} to {MOST_POINTS:,}"
        )
    return value


def _between(low: Any, high: Any, share: float) -> Any:
    if isinstance(low, int) and isinstance(high, int):
        return min(high, low + int(share * (high - low + 1)))
    return low + share * (high - low)
