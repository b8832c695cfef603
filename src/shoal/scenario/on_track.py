"""Put a scenario on a recorded track: the arena around it, the lengths with the arena, the speeds as they are."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from shoal.core.errors import ScenarioError, TrackError
from shoal.scenario.load import scenario_from
from shoal.scenario.scaled import multiplied
from shoal.scenario.schema import Scenario
from shoal.scenario.targets import Target
from shoal.tracks.read import read_track
from shoal.tracks.track import Track, position_at

ROOM = 1.25  # side of the arena over the track's longer extent: as waypoints in [-8, 8] of [-10, 10]
MOST_STEPS = 100_000  # of a run along the whole track; the time-step is the shortest that keeps to it
TIME_STEPS = tuple(digit * 10.0**power for power in range(-1, 5) for digit in (1, 2, 5))  # [s]


def put_on_track(
    table: dict[str, Any], file: str, track_id: str | None, options: Mapping[str, Any] | None = None
) -> dict[str, Any]:
    """Return the raw table of a scenario with a recorded track as its only target.

    If the scenario's area has no origin of its own, the area becomes the square around the track, and all lengths
    (margins, target radius, sensor radii, what it says of the strategy's) grow with its side. Speeds and numbers of
    agents stay.
    The time-step and the steps cover the whole track. `options` are fields of the target that say how to read it,
    such as max_speed; its digest is left to `sign_tracks`, when nothing more will change.

    Raises
    ------
    TrackError : the track cannot be used
    ScenarioError : the scenario is not valid
    """
    for text in filter(None, (file, track_id)):
        _check_text(text)
    scenario = scenario_from(table)
    target = {"kind": "track", "file": file, "radius": scenario.targets[0].radius} | dict(options or {})
    if track_id:
        target["id"] = track_id
    followed = scenario_from(scenario.model_dump(mode="json") | {"targets": [target]}).targets[0]
    track = open_track(followed, scenario.area.origin)
    factor = 1.0
    if scenario.area.origin is None:
        side = max(ROOM * max(np.ptp(track.x), np.ptp(track.y)), 1.0)
        factor = side / max(scenario.area.width, scenario.area.height)
    placed = multiplied(scenario, {"m": factor})
    if scenario.area.origin is None:
        placed["area"] |= {"width": side, "height": side, "origin": list(track.origin)}
    placed["targets"] = [target | {"radius": placed["targets"][0]["radius"]}]
    duration = float(track.time[-1])
    placed["time_step"] = next((dt for dt in TIME_STEPS if duration / dt <= MOST_STEPS), TIME_STEPS[-1])
    placed["steps"] = max(1, int(duration / placed["time_step"]))
    return placed


def sign_tracks(table: dict[str, Any]) -> dict[str, Any]:
    """Return the table with the digest of each recorded track, as it is read with the options that the table has.

    A digest that is already given stays, as does one of None, which demands nothing.

    Raises
    ------
    TrackError : a track cannot be used
    ScenarioError : the scenario is not valid
    """
    scenario = scenario_from(table)
    targets = [
        each | {"digest": open_track(target, scenario.area.origin).digest}
        if target.kind == "track" and "digest" not in each
        else each
        for each, target in zip(table["targets"], scenario.targets, strict=True)
    ]
    return table | {"targets": targets}


def open_tracks(scenario: Scenario) -> list[Track]:
    """Read the recorded tracks of a scenario, in the order of its targets.

    Raises
    ------
    TrackError : one cannot be used
    ScenarioError : one is not what the scenario was made with
    """
    return [open_track(target, scenario.area.origin) for target in scenario.targets if target.kind == "track"]


def open_track(target: Target, origin: tuple[float, float] | None) -> Track:
    """Read the track that a target follows, in local meters around `origin` (lon, lat) [deg].

    Raises
    ------
    TrackError : it cannot be used
    ScenarioError : it is not what the scenario was made with
    """
    track = read_track(
        target.file,
        track_id=target.id,
        origin=origin,
        max_gap=target.max_gap,
        max_speed=target.max_speed,
        day_first=target.day_first,
    )
    if target.digest not in (None, track.digest):
        raise ScenarioError(
            target.file, "does not hold the track that this scenario was made with", "restore it, or drop `digest`"
        )
    return track


def places_on_tracks(scenario: Scenario) -> Callable[[float], list[tuple[float, float, float]]]:
    """Return a function of the time since step 0 [s]: x, y and radius [m] of each recorded target that is there.

    Raises
    ------
    TrackError, ScenarioError : see open_tracks
    """
    radii = [target.radius for target in scenario.targets if target.kind == "track"]
    tracks = list(zip(open_tracks(scenario), radii, strict=True))

    def places(time: float) -> list[tuple[float, float, float]]:
        found = [(*position_at(track, time), radius) for track, radius in tracks]
        return [(float(x), float(y), radius) for x, y, present, radius in found if present]

    return places


def _check_text(text: str) -> None:
    """Refuse what the system's encoding could not read: its bytes are not text."""
    try:
        text.encode()
    except UnicodeEncodeError as error:
        shown = text.encode(errors="backslashreplace").decode()
        raise TrackError(
            shown, "is not text in the encoding of this terminal", "set PYTHONUTF8=1 or a UTF-8 locale, or rename it"
        ) from error
