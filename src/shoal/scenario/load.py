"""TOML to Scenario; a wrong field is refused with file, line, field, value, reason and the nearest valid name."""

import io
import json
import re
import tomllib
from collections.abc import Mapping, Sequence
from importlib import resources
from os import PathLike
from pathlib import Path
from typing import Any

import tomli_w
from pydantic import ValidationError

from shoal.core.declared import is_offered
from shoal.core.errors import ScenarioError, StrategyError, did_you_mean
from shoal.core.text import cut, quoted
from shoal.scenario import disturbances, targets
from shoal.scenario.battery import Battery
from shoal.scenario.commands import Command
from shoal.scenario.disturbances import DISTURBANCES
from shoal.scenario.frozen import MOST_ENTRIES, plain
from shoal.scenario.network import AdaptiveDegree, Network
from shoal.scenario.presence import Join, Loss
from shoal.scenario.recorded import RecordedScenario, RecordedStrategy
from shoal.scenario.schema import Area, Fleet, Motion, Scenario
from shoal.scenario.sea import FILES, FLOWS, TAGS, Sea
from shoal.scenario.strategy_choice import StrategyChoice, StrategyParamsError, following, params_model
from shoal.scenario.targets import TARGETS
from shoal.strategies.plugins import find_strategy, load_strategies, meant_by

LARGEST = 10**6  # bytes of a scenario file
_DEPTH = "a scenario is four levels deep at most"
MOST_TOLD = 19  # problems of a scenario beside the first


def presets() -> list[str]:
    """Names of the scenarios that come with Shoal."""
    return sorted(file.name.removesuffix(".toml") for file in _preset_folder().iterdir() if file.name.endswith(".toml"))


Source = str | PathLike[str] | Mapping[str, Any] | Scenario  # what can be read as a scenario


def load(source: Source, /, **changes: Any) -> Scenario:
    """Return the scenario of a preset's name, a TOML file, a table or another scenario, changed, validated.

    >>> shoal.load("oceans2020", neighbors=10, fast=25, strategy="lattice")

    Parameters
    ----------
    source : "oceans2020" (see shoal.list_presets), "mine.toml", a dict with what a file would say, a Scenario
    changes : as in `Scenario.with_`

    Raises
    ------
    ScenarioError : no such preset or file, not TOML, not a scenario that can run, or a change that it has no place for
    TrackError, SeaError : the recorded track of `target_track`, or a file of the sea, cannot be used
    StrategyError : the strategy cannot be loaded, or was redefined since the scenario was made
    """
    table, where, text = table_of(source), name_of_source(source), ""
    if changes:
        from shoal.scenario.change import change  # which needs scenario_from

        table = change(table, changes)
    elif isinstance(source, (str, PathLike)):
        text = _text_of(source)
    scenario = scenario_from(table, where=where, text=text)
    _refuse_outdated(scenario)
    if scenario.sea and scenario.sea.files and scenario.sea.digest is None:
        from shoal.scenario.at_sea import signed  # which needs libraries that most scenarios do not

        return signed(scenario)
    return scenario


def table_of(source: Source) -> dict[str, Any]:
    """Return the raw table of what can be read as a scenario.

    Raises
    ------
    ScenarioError : it cannot
    """
    if isinstance(source, (str, PathLike)):
        return read_table(source)
    if not isinstance(source, (Scenario, Mapping)):
        names = ", ".join(presets())
        raise ScenarioError(
            "scenario", f"is {quoted(source)}", f"give a preset's name ({names}), a file, or a Scenario"
        )
    table: dict[str, Any] = source.model_dump() if isinstance(source, RecordedScenario) else plain(source)
    return table


def name_of_source(source: Source) -> str:
    """What errors call it."""
    return str(source) if isinstance(source, (str, PathLike)) else "scenario"


def _refuse_outdated(scenario: Scenario) -> None:
    choices = (scenario.strategy, *(fleet.strategy for fleet in scenario.fleets))
    for choice in choices:
        if choice and choice.outdated:
            raise StrategyError(
                f"strategy {choice.name!r}",
                "was redefined since this scenario was made",
                f'take the new one: scenario.with_(strategy="{choice.name}")',
            )


def read_table(source: str | PathLike[str]) -> dict[str, Any]:
    """Return the raw table of a preset's name or of a TOML file; files that it names become absolute paths."""
    table = raw_table(source)
    folder = Path(source).resolve().parent
    chosen, targets = table.get("strategy"), table.get("targets")
    fleets = table.get("fleets")
    own = [fleet.get("strategy") for fleet in (fleets if isinstance(fleets, list) else ()) if isinstance(fleet, dict)]
    for part in (chosen, *own, *(targets if isinstance(targets, list) else ())):
        if isinstance(part, dict) and isinstance(part.get("file"), str) and part["file"]:
            part["file"] = str(folder / part["file"])
    sea = table.get("sea")
    if isinstance(sea, dict):
        sea |= {name: str(folder / sea[name]) for name in FILES if isinstance(sea.get(name), str) and sea[name]}
    return table


