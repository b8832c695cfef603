"""From command-line options to a scenario's raw table; its parts are imported when they are used, not for a help."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from shoal.core.errors import ScenarioError

_MOST = {"runs": 1_000_000, "max_runs": 1_000_000, "jobs": 1024}


def edited_table(
    source: str, changes: Mapping[str, Any], assignments: Sequence[str], track: str | None, track_id: str | None
) -> dict[str, Any]:
    """Return the table of a preset or file changed by options, a track and assignments, which win over options."""
    from shoal.scenario.change import change
    from shoal.scenario.edit import parse_assignment, parse_value
    from shoal.scenario.load import read_table

    if track_id and not track:
        raise ScenarioError("--track-id", "needs --target-track", "name the file that holds the track")
    table = read_table(source)
    options = [(f"--{name}", name) for name, value in changes.items() if value is not None]
    check_asked(table, [*options, *as_options("--set", assignments)])
    wanted = {name: value for name, value in changes.items() if value is not None}
    for name in ("target-speed", "neighbors"):
        if isinstance(text := wanted.get(name), str):
            wanted[name] = parse_value(text)
    assigned = dict(parse_assignment(each) for each in assignments)
    followed = {"target_track": track, "track_id": track_id} if track else {}
    return change(table, wanted | followed | assigned)


def given_changes(assignments: Sequence[str] | None, **options: Any) -> dict[str, Any]:
    """Return the changes that --set asks for, and over them those options that are given."""
    from shoal.scenario.edit import parse_assignment

    changes: dict[str, Any] = dict(map(parse_assignment, assignments or []))
    return changes | {name: value for name, value in options.items() if value is not None}


def as_options(option: str, texts: Sequence[str]) -> list[tuple[str, str]]:
    """Options such as --set FIELD=..., as they are written and by their fields."""
    fields = [text.partition("=")[0].strip() for text in texts]
    return [(f"{option} {field}", field) for field in fields]


def check_asked(source: str | dict[str, Any], asked: Sequence[tuple[str, str]]) -> None:
    """Refuse two options that set the same field of a scenario, by whatever names."""
    from shoal.scenario.edit import refuse_contradictions
    from shoal.scenario.load import read_table

    refuse_contradictions(read_table(source) if isinstance(source, str) else source, asked)


def check_positive(**options: float | str | None) -> None:
    """Refuse options of 0 or less, and of more than can be; `max_runs` is --max-runs."""
    check_most(**options)
    for name, number in options.items():
        if number is None or isinstance(number, str):
            continue
        if number <= 0:
            raise ScenarioError(f"--{name.replace('_', '-')}", f"is {number}", "give a number above 0")


def check_most(**options: float | str | None) -> None:
    """Refuse more runs or threads than can be."""
    for name, number in options.items():
        most = _MOST.get(name, math.inf)
        if isinstance(number, (int, float)) and number > most:
            raise ScenarioError(f"--{name.replace('_', '-')}", f"is {number:,}", f"give {most:,} at most")
