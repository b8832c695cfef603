"""Changes to a scenario's raw table, before it is validated: what --fast, --set, sweeps and `with_` do."""

import math
import re
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from pathlib import Path
from typing import Any

from shoal.core.errors import ScenarioError, did_you_mean
from shoal.core.text import cut, quoted
from shoal.core.units import Unit
from shoal.scenario.frozen import plain
from shoal.scenario.schema import Scenario
from shoal.scenario.strategy_choice import StrategyChoice
from shoal.strategies.plugins import name_of

Table = dict[str, Any]

TRACK = ("target_track", "track_id")  # see change.py
ORIGIN = "area.origin"
READING = ("file", "id", "max_gap", "max_speed", "day_first")  # fields of a target: which fixes of a file are used


def apply(table: Table, changes: Mapping[str, Any]) -> Table:
    """Return a changed copy of a table; names are shorthands (see SHORTHANDS) or dotted paths like network.neighbors.

    Whole fields are set first, then shorthands, then paths into them, in whatever order they are given.

    Raises
    ------
    ScenarioError : a path that does not exist, or a shorthand that this scenario has no place for
    """
    changed: Table = plain(table)
    kept = _is_density_kept(changes)
    for name, value in sorted(changes.items(), key=_rank):
        key = name.replace("-", "_")
        if key == "density":
            continue
        if key == "agents" and kept:
            _set_agents_and_sides(changed, plain(value))
        elif key in SHORTHANDS:
            SHORTHANDS[key](changed, plain(value))
        elif "." in name:
            set_path(changed, name, plain(value))
        elif key in Scenario.model_fields:
            changed[key] = plain(value)
        else:
            check_words({name: value})
    emptied = {name.split(".")[0] for name, value in changes.items() if name.endswith(".count") and value == 0}
    for name in emptied & {"fleets", "losses", "joins"}:  # a count of 0 means no entry at all
        changed[name] = [each for each in changed[name] if not (isinstance(each, dict) and each.get("count") == 0)]
    _drop_digests(changed, changes)
    return changed


def check_words(changes: Mapping[str, Any], also: Iterable[str] = ()) -> None:
    """Refuse what is not a shorthand, field or path; `also` may have been meant.

    Raises
    ------
    ScenarioError : it names the nearest that there is, or all
    """
    for name, value in changes.items():
        key = name.replace("-", "_")
        known = list(dict.fromkeys([*SHORTHANDS, "density", *TRACK, *Scenario.model_fields, *also]))
        if "." not in name and key not in known:
            hint = did_you_mean(key, known).rstrip() or f"there are: {', '.join(known)}; or a path such as network.loss"
            raise ScenarioError(name, f"is not a field of a scenario (value {quoted(value)})", hint)


def _rank(change: tuple[str, Any]) -> int:
    """Which change comes first: what others count on."""
    name = change[0].replace("-", "_")
    return 3 if "." in name else 0 if name not in SHORTHANDS else 1 if name == "agents" else 2


def set_path(table: Table, path: str, value: Any) -> None:
    """Set a field by its dotted path; lists take an index or, for fleets, a name: fleets.BoB-1.count."""
    *parents, last = path.split(".")
    node: Any = table
    for at, part in enumerate(parents):
        where = ".".join(parents[: at + 1])
        if isinstance(node, list):
            node = node[_index(node, part, where)]
        elif not isinstance(node, dict):
            raise ScenarioError(path, f"{where!r} is not a field of a table", "correct the scenario first")
        elif part == "strategy" and isinstance(node.get(part), (str, StrategyChoice)):
            node[part] = node = _strategy_table(node[part])
        elif isinstance(node.get(part), (dict, list)):
            node = node[part]
        elif at == 0 and node.get(part) is None and part in ("area", "network", "motion", "strategy", "sea"):
            node[part] = node = {}
        else:
            hint = did_you_mean(part, node).rstrip() or f"there are: {', '.join(node)}"
            raise ScenarioError(path, f"the scenario has no {where!r}", hint)
    if not isinstance(node, dict):
        raise ScenarioError(path, "names a whole entry of a list", f"name a field of it: {path}.FIELD=VALUE")
    node[last] = value


def refuse_contradictions(table: Table, asked: Sequence[tuple[str, str]]) -> None:
    """Refuse that two options set one field of a table; each is given as the user wrote it, and by its name in `apply`.

    --agents and --fast go together: the first says how many, the second how many of them are fast.

    Raises
    ------
    ScenarioError : two of them set the same field
    """
    setters: dict[str, tuple[str, str]] = {}
    for option, name in asked:
        key = name.replace("-", "_")
        for field in _fields_of(table, name):
            first, other = setters.setdefault(field, (option, key))
            if (first, other) != (option, key) and {other, key} != {"agents", "fast"}:
                both = first if first == option else f"{first} and {option}"
                raise ScenarioError(both, f"set {field} twice", "leave out one of them")
        if asked.count((option, name)) > 1:
            raise ScenarioError(option, "is given twice", "leave out one of them")