def raw_table(source: str | PathLike[str]) -> dict[str, Any]:
    """Return what a preset or a TOML file says, as it stands."""
    text = _text_of(source)
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ScenarioError(str(source), f"is not valid TOML: {error}", "see https://toml.io for the syntax") from None
    except RecursionError:
        raise ScenarioError(str(source), "is nested too deeply", _DEPTH) from None
    except ValueError:  # Python reads no integer of more than 4,300 digits
        raise ScenarioError(str(source), "holds a number of thousands of digits", "write a shorter one") from None


def scenario_from(table: Mapping[str, Any], *, where: str = "scenario", text: str = "") -> Scenario:
    """Validate a raw table; `where` and `text` (its TOML) make errors say file and line.

    Raises
    ------
    ScenarioError : no table; unknown, missing or wrong fields
    StrategyError : the strategy's file or package cannot be loaded
    """
    if not isinstance(table, Mapping):
        fix = "give the table of a scenario; shoal.load reads one from a file or a preset"
        raise ScenarioError(where, f"{quoted(table)} is not a table of fields", fix)
    try:
        _refuse_crowds(table, where)
        written: dict[str, Any] = plain(table)
    except RecursionError:
        raise ScenarioError(where, "is nested too deeply", _DEPTH) from None
    if "strategy" in written:
        written["strategy"] = _loaded(written["strategy"])
    if isinstance(written.get("fleets"), list):
        written["fleets"] = [_with_own_strategy(fleet) for fleet in written["fleets"]]
    try:
        return Scenario.model_validate(written)
    except StrategyParamsError as error:
        problems = [((*_strategy_path(error.table, written), *each["loc"]), each) for each in error.error.errors()]
    except ValidationError as error:
        problems = [(each["loc"], each) for each in error.errors()]
    raise _as_scenario_error(problems, written, where, text)


def _refuse_crowds(part: Any, where: str, path: tuple[Any, ...] = ()) -> None:
    """Refuse a table or list with more entries than any scenario has, before each of them is an error of its own."""
    if not isinstance(part, (Mapping, list, tuple)):
        return
    if len(part) > MOST_ENTRIES:
        raise ScenarioError(
            f"{where} {_dotted(path)}".rstrip(), f"has {len(part):,} entries", f"write {MOST_ENTRIES:,} at most"
        )
    for key, each in part.items() if isinstance(part, Mapping) else enumerate(part):
        _refuse_crowds(each, where, (*path, key))


def _with_own_strategy(fleet: Any) -> Any:
    """A fleet's table, its strategy's file or package loaded."""
    if isinstance(fleet, Mapping) and fleet.get("strategy") is not None:
        return {**fleet, "strategy": _loaded(fleet["strategy"])}
    return fleet


def _loaded(choice: Any) -> Any:
    """A strategy's table, name or choice, its file or package loaded; one of a record loaded nothing yet."""
    return load_strategies(choice.flat() if isinstance(choice, RecordedStrategy) else choice)


def _strategy_path(wrong: Any, table: Mapping[str, Any]) -> tuple[Any, ...]:
    """Where in a scenario a wrong strategy table is."""
    for number, fleet in enumerate(table.get("fleets", ())):
        if isinstance(fleet, Mapping) and fleet.get("strategy") is not None and fleet["strategy"] == wrong:
            return ("fleets", number, "strategy")
    return ("strategy",)


def to_toml(scenario: Scenario) -> str:
    """Return the scenario as TOML that loads back to an equal scenario.

    Raises
    ------
    ScenarioError : it cannot run
    """
    known = load(scenario)
    text = tomli_w.dumps(_without_none(known.model_dump(mode="json")))
    choices = [known.strategy, *(fleet.strategy for fleet in known.fleets if fleet.strategy)]
    left = "".join(_left_open(choice) for choice in dict.fromkeys(choices) if choice.open)
    return f"{text}\n{_FOLLOW}{left}" if left else text


_FOLLOW = """\
# What is not written follows the scenario: the spacing of the agents, the reach of their sensors, the step of the
# fastest. Here that is as below; write it, and it no longer follows.
"""


def _left_open(choice: StrategyChoice) -> str:
    """The parameters that a strategy leaves to follow the scenario, as a comment."""
    follows = following(choice.owner)
    return f"#\n# strategy {choice.name}\n" + "".join(
        f"#     {name} = {value:.6g}  # {follows[name]}\n" for name, value in choice.open.items()
    )


