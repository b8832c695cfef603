"""Put a scenario on a recorded track: the arena around it, the lengths with the arena, the speeds as they are."""

from typing import Any, get_args, get_type_hints

import numpy as np
from pydantic.fields import FieldInfo

from shoal.core.units import Unit
from shoal.scenario.load import scenario_from
from shoal.scenario.schema import Scenario
from shoal.scenario.tracks import read_track

ROOM = 1.25  # side of the arena over the track's longer extent: as waypoints in [-8, 8] of [-10, 10]
MOST_STEPS = 100_000  # of a run along the whole track; the time-step is the shortest that keeps to it
TIME_STEPS = tuple(digit * 10.0**power for power in range(-1, 5) for digit in (1, 2, 5))  # [s]


def put_on_track(table: dict[str, Any], file: str, track_id: str | None) -> dict[str, Any]:
    """Return the raw table of a scenario with a recorded track as its only target.

    If the scenario's area has no origin of its own, the area becomes the square around the track, and all lengths
    (margins, target radius, sensor radii, the strategy's) grow with its side. Speeds and numbers of agents stay.
    The time-step and the steps cover the whole track.

    Raises
    ------
    TrackError : the track cannot be used
    ScenarioError : the scenario is not valid
    """
    scenario = scenario_from(table)
    track = read_track(file, track_id=track_id, origin=scenario.area.origin)
    factor = 1.0
    if scenario.area.origin is None:
        side = max(ROOM * max(np.ptp(track.x), np.ptp(track.y)), 1.0)
        factor = side / max(scenario.area.width, scenario.area.height)
    placed = scale_lengths(scenario, factor)
    if scenario.area.origin is None:
        placed["area"] |= {"width": side, "height": side, "origin": list(track.origin)}
    placed["targets"] = [
        {
            "kind": "track",
            "file": file,
            "radius": placed["targets"][0]["radius"],
            "digest": track.digest,
        }
        | ({"id": track_id} if track_id else {})
    ]
    duration = float(track.time[-1])
    placed["time_step"] = next((dt for dt in TIME_STEPS if duration / dt <= MOST_STEPS), TIME_STEPS[-1])
    placed["steps"] = max(1, int(duration / placed["time_step"]))
    return placed


def scale_lengths(scenario: Scenario, factor: float) -> dict[str, Any]:
    """Return the table of a scenario with every length multiplied; times, speeds and counts stay."""
    table: dict[str, Any] = scenario.model_dump(mode="json")
    for model, part in (
        (scenario.area, table["area"]),
        (scenario.network, table["network"]),
        *zip(scenario.fleets, table["fleets"], strict=True),
        *zip(scenario.targets, table["targets"], strict=True),
    ):
        for name, field in type(model).model_fields.items():
            if _is_length(field) and part[name] is not None:
                part[name] *= factor
    own = [(fleet.strategy, part["strategy"]) for fleet, part in zip(scenario.fleets, table["fleets"], strict=True)]
    for choice, part in ((scenario.strategy, table["strategy"]), *own):
        hints = get_type_hints(choice.owner.params, include_extras=True) if choice else {}
        for name in choice.params if choice else ():
            if Unit("m") in getattr(hints[name], "__metadata__", ()):
                part[name] *= factor
    return table


def _is_length(field: FieldInfo) -> bool:
    """Whether a field is in m, or may be: Meters, or Meters | None."""
    choices = (getattr(each, "__metadata__", ()) for each in get_args(field.annotation))
    return any(Unit("m") in marks for marks in (field.metadata, *choices))
