"""Change a scenario's table in the words of the command line, a recorded track among them."""

from collections.abc import Mapping
from typing import Any

from shoal.core.errors import ScenarioError
from shoal.scenario.edit import Table, apply
from shoal.scenario.on_track import put_on_track

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
        table = put_on_track(apply(table, wanted), str(track), track_id)
        wanted = late
    return apply(table, wanted)


def _word(name: str) -> str:
    return name if "." in name else name.replace("-", "_")
