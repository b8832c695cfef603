"""A rover or boat that ArduPilot steers, as the body of a buoy: when it is steered, and when it is not."""

import math
import threading
import time
from collections.abc import Callable

from shoal.buoy.connection import connect
from shoal.buoy.detector import Detector, no_detector
from shoal.buoy.errors import BodyError, UnreadyError
from shoal.buoy.fence import Fence, fence_of, kept_inside
from shoal.buoy.ground import frame_of, in_frame, over_ground
from shoal.buoy.mavlink import GUIDED, HOLD, MODES, Mavlink
from shoal.buoy.vehicle import Problem, Vehicle
from shoal.core.geodesy import Frame
from shoal.core.messages import Reading
from shoal.core.text import quoted
from shoal.scenario.schema import Scenario

REPEAT, BEAT = 0.2, 1.0  # [s] between two set-points, and two heartbeats or requests
HORIZON = 3.0  # [s] for which a vehicle that hears no more goes on: ArduPilot's GUID_TIMEOUT
BRAKING = 2.0  # [s] for which it is told to lie still; told nothing more, a boat of ArduPilot's keeps its place
PATIENCE = 30.0  # [s] to wait for each thing that a vehicle is asked for at the start
PARTING = 2.0  # [s] to wait for HOLD at the end, and to be disarmed
ASTRAY = 10.0  # [m] outside the fence, in small arenas: farther out it is brought back by people