def preset_text(name: str) -> str | None:
    """The file of a preset, comments and all; None if there is none of this name.

    A file beside it, which it names, is named by where it lies here: the text may be saved anywhere.
    """
    if name not in presets():
        return None
    text: str = (_preset_folder() / f"{name}.toml").read_text(encoding="utf-8")
    for file in _preset_folder().iterdir():
        text = text.replace(f'= "{file.name}"', f"= {json.dumps(Path(str(file)).as_posix())}")
    return text


def _text_of(source: str | PathLike[str]) -> str:
    preset = preset_text(str(source))
    if preset is not None:
        return preset
    try:
        with Path(source).open("rb") as stream:  # bounded: a device or a wrong file may never end
            content = stream.read(LARGEST + 1)
        if len(content) > LARGEST:
            raise ScenarioError(str(source), "is larger than 1 MB", "name a scenario's TOML file")
        return io.TextIOWrapper(io.BytesIO(content), encoding="utf-8-sig").read()
    except UnicodeDecodeError:
        raise ScenarioError(str(source), "is not a text file", "name a TOML file or a preset") from None
    except (OSError, ValueError) as error:  # ValueError: a null byte
        if isinstance(error, ScenarioError):
            raise
        hint = did_you_mean(str(source), presets())
        found = isinstance(error, OSError) and not isinstance(error, FileNotFoundError) and str(source)
        reason = str(getattr(error, "strerror", error)) if found else "no preset and no file of this name"
        raise ScenarioError(str(source) or "''", reason, f"{hint}presets: {', '.join(presets())}") from None


def _preset_folder() -> Any:
    return resources.files("shoal.scenario") / "presets"


def _as_scenario_error(
    problems: Sequence[tuple[tuple[Any, ...], Any]], table: Mapping[str, Any], where: str, text: str
) -> ScenarioError:
    """One error for all problems, the first in full."""
    # too_short follows from others in a tuple, literal_error of "all" comes with the error of the number
    real = [(loc, each) for loc, each in problems if each["type"] != "too_short" and loc[-1:] != ("literal['all']",)]
    real.sort(key=lambda problem: problem[1]["type"] != "extra_forbidden")  # a misspelt field explains a missing one
    (loc, first), *others = real or problems
    problem, fix = _explain(_path(loc), first, table)
    path = _path(loc) + _field_named_by(problem, _path(loc))
    line = _line_of(path, text)
    place = ":".join(str(part) for part in (where, line) if part)
    also = "".join(
        f"\n  also: {cut(_dotted(_path(loc)))}: {_explain(_path(loc), each, table)[0]}"
        for loc, each in others[:MOST_TOLD]
    )
    if len(others) > MOST_TOLD:
        also += f"\n  and {len(others) - MOST_TOLD:,} more"
    return ScenarioError(f"{place} {_dotted(path)}".rstrip(), problem + also, fix)


def _explain(path: tuple[Any, ...], error: Any, table: Mapping[str, Any]) -> tuple[str, str]:
    """The problem and the fix of one pydantic error."""
    value = error.get("input")
    known = _known_fields(path, table)
    if error["type"] == "extra_forbidden":
        hint = did_you_mean(str(path[-1]), known).rstrip() or f"its fields: {', '.join(known)}"
        return f"unknown field (value {quoted(value)})", hint
    if error["type"] == "missing":
        return "is required and missing", f"add {path[-1]} = ..."
    if error["type"] == "value_error":
        problem, _, fix = str(error["ctx"]["error"]).partition("; ")
        return problem, fix or "change the value"
    if error["type"] == "strategy_name":
        names = error["ctx"]["known"].split(", ")
        wrong = value.get("name") if isinstance(value, dict) else value
        hint = meant_by(str(wrong), names)
        return (
            f"no strategy is called {quoted(wrong)}",
            f'{hint}strategies: {", ".join(names)}; or file = "my_strategy.py"',
        )
    if error["type"] == "union_tag_invalid" and path[0] == "sea":
        kind = str(error["ctx"]["tag"])
        fix = f"{did_you_mean(kind, FLOWS)}name a file, or write {{kind = ...}}: {', '.join(FLOWS)}"
        return f"no flow is of kind {quoted(kind)}", fix
    if error["type"] == "union_tag_invalid":
        return _unknown_kind(str(error["ctx"]["tag"]), str(path[0]))
    if error["type"] == "union_tag_not_found":
        return f"a {str(path[0])[:-1]} needs a kind", f"add kind = one of: {', '.join(_DECLARED[str(path[0])])}"
    if isinstance(value, (dict, list, tuple)):
        return f"{error['msg'].lower()}", "see `shoal scenario oceans2020` for a complete example"
    return f"{quoted(value)}: {error['msg'].lower()}", "change the value"