def _fields_of(table: Table, name: str) -> list[str]:
    """The fields that a change sets, by their paths with numbers for the entries of lists."""
    key = name.replace("-", "_")
    if key == "neighbors":
        return ["network.neighbors"]
    if key == "strategy":
        return ["strategy.name"]
    if key in ("agents", "fast", "target_speed"):
        part, field = ("targets", "speed") if key == "target_speed" else ("fleets", "count")
        entries = table.get(part)
        return [f"{part}.{number}.{field}" for number in range(len(entries) if isinstance(entries, list) else 0)]
    parts = name.split(".")
    if len(parts) > 1 and isinstance(entries := table.get(parts[0]), list):
        with suppress(ScenarioError):
            parts[1] = str(_index(entries, parts[1], name))
    return ["strategy.name" if parts == ["strategy", "file"] else ".".join(parts)]


def parse_value(text: str) -> Any:
    """Read a value as TOML would (number, true, list, "text"), or null; anything else is text, such as 5 kn.

    Numbers are decimal ones: 1_000 and 0x10 are text, too.
    """
    if text == "null":
        return None
    try:
        value = tomllib.loads(f"value = {text}")["value"]
    except (ValueError, RecursionError):  # no TOML, or nothing that Python reads
        return text
    return text if isinstance(value, (int, float)) and re.search("[0-9]_|0[xob]", text) else value


def parse_assignment(text: str) -> tuple[str, Any]:
    """Split "path=value".

    Raises
    ------
    ScenarioError : there is no "="
    """
    path, equals, value = text.partition("=")
    if not equals or not re.fullmatch(r"[\w.\-]+", path.strip()):
        raise ScenarioError(
            f"--set {cut(text)}", "is not an assignment", "write path=value, such as network.neighbors=12"
        )
    return path.strip(), parse_value(value.strip())


def _drop_digests(table: Table, changes: Mapping[str, Any]) -> None:
    """What is read differently, a recorded track or the sea, is another one: the digest of the old one is void."""
    targets = table.get("targets")
    for n, target in enumerate(targets if isinstance(targets, list) else ()):
        if isinstance(target, dict) and "digest" in target and f"targets.{n}.digest" not in changes:
            reading = (ORIGIN, *(f"targets.{n}.{name}" for name in READING))
            if any(name in changes for name in reading):
                del target["digest"]
    sea = table.get("sea")
    window = ("sea", "area", "steps", "time_step", "target_track")
    if isinstance(sea, dict) and "sea.digest" not in changes and any(name.split(".")[0] in window for name in changes):
        sea.pop("digest", None)


def _set_neighbors(table: Table, value: Any) -> None:
    table.setdefault("network", {})["neighbors"] = value


def _set_fast(table: Table, value: Any) -> None:
    """So many agents of the fastest fleet, the rest of the slowest; the number of agents stays."""
    fast, slow = _fastest_and_slowest(table, "fast")
    both = fast["count"] + slow["count"]
    if not isinstance(value, int) or not 0 <= value <= both:
        raise ScenarioError("fast", f"is {quoted(value)}", f"give a number of agents from 0 to {both}")
    fast["count"], slow["count"] = value, both - value
    table["fleets"] = [fleet for fleet in table["fleets"] if fleet["count"] != 0]


def _set_agents(table: Table, value: Any) -> None:
    """So many agents in all, in the same shares of the fleets (largest remainders); k is lowered to fit."""
    if not isinstance(value, int) or value < 2:
        raise ScenarioError("agents", f"is {quoted(value)}", "give a number of agents, 2 or more")
    fleets = _fleets(table, "agents")
    agents = sum(fleet["count"] for fleet in fleets)
    exact = [Fraction(fleet["count"] * value, agents) for fleet in fleets]
    counts = [int(share) for share in exact]
    for f in sorted(range(len(fleets)), key=lambda f: counts[f] - exact[f])[: value - sum(counts)]:
        counts[f] += 1
    for fleet, count in zip(fleets, counts, strict=True):
        fleet["count"] = count
    table["fleets"] = [fleet for fleet in fleets if fleet["count"] > 0]
    lower_degrees(table, value)


def _is_density_kept(changes: Mapping[str, Any]) -> bool:
    """Whether the arena grows with the number of agents."""
    if "density" not in changes:
        return False
    if changes["density"] != "keep":
        raise ScenarioError("density", f"is {quoted(changes['density'])}", "write keep, or leave it out")
    if "agents" not in changes:
        raise ScenarioError("density", "is kept where there are more agents or fewer", "say how many: agents")
    return True