class MavlinkBody:
    """A rover or boat on a MAVLink connection.

    It is steered only while its mode is GUIDED and it is armed. Who switches to another mode has it: nothing is sent
    until it is in GUIDED again, which is never asked for after `begin`. It is stopped when nobody calls `go` for
    `silence` seconds, when its heartbeat is lost, when its position is too old, and when it is far outside the fence:
    for BRAKING seconds it is told to lie still, then nothing. Somebody must call `tick` every REPEAT seconds; `beat`
    does it in a thread.

    Parameters
    ----------
    vehicle : what it says, and words to it
    frame : local meters of the arena
    fence : where it may be, and its top speed
    detector : what says whether a target is there
    silence : [s] without a command after which it is stopped
    clock : [s], never goes back
    wait : lets some seconds pass

    Attributes
    ----------
    silences : how often it was stopped because nobody told it anything
    """

    def __init__(
        self,
        vehicle: Vehicle,
        frame: Frame,
        fence: Fence,
        *,
        detector: Detector = no_detector,
        silence: float = 3.0,
        clock: Callable[[], float] = time.monotonic,
        wait: Callable[[float], None] = time.sleep,
    ) -> None:
        self.vehicle = vehicle
        self._frame = frame
        self._fence = fence
        self._detector = detector
        self._silence = silence
        self._clock = clock
        self._wait = wait
        self._wanted: tuple[float, float] | None = None
        self._told_at = self._moved_at = self._steered_at = self._greeted_at = self._asked_at = -math.inf
        self._lock = threading.RLock()
        self._closed = threading.Event()
        self._thread: threading.Thread | None = None
        self._armed_it = False
        self.silences = 0

    def begin(self, *, arm: bool = False) -> str:
        """Wait for the vehicle and its position, ask for GUIDED, and to be armed; return what it is.

        Parameters
        ----------
        arm : let its motors turn; else a person does

        Raises
        ------
        BodyError : it is not heard, is no rover or boat, does not know where it is, is far away, or does not obey
        """
        vehicle = self.vehicle
        self._until(lambda now: None if vehicle.stranger else vehicle.unheard(now))
        if vehicle.heartbeat is None:
            assert vehicle.stranger is not None
            problem = f"has a {vehicle.stranger.words}; only rovers and boats of ArduPilot are steered"
            raise BodyError(vehicle.name, problem, "name the address of one, or its system, such as #3 at the end")
        self._until(vehicle.nowhere)
        trouble = self._trouble(self._clock())
        if trouble:
            raise BodyError(vehicle.name, *trouble)
        self._until(vehicle.not_guided, lambda: vehicle.ask_mode(GUIDED))
        if arm:
            self._armed_it = not vehicle.armed
            self._until(vehicle.not_armed, vehicle.ask_to_arm)
        return vehicle.heartbeat.words

    def read(self) -> Reading:
        """Where it is and how it moves over ground, by its autopilot, and whether the detector has a target.

        Raises
        ------
        UnreadyError : it is not heard, its position is too old, or it is far outside the fence
        """
        with self._lock:
            trouble = self._trouble(self.tick())
            if trouble:
                raise UnreadyError(self.vehicle.name, *trouble)
            x, y, vx, vy = self._moving()
            return Reading(x, y, vx, vy, bool(self._detector(x, y)))

    def go(self, vx: float, vy: float) -> None:
        """Go with this velocity over ground until told otherwise, as far as the fence permits.

        Parameters
        ----------
        vx, vy : [m/s] in the arena's frame

        Raises
        ------
        BodyError : the velocity is not finite; it is stopped
        UnreadyError : it is not steered now: see `read`; or it is not armed, or a person has it
        """
        with self._lock:
            if not (math.isfinite(vx) and math.isfinite(vy)):
                self.stop()
                raise BodyError("velocity", f"({vx}, {vy}) is not finite", "say it in m/s; the vehicle was stopped")
            self._wanted, self._told_at = (float(vx), float(vy)), self._clock()
            self._steered_at = -math.inf  # at once
            now = self.tick()
            trouble = self._trouble(now) or self._hands_off(now)
            if trouble:
                raise UnreadyError(self.vehicle.name, *trouble)

    def stop(self) -> None:
        """Stop, until the next `go`."""
        with self._lock:
            self._wanted = None
            self._steered_at = -math.inf
            self.tick()

    def close(self) -> None:
        """Stop, ask for HOLD, disarm what `begin` armed, and let go; a vehicle that a person has is left alone."""
        with self._lock:
            if self._closed.is_set():
                return
            self.stop()
            vehicle, ours = self.vehicle, not self._hands_off(self._clock())
            self._part(lambda now: not self._hands_off(now), lambda: vehicle.ask_mode(HOLD))
            if ours and self._armed_it and vehicle.mode == MODES[HOLD]:
                self._part(lambda now: vehicle.armed, vehicle.ask_to_disarm)
            self._closed.set()
            self.vehicle.close()
        if self._thread is not None:
            self._thread.join()

    def _part(self, still: Callable[[float], bool], ask: Callable[[], None]) -> None:
        """Ask for something while it is not so, for PARTING seconds at most."""
        now = self._clock()
        end = now + PARTING
        while now < end and not self.vehicle.unheard(now) and still(now):
            ask()
            self._wait(REPEAT / 2)
            now = self.tick()

    def beat(self) -> None:
        """Call `tick` in a thread from now on, until it is closed."""
        self._thread = threading.Thread(target=self._beat, name=f"shoal {self.vehicle.name}", daemon=True)
        self._thread.start()

    def _beat(self) -> None:
        while not self._closed.wait(REPEAT / 2):
            self.tick()

    def tick(self) -> float:
        """Listen, and say what is due: heartbeats, set-points. Return when that was [s]."""
        with self._lock:
            now = self._clock()
            if self._closed.is_set():
                return now
            self.vehicle.listen(now)
            if now - self._greeted_at >= BEAT:
                self._greeted_at = now
                self.vehicle.greet()
            if self.vehicle.age(now) > BEAT and now - self._asked_at >= BEAT:
                self._asked_at = now
                self.vehicle.ask_positions(REPEAT)
            if now - self._steered_at >= REPEAT:
                self._steer(now)
            return now

    def _steer(self, now: float) -> None:
        """Say a set-point, where the vehicle is ours."""
        if self._wanted is not None and now - self._told_at > self._silence:
            self._wanted = None
            self.silences += 1
        if self._hands_off(now):
            self._wanted = None
            return
        self._steered_at = now
        if self._wanted is None or self._trouble(now):
            if now - self._moved_at <= BRAKING:
                self.vehicle.steer(0.0, 0.0)
            return
        self._moved_at = now
        x, y, _, _ = self._moving()
        gone = self._fence.top_speed * self.vehicle.age(now)
        told = kept_inside(self._fence, x, y, *self._wanted, HORIZON, gone)
        assert self.vehicle.fix is not None
        self.vehicle.steer(*over_ground(self._frame, self.vehicle.fix, *told))

    def _trouble(self, now: float) -> Problem | None:
        """Why the vehicle cannot be steered safely now, and what to do; None if it can."""
        trouble = self.vehicle.unheard(now) or self.vehicle.nowhere(now)
        if trouble:
            return trouble
        x, y, _, _ = self._moving()
        outside = self._fence.outside(x, y)
        if outside <= max(ASTRAY, 0.5 * max(self._fence.half_x, self._fence.half_y)):
            return None
        return f"is at {x:.0f}, {y:.0f} m, {outside:.0f} m outside the fence", "bring it there, or correct area.origin"

    def _hands_off(self, now: float) -> Problem | None:
        """Why the vehicle is not ours to steer, and what to do; None if it is."""
        return self.vehicle.not_guided(now) or self.vehicle.not_armed(now)

    def _moving(self) -> tuple[float, float, float, float]:
        """x, y [m], vx, vy [m/s] of the last position."""
        assert self.vehicle.fix is not None
        return in_frame(self._frame, self.vehicle.fix)

    def _until(self, problem: Callable[[float], Problem | None], ask: Callable[[], None] | None = None) -> None:
        """Wait until there is no such problem, asking every second for what mends it.

        Raises
        ------
        BodyError : it stays
        """
        end, asked = self._clock() + PATIENCE, -math.inf
        while True:
            now = self.tick()
            still = problem(now)
            if still is None:
                return
            if now >= end:
                raise BodyError(self.vehicle.name, *still)
            if ask is not None and now - asked >= BEAT:
                ask()
                asked = now
            self._wait(0.05)


