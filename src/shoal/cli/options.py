"""From command-line options to a scenario's raw table."""

from collections.abc import Mapping, Sequence
from typing import Any

from shoal.core.errors import ScenarioError
from shoal.scenario.change import follow
from shoal.scenario.edit import apply, parse_assignment, parse_value
from shoal.scenario.load import read_table


def edited_table(
    source: str, changes: Mapping[str, Any], assignments: Sequence[str], track: str | None, track_id: str | None
) -> dict[str, Any]:
    """Return the table of a preset or file with options applied in this order: changes, track, assignments."""
    if track_id and not track:
        raise ScenarioError("--track-id", "needs --target-track", "name the file that holds the track")
    table = read_table(source)
    assigned = dict(parse_assignment(each) for each in assignments)
    wanted = {name: value for name, value in changes.items() if value is not None}
    for name in ("target-speed", "neighbors"):
        if isinstance(text := wanted.get(name), str):
            wanted[name] = parse_value(text)
    if track:
        # what the track decides, an option overrides
        late: dict[str, Any] = {name: wanted.pop(name) for name in ("steps", "target-speed") if name in wanted}
        return follow(table, wanted, late | assigned, track, track_id)
    return apply(apply(table, wanted), assigned)


def given_changes(assignments: Sequence[str] | None, **options: Any) -> dict[str, Any]:
    """Return the changes that --set asks for, and over them those options that are given."""
    changes: dict[str, Any] = dict(map(parse_assignment, assignments or []))
    return changes | {name: value for name, value in options.items() if value is not None}


def check_positive(**options: float | None) -> None:
    """Refuse options of 0 or less; `max_runs` is --max-runs."""
    for name, number in options.items():
        if number is not None and number <= 0:
            raise ScenarioError(f"--{name.replace('_', '-')}", f"is {number}", "give a number above 0")
