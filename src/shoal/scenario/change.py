"""Change a scenario's table in the words of the command line, a recorded track among them."""

from collections.abc import Mapping
from typing import Any

from shoal.core.errors import ScenarioError
from shoal.scenario.edit import ORIGIN, READING, Table, apply
from shoal.scenario.on_track import put_on_track, sign_tracks

TRACK = ("target_track", "track_id")
_DECIDED_BY_TRACK = ("steps", "time_step", "target_speed")


def change(table: Table, changes: Mapping[str, Any]) -> Table:
    """Return a changed copy: as `apply`, and `target_track` puts the scenario on a track before paths are set.

    Raises
    ------
    ScenarioError : a word or path that does not exist, or a value that has no place
    TrackError : the track cannot be used
    """
    wanted = {_word(name): value for name, value in changes.items()}
    track, track_id = (wanted.pop(name, None) for name in TRACK)
    if track_id is not None and track is None:
        raise ScenarioError("track_id", "needs target_track", "name the file that holds the track")
    if track is not None:
        late = {name: wanted.pop(name) for name in list(wanted) if "." in name or name in _DECIDED_BY_TRACK}
        return follow(table, wanted, late, str(track), track_id)
    return apply(table, wanted)


def follow(table: Table, early: Mapping[str, Any], late: Mapping[str, Any], track: str, track_id: str | None) -> Table:
    """Return the table changed early, put on a track, and changed late, its digest that of the track at last.

    What a late change says of how the track is read (targets.0.max_speed, ...) and where it lies counts for the
    arena around it, too.

    Raises
    ------
    ScenarioError : a word or path that does not exist, or a value that has no place
    TrackError : the track cannot be used
    """
    reading = {name: late[f"targets.0.{name}"] for name in READING if f"targets.0.{name}" in late}
    placed = {**early, **{name: late[name] for name in (ORIGIN,) if name in late}}
    return sign_tracks(apply(put_on_track(apply(table, placed), track, track_id, reading), late))


def _word(name: str) -> str:
    return name if "." in name else name.replace("-", "_")