def open_mavlink_body(
    text: str,
    scenario: Scenario,
    id: int,
    *,
    detector: Detector | None = None,
    arm: bool = False,
    key: bytes | None = None,
    tell: Callable[[str], None] | None = None,
) -> MavlinkBody:
    """Return the body at an address, begun and beating; see open_body.

    Parameters
    ----------
    text : an address of connection.py, and #3 for the vehicle of system 3 where several are heard
    scenario : with area.origin
    id : number of the agent
    detector : default: no target is ever there
    arm, key, tell : see open_body

    Raises
    ------
    BodyError, ScenarioError, MissingExtraError : see open_body
    """
    address, mark, number = text.partition("#")
    if mark and not (number.isascii() and number.isdigit() and len(number) < 4 and 1 <= int(number) <= 255):
        problem = f"{quoted(number)} is no number of a system"
        raise BodyError("--body", problem, "write one from 1 to 255 after the #, or leave it out")
    if key is not None and len(key) != 32:
        raise BodyError("key", f"has {len(key)} bytes", "give 32; mavlink.key_of makes them of a phrase")
    frame, fence = frame_of(scenario), fence_of(scenario, id)
    connection = connect(address)
    body: MavlinkBody | None = None
    try:
        system = int(number) if mark else None
        vehicle = Vehicle(address, connection, Mavlink(system or 1, whole=connection.whole, key=key), system)
        silence = 2.0 * scenario.time_step + 1.0
        body = MavlinkBody(vehicle, frame, fence, detector=detector or no_detector, silence=silence)
        if tell:
            tell(f"waits for a vehicle at {address}, for its position and for GUIDED, {PATIENCE:g} s at most for each")
        body.begin(arm=arm)
    except BaseException:
        connection.close() if body is None else body.close()
        raise
    body.beat()
    return body