def _set_agents_and_sides(table: Table, value: Any) -> None:
    """So many agents in all, in an arena whose sides grow with the root of their number; strategies' lengths stay."""
    before = sum(fleet["count"] for fleet in _fleets(table, "density"))
    area = table.get("area")
    if not isinstance(area, dict) or area.get("origin") is not None:
        fix = "leave out density, or the origin of the area"
        raise ScenarioError("density", "an arena at a place on Earth has its size", fix)
    _set_agents(table, value)
    for side in ("width", "height"):
        with suppress(ValueError, TypeError):  # a side that is none is told of when the scenario is read
            area[side] = float(Unit("m").parse(area.get(side))) * math.sqrt(value / before)


def lower_degrees(table: Table, agents: int) -> None:
    """Lower every k of a table to the number of others: a scenario for 50 agents then runs with 5, too."""
    joins = table.get("joins")
    later = [each.get("count") for each in (joins if isinstance(joins, list) else ()) if isinstance(each, dict)]
    most = agents - 1 + sum(count for count in later if isinstance(count, int))
    network = table.get("network")
    adaptive = network.get("adaptive") if isinstance(network, dict) else None
    for part in (network, adaptive, *table["fleets"]):
        for name in ("neighbors", "fewest", "most") if isinstance(part, dict) else ():
            if isinstance(part.get(name), int):
                part[name] = min(part[name], most)


def _set_target_speed(table: Table, value: Any) -> None:
    targets = table.get("targets")
    moving = (
        [each for each in targets if isinstance(each, dict) and "speed" in each] if isinstance(targets, list) else []
    )
    if not moving:
        raise ScenarioError("target-speed", "no target of this scenario has a speed", "use a waypoint target")
    for target in moving:
        target["speed"] = value


def _set_strategy(table: Table, value: Any) -> None:
    """Another strategy with its defaults (the same one keeps its parameters), or a file that defines one.

    A name asks for the strategy that has it now: a hash of its source is dropped.
    """
    old, name = _strategy_table(table.get("strategy")), name_of(value)
    if isinstance(name, str) and (name.endswith(".py") or "/" in name):
        table["strategy"] = {"file": str(Path(name).resolve())}
    elif not isinstance(name, str):
        table["strategy"] = name
    elif old.get("name") == name:
        table["strategy"] = {key: kept for key, kept in old.items() if key != "source" or "file" in old}
    else:
        table["strategy"] = {"name": name}


def _strategy_table(choice: Any) -> Table:
    """The table of a strategy that is one, a loaded one or a name; an empty one of anything else."""
    if isinstance(choice, StrategyChoice):
        return choice.flat()
    return {"name": choice} if isinstance(choice, str) else choice if isinstance(choice, dict) else {}


SHORTHANDS: dict[str, Callable[[Table, Any], None]] = {
    "neighbors": _set_neighbors,
    "fast": _set_fast,
    "agents": _set_agents,
    "target_speed": _set_target_speed,
    "strategy": _set_strategy,
}


def _fastest_and_slowest(table: Table, option: str) -> tuple[Table, Table]:
    fleets = _fleets(table, option)
    try:
        fleets.sort(key=lambda fleet: float(Unit("m/s").parse(fleet["max_speed"])))
    except (KeyError, TypeError, ValueError):
        raise ScenarioError(option, "needs fleets, each with a max_speed", "see `shoal scenario oceans2020`") from None
    if len(fleets) < 2:
        raise ScenarioError(option, "this scenario has one make of agents only", "add a faster fleet to it")
    return fleets[-1], fleets[0]


def _fleets(table: Table, option: str) -> list[Table]:
    """The fleets of a table that may be wrong elsewhere."""
    fleets = table.get("fleets")
    known = [each for each in fleets if isinstance(each, dict)] if isinstance(fleets, list) else []
    counts = [each.get("count") for each in known]
    if not all(isinstance(count, int) and count >= 0 for count in counts) or not any(counts):
        raise ScenarioError(option, "needs fleets, each with a count", "see `shoal scenario oceans2020` for an example")
    return known


def _index(entries: list[Any], part: str, where: str) -> int:
    if re.fullmatch("[0-9]{1,9}", part) and int(part) < len(entries):
        return int(part)
    names = [str(each.get("name", n) if isinstance(each, dict) else n) for n, each in enumerate(entries)]
    if part in names:
        return names.index(part)
    raise ScenarioError(where, f"there is no entry {part!r}", f"there are: {', '.join(names)}")
