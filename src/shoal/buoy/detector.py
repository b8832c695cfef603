"""What says whether a target is there: a sensor process on the same computer, or a recorded target."""

import json
import math
import time
from collections.abc import Callable
from typing import Protocol

from shoal.buoy.connection import Datagrams, connect
from shoal.buoy.errors import BodyError
from shoal.core.errors import did_you_mean
from shoal.core.text import quoted
from shoal.scenario.briefing import fleet_of
from shoal.scenario.load import Source, load

KEPT = 2.0  # [s] a sensor that says nothing for longer sees nothing
LONGEST = 1000  # [bytes] of a message
KINDS = "none, udp:127.0.0.1:14600 (a sensor process), track (the recorded targets of the scenario)"


class Detector(Protocol):
    """Any function of a place that says whether a target is there."""

    def __call__(self, x: float, y: float) -> bool:
        """Whether the sensor of a buoy at this place [m] has a target now."""


def no_detector(x: float, y: float) -> bool:
    """No target is ever there."""
    return False


class SensorPort:
    """Listens to a sensor process, which says in a datagram of UDP: {"on_target": true, "age": 0.2}.

    `age`, 0 by default, is for how long that has been known [s]; other fields are for others. What is no such message
    is not heard. The newest counts, until it is KEPT seconds old.

    Parameters
    ----------
    address : udp:HOST:PORT to listen at
    clock : [s]

    Attributes
    ----------
    heard, refused : how many messages came, and how many that are none

    Raises
    ------
    BodyError : the address cannot be had
    """

    def __init__(self, address: str, clock: Callable[[], float] = time.monotonic) -> None:
        if not address.startswith("udp:"):
            raise BodyError("--sensor", f"{quoted(address)} is no address of a sensor", "write udp:127.0.0.1:14600")
        self._connection = connect(address)
        self._clock = clock
        self._known_at = -math.inf
        self._on_target = False
        self.heard = self.refused = 0

    @property
    def place(self) -> tuple[str, int]:
        """Where it listens: host and port."""
        assert isinstance(self._connection, Datagrams)
        return self._connection.place

    def __call__(self, x: float, y: float) -> bool:
        """Whether the sensor said so, not long ago."""
        now = self._clock()
        for data, _ in self._connection.receive():
            said = parsed(data)
            if said is None:
                self.refused += 1
                continue
            self.heard += 1
            on_target, age = said
            if now - age >= self._known_at:
                self._on_target, self._known_at = on_target, now - age
        return self._on_target and now - self._known_at <= KEPT

    def close(self) -> None:
        """Let go of the port."""
        self._connection.close()


def parsed(data: bytes) -> tuple[bool, float] | None:
    """Return whether a sensor has a target, and for how long that has been known [s]; None: it says neither."""
    if len(data) > LONGEST:
        return None
    try:
        said = json.loads(data)
    except (ValueError, RecursionError):
        return None
    if not isinstance(said, dict):
        return None
    on_target, age = said.get("on_target"), said.get("age", 0)
    if not isinstance(on_target, bool) or isinstance(age, bool) or not isinstance(age, (int, float)):
        return None
    return (on_target, float(age)) if 0 <= age <= 1e9 else None


class RecordedTargets:
    """The recorded targets of a scenario, seen as the simulator sees them: within the sensor's and their own radius.

    Parameters
    ----------
    scenario : with targets of kind "track"
    id : number of the agent
    elapsed : seconds since step 0

    Raises
    ------
    BodyError : there is no recorded target
    ScenarioError, TrackError : one cannot be used
    """

    def __init__(self, scenario: Source, id: int, elapsed: Callable[[], float]) -> None:
        from shoal.scenario.on_track import places_on_tracks  # and all readers of tracks with it

        scenario = load(scenario)
        self._radius = scenario.fleets[fleet_of(scenario, id)].sensor_radius
        self._places = places_on_tracks(scenario)
        self._elapsed = elapsed
        if not any(target.kind == "track" for target in scenario.targets):
            raise BodyError(
                "--sensor",
                "track needs a recorded target, and there is none",
                'give the scenario one: [[targets]] kind = "track"',
            )

    def __call__(self, x: float, y: float) -> bool:
        """Whether a recorded target is within reach."""
        there = self._places(self._elapsed())
        return any(math.hypot(x - at_x, y - at_y) <= self._radius + radius for at_x, at_y, radius in there)


def open_detector(text: str, scenario: Source, id: int, elapsed: Callable[[], float]) -> Detector:
    """Return the detector that a text names.

    Parameters
    ----------
    text : "none", "udp:HOST:PORT" where a sensor process sends to, or "track": the recorded targets of the scenario
    scenario : what the whole swarm is told
    id : number of the agent, 0 to N - 1
    elapsed : seconds since step 0

    Raises
    ------
    BodyError : no such kind, or it cannot be had
    ScenarioError, TrackError : a recorded target cannot be used
    """
    kind = text.partition(":")[0]
    if text == "none":
        return no_detector
    if kind == "udp":
        return SensorPort(text)
    if text == "track":
        return RecordedTargets(scenario, id, elapsed)
    fix = f"{did_you_mean(kind, ('none', 'udp', 'track'))}there are: {KINDS}"
    raise BodyError("--sensor", f"{quoted(text)} is no kind of sensor", fix)