_DECLARED = {"targets": TARGETS, "disturbances": DISTURBANCES}  # tables whose fields their kind decides
_PROBLEMS = {"targets": targets.PROBLEMS, "disturbances": disturbances.PROBLEMS}


def _unknown_kind(kind: str, where: str) -> tuple[str, str]:
    """The problem and the fix of a kind that is not there, perhaps because the package that offers it is broken."""
    what, known = where[:-1], _DECLARED[where]
    if wrong := _PROBLEMS[where] if is_offered(kind, f"shoal.{where}") else []:
        told = "; ".join(f"{each.args[0]}: {each.args[1]}" for each in wrong)
        return f"no {what} is of kind {quoted(kind)}, though it is installed: {told}", wrong[0].args[2]
    return f"no {what} is of kind {quoted(kind)}", f"{did_you_mean(kind, known)}kinds: {', '.join(known)}"


def _path(loc: Sequence[Any]) -> tuple[Any, ...]:
    """A pydantic location without the tags it adds for the kind of a target and for each way to spell a degree."""
    return tuple(
        part
        for at, part in enumerate(loc)
        if not (at == 2 and part in (TAGS if loc[0] == "sea" else _DECLARED.get(str(loc[0]), ())))
        and part not in ("constrained-int", "literal['all']")
    )


def _dotted(path: Sequence[Any]) -> str:
    return ".".join(str(part) for part in path)


def _known_fields(path: tuple[Any, ...], table: Mapping[str, Any]) -> list[str]:
    """Names that are valid beside the last part of a path."""
    models: dict[str, Any] = {"area": Area, "fleets": Fleet, "network": Network, "motion": Motion}
    models |= {"losses": Loss, "joins": Join, "commands": Command, "sea": Sea}
    if len(path) < 2:
        return list(Scenario.model_fields)
    if "strategy" in path[:-1]:
        chosen = _part_at(table, path[:-1])
        owner = find_strategy(str(chosen.get("name")), chosen.get("source"))
        return ["file", *params_model(owner).model_fields] if owner else ["file", "name"]
    if path[0] in _DECLARED:
        kind: Any = _DECLARED[path[0]].get(str(_part_at(table, path[:2]).get("kind")))
        return list(kind.model_fields) if kind else ["kind"]
    if path[0] == "fleets" and path[2:3] == ("battery",) and len(path) > 3:
        return list(Battery.model_fields)
    if path[:2] == ("network", "adaptive") and len(path) > 2:
        return list(AdaptiveDegree.model_fields)
    if path[0] == "sea" and len(path) > 2:
        flow = FLOWS.get(str(_part_at(table, path[:2]).get("kind")))
        return list(flow.model_fields) if flow else []  # type: ignore[attr-defined]
    return list(models[path[0]].model_fields) if path[0] in models else []


def _part_at(table: Any, path: tuple[Any, ...]) -> Mapping[str, Any]:
    """The table at a path; an empty one where there is none."""
    for part in path:
        try:
            table = table[part]
        except (KeyError, IndexError, TypeError):
            return {}
    return table if isinstance(table, Mapping) else {}


def _field_named_by(problem: str, path: tuple[Any, ...]) -> tuple[Any, ...]:
    """The field that a check of a whole table is about: it begins with its name, "network.neighbors is 60"."""
    match = re.match(r"([a-z_]+(?:\.[a-z_0-9]+)*) is ", problem)
    named = tuple(int(part) if part.isdigit() else part for part in match.group(1).split(".")) if match else ()
    return () if path and path[-1] in named else named


def _line_of(path: Sequence[Any], text: str) -> int | None:
    """Line of the TOML text where a path is set, or else the header of its table, if they are written plainly."""
    wanted = [part for part in path if isinstance(part, str)]
    index = next((part for part in path if isinstance(part, int)), None)
    header, count, near = "", {}, None  # type: ignore[var-annotated]
    for number, line in enumerate(text.splitlines(), 1):
        if match := re.match(r"\s*\[+\s*([\w.\-]+)\s*\]+", line):
            header = match.group(1)
            count[header] = count.get(header, -1) + 1
            if wanted and header.split(".") == wanted[: len(header.split("."))] and index in (None, count[header]):
                near = number
        elif match := re.match(r"\s*([\w.\-]+)\s*=", line):
            names = [*header.split("."), match.group(1)] if header else [match.group(1)]
            if names == wanted and (index is None or count.get(header) == index):
                return number
    return near


def _without_none(value: Any) -> Any:
    """TOML has no null: leave those fields out."""
    if isinstance(value, dict):
        return {key: _without_none(item) for key, item in value.items() if item is not None}
    return [_without_none(item) for item in value] if isinstance(value, list) else value
